#include "io/profiles/column_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <map>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

/// Metres in a unit that a header names, and its usual spelling.
struct NamedUnit {
  double metres;
  const char* name;
};
const std::map<std::string, NamedUnit>& units() {
  static const std::map<std::string, NamedUnit> known = {
      {"mm", {1e-3, "mm"}},      {"millimetres", {1e-3, "mm"}}, {"millimeters", {1e-3, "mm"}},
      {"m", {1, "m"}},           {"metres", {1, "m"}},          {"meters", {1, "m"}},
      {"inch", {25.4e-3, "in"}}, {"inches", {25.4e-3, "in"}},   {"in", {25.4e-3, "in"}}};
  return known;
}

/// Words of a header without its punctuation.
std::vector<std::string> words_of(const std::string& line) {
  std::string text = lower_case(line);
  for (char& c : text)
    if (!(c >= 'a' && c <= 'z') && !(c >= '0' && c <= '9')) c = ' ';
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// Returns true for a word of a header that names a column, its unit or its side.
bool is_column_word(const std::string& word) {
  return word == "x" || word == "y" || word == "z" || word == "left" || word == "right" ||
         units().contains(word);
}

/// Returns true if "in" is the unit there, and no preposition: in brackets, or where columns alone are named.
bool states_inches(const std::string& line, const std::vector<std::string>& words) {
  const std::string text = lower_case(line);
  return text.find("[in]") != std::string::npos || text.find("(in)") != std::string::npos ||
         std::all_of(words.begin(), words.end(), is_column_word);
}

/// Throws InputError for a header of names, units and sides alone, "z [mm]; y [mm]", with names out of order.
void require_order(const std::vector<std::string>& words) {
  std::vector<std::string> names;
  for (const std::string& word : words) {
    if (!is_column_word(word)) return;
    if (word == "x" || word == "y" || word == "z") names.push_back(word);
  }
  if (names.size() > 1) require_column_order(names, kProfileNames);
}

/// Returns true for numbers that no profile can have, too: "nan", "1e999".
bool is_any_number(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error != std::errc::invalid_argument && end == cell.data() + cell.size();
}

/// Returns true for a line that begins as a row: a number, then another number or an empty cell between
/// separators. Separators at the end say nothing: "45;" is a count of rows.
bool begins_as_row(std::string_view line) {
  constexpr std::string_view kSeparators = " \t,;";
  line = line.substr(0, line.find_last_not_of(kSeparators) + 1);
  const auto cell = [&] { return line.substr(0, line.find_first_of(kSeparators)); };
  const std::string_view first = cell();
  if (!is_any_number(first)) return false;
  const auto at_separator = [&] { return line.starts_with(',') || line.starts_with(';'); };
  line = trimmed(line.substr(first.size()));
  if (at_separator()) line = trimmed(line.substr(1));
  return at_separator() || is_any_number(cell());
}

/// Statements of the lines before the first row.
struct ColumnHeader {
  double scale = 1e-3;        ///< of the file's lengths [m]
  std::size_t announced = 0;  ///< rows; 0: not stated
};

/// Takes the statements of a line of the header.
void read_header_line(const std::string& line, ColumnHeader& header, FilePoints& points) {
  const std::vector<double> row = leading_numbers(line, 1);
  const bool count = line.find_first_not_of("0123456789") == std::string::npos;
  header.announced =
      count && !row.empty() && row[0] > 0 && row[0] < 1e7 ? static_cast<std::size_t>(row[0]) : 0;
  const std::vector<std::string> words = words_of(line);
  for (const std::string& word : words) {
    if (word == "in" && !states_inches(line, words)) continue;
    if (const auto unit = units().find(word); unit != units().end()) {
      header.scale = unit->second.metres;
      points.units = unit->second.name;
    }
    if (word == "left" || word == "right") points.side = word;
    if (word == "wheel") points.wheel = true;
    if (word == "rail") points.wheel = false;
  }
  require_order(words);
}

}  // namespace

FilePoints read_column_profile(const std::string& text, std::vector<LineFault>& faults) {
  FilePoints points;
  points.format = "columns under a header";
  points.units = "mm (assumed)";
  ColumnHeader header;
  std::size_t columns = 0;
  int number = 0;
  const std::size_t known = faults.size();
  const auto fault = [&](std::string message) { faults.push_back({number, std::move(message)}); };
  for (const std::string& whole : lines_of(text)) {
    ++number;
    const std::string line(trimmed(whole));
    if (line.empty() || line.starts_with('#') || line.starts_with('!')) continue;
    const std::vector<double> row = leading_numbers(line, 6);
    if (columns == 0 && row.size() < 2) {
      if (begins_as_row(line))
        fault(fmt::format("\"{}\": expected a row of numbers, y and z; a comment begins with #",
                          line.substr(0, 60)));
      else
        try {
          read_header_line(line, header, points);
        } catch (const InputError& error) {
          fault(error.what());
        }
      continue;
    }
    if (has_decimal_commas(line)) {
      fault(comma_fault(line));
      continue;
    }
    if (columns == 0) columns = row.size();
    if (row.size() != columns || columns > 4) {
      fault(fmt::format("\"{}\": expected a row of {} numbers as the first row has, y and z",
                        line.substr(0, 60), columns > 4 ? 2 : columns));
      continue;
    }
    points.y.push_back(row[0] * header.scale);
    points.z.push_back(row[1] * header.scale);
  }
  if (faults.size() > known) return points;
  if (header.announced > points.y.size())
    faults.push_back({0, fmt::format("the header announces {} rows, the file holds {}: is it cut off?",
                                     header.announced, points.y.size())});
  if (columns == 4) points.notes.emplace_back("the first two of four columns, the left side, are taken");
  if (columns == 3) points.notes.emplace_back("the third column is not used");
  return points;
}

}  // namespace tread
