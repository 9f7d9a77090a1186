#pragma once
// Points of a profile's file, before their axes are understood.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tread {

/// A line of a file that cannot be read.
struct LineFault {
  int line = 0;  ///< from 1; 0: the file as a whole
  std::string message;
};

/// Points with the changes that the file's own header asks for.
struct FilePoints {
  std::string format;                   ///< "SIMPACK"
  std::string units = "mm";             ///< units of the file's numbers
  std::optional<bool> wheel = {};       ///< true: the file calls itself a wheel's; absent: it does not say
  std::string side = {};                ///< side of the vehicle or track as the file states it
  std::vector<double> y = {};           ///< [m]
  std::vector<double> z = {};           ///< [m]
  std::vector<std::string> notes = {};  ///< changes by the header, things left out
};

/// Lines of a text, without the ends that Unix and DOS give them.
std::vector<std::string> lines_of(const std::string& text);

/// Numbers at the beginning of a line, separated by blanks, tabs, commas or semicolons, up to `most`.
std::vector<double> leading_numbers(std::string_view line, std::size_t most);

/// Lower-case copy of ASCII text.
std::string lower_case(std::string_view text);

}  // namespace tread
