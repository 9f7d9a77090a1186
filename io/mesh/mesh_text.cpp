#include "io/mesh/mesh_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "io/text/text.hpp"

namespace tread {

namespace {

constexpr std::size_t kKept = 5;  // of one kind

constexpr bool blank(char c) {
  return c == ' ' || c == '\t';
}

template <class Number>
std::optional<Number> number_of(std::string_view field) {
  if (field.size() > 1 && field.front() == '+' && field[1] != '-') field.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
  return value;
}

}  // namespace

void MeshFaults::add(int line, const std::string& kind, std::string message) {
  Kind& of_kind = kinds_[kind];
  if (of_kind.kept.size() < kKept)
    of_kind.kept.push_back({line, std::move(message)});
  else
    ++of_kind.more;
}

std::vector<LineFault> MeshFaults::list() const {
  std::vector<LineFault> all;
  for (const auto& [kind, faults] : kinds_) {
    all.insert(all.end(), faults.kept.begin(), faults.kept.end());
    if (faults.more > 0) all.push_back({0, fmt::format("{} more {}", faults.more, kind)});
  }
  return all;
}

bool MeshLines::next() {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  line_ = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  ++number_;
  return true;
}

void MeshFields::add(std::string_view field) {
  overfull_ = size_ == kMost;
  if (!overfull_) fields_[size_++] = trimmed(field);
}

MeshFields MeshFields::of_widths(std::string_view line, std::span<const int> widths) {
  if (line.find(',') != std::string_view::npos) return between_commas(line);
  MeshFields fields;
  for (const int width : widths) {
    if (line.empty()) break;
    const std::size_t length = std::min(line.size(), static_cast<std::size_t>(width));
    fields.add(line.substr(0, length));
    line.remove_prefix(length);
  }
  return fields;
}

MeshFields MeshFields::between_commas(std::string_view line) {
  MeshFields fields;
  for (;;) {
    const std::size_t end = std::min(line.find(','), line.size());
    const bool last = end == line.size();
    if (!last || !trimmed(line).empty()) fields.add(line.substr(0, end));
    if (last || fields.overfull()) return fields;
    line.remove_prefix(end + 1);
  }
}

MeshFields MeshFields::between_blanks(std::string_view line) {
  MeshFields fields;
  while (!fields.overfull()) {
    while (!line.empty() && blank(line.front())) line.remove_prefix(1);
    if (line.empty()) break;
    std::size_t length = 0;
    while (length < line.size() && !blank(line[length])) ++length;
    fields.add(line.substr(0, length));
    line.remove_prefix(length);
  }
  return fields;
}

std::optional<std::int64_t> integer_of(std::string_view field) {
  return number_of<std::int64_t>(field);
}

std::optional<double> real_of(std::string_view field) {
  std::optional<double> value = number_of<double>(field);
  if (const std::size_t letter = field.find_first_of("dD"); !value && letter != std::string_view::npos) {
    std::string with_e(field.substr(0, std::min<std::size_t>(field.size(), 40)));
    if (letter < with_e.size()) with_e[letter] = 'e';
    value = number_of<double>(with_e);
  }
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string shown(std::string_view text) {
  std::string plain(trimmed(text).substr(0, 60));
  for (char& c : plain)
    if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > '~') c = '?';
  return plain;
}

}  // namespace tread
