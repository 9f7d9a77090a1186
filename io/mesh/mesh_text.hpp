#pragma once
// Lines and fields of mesh files, and the faults found in them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/line_fault.hpp"

namespace tread {

/// Faults of a mesh. Of each kind the first few are kept, the others counted.
class MeshFaults {
 public:
  /// `line` from 1; 0: the file as a whole. `kind`: name of the others in their count, "elements with ...".
  void add(int line, const std::string& kind, std::string message);
  bool empty() const { return kinds_.empty(); }
  /// All that were kept, and a line for those that were not.
  std::vector<LineFault> list() const;

 private:
  struct Kind {
    std::vector<LineFault> kept;
    std::int64_t more = 0;
  };
  std::map<std::string, Kind> kinds_;
};

/// Walks through the lines of a text, without copies.
class MeshLines {
 public:
  explicit MeshLines(std::string_view text) : rest_(text) {}

  /// Goes to the next line; false at the end.
  bool next();
  std::string_view line() const { return line_; }  ///< without its end
  int number() const { return number_; }           ///< from 1

 private:
  std::string_view rest_, line_;
  int number_ = 0;
};

/// Fields of a line.
class MeshFields {
 public:
  static constexpr std::size_t kMost = 32;

  /// Fields of these widths [characters]; a line with commas is cut there.
  static MeshFields of_widths(std::string_view line, std::span<const int> widths);
  /// Fields between commas.
  static MeshFields between_commas(std::string_view line);
  /// Fields between blanks.
  static MeshFields between_blanks(std::string_view line);

  std::size_t size() const { return size_; }
  /// The field without blanks around it; empty beyond the last.
  std::string_view operator[](std::size_t i) const { return i < size_ ? fields_[i] : std::string_view(); }
  /// Leaves out the fields behind the first `count`.
  void keep(std::size_t count) { size_ = count < size_ ? count : size_; }
  /// More than kMost fields.
  bool overfull() const { return overfull_; }

 private:
  void add(std::string_view field);

  std::array<std::string_view, kMost> fields_;
  std::size_t size_ = 0;
  bool overfull_ = false;
};

/// The whole field as an integer; nothing where it is none.
std::optional<std::int64_t> integer_of(std::string_view field);
/// The whole field as a finite number, whose exponent may have Fortran's letter D.
std::optional<double> real_of(std::string_view field);

/// The beginning of a text, for messages.
std::string shown(std::string_view text);

}  // namespace tread
