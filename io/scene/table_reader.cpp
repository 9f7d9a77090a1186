#include "io/scene/table_reader.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "io/text/text_file.hpp"

namespace tread {

namespace {

constexpr std::size_t kLargestTable = 128 << 20;  // [bytes]

/// The texts between brackets.
std::vector<std::string> bracketed(const std::string& line) {
  std::vector<std::string> found;
  std::size_t open = 0;
  while ((open = line.find('[', open)) != std::string::npos) {
    const std::size_t close = line.find(']', open);
    if (close == std::string::npos) break;
    found.push_back(line.substr(open + 1, close - open - 1));
    open = close;
  }
  return found;
}

std::vector<std::string> cells(std::string line) {
  for (char& c : line) {
    if (c == ',' || c == ';') c = ' ';
  }
  std::istringstream stream(line);
  std::vector<std::string> found;
  for (std::string cell; stream >> cell;) found.push_back(cell);
  return found;
}

/// A unit of one of these quantities.
Unit unit_of(const std::string& text, const std::vector<Quantity>& quantities) {
  const Unit unit = parse_unit(text);
  std::string accepted;
  for (const Quantity& quantity : quantities) {
    if (unit.dimension == quantity.dimension) return unit;
    accepted +=
        fmt::format("{}a {} (units: {})", accepted.empty() ? "" : " or ", quantity.name, quantity.accepted);
  }
  throw InputError(fmt::format("[{}] is not {}", text, accepted));
}

Unit length_unit(const std::string& text) {
  return unit_of(text, {kLength});
}

/// A pure number's unit is "-".
Unit pure_unit(const std::string& text) {
  if (text != "-") throw InputError(fmt::format("[{}] is not [-], the unit of a pure number", text));
  return {};
}

bool same_unit(const Unit& a, const Unit& b) {
  return a.exponent == b.exponent && a.numerator == b.numerator && a.denominator == b.denominator;
}

class TableParser {
 public:
  explicit TableParser(const TableRules& rules) : rules_(rules) {
    if (rules.units) units_ = {length_unit((*rules.units)[0]), length_unit((*rules.units)[1])};
  }

  void read_line(const std::string& line) {
    const std::vector<std::string> units = bracketed(line);
    if (table.first.empty() && units.size() == 2) {
      const std::array<Unit, 2> stated = {
          unit_of(units[0], rules_.first),
          rules_.pure_second ? pure_unit(units[1]) : unit_of(units[1], rules_.second)};
      for (std::size_t i = 0; i < 2; ++i)
        if (rules_.units && !same_unit((*units_)[i], stated[i]))
          throw InputError(fmt::format("the file states [{}] where [{}] was stated outside of it", units[i],
                                       (*rules_.units)[i]));
      units_ = stated;
      table.dimension = stated[0].dimension;
      return;
    }
    const std::vector<std::string> row = cells(line.substr(0, line.find('#')));
    if (!row.empty()) add_row(row);
  }

  TwoColumns table;

 private:
  void add_row(const std::vector<std::string>& row) {
    if (row.size() != 2) throw InputError(fmt::format("expected 2 numbers, found {} columns", row.size()));
    if (!units_ && rules_.needs_units) {
      units_ = {length_unit("mm"), length_unit("mm")};
      throw InputError(
          fmt::format("the units are missing: put a line such as \"# x [m]  {}\" before the numbers",
                      rules_.pure_second ? "f [-]" : rules_.example));
    }
    const std::array<Unit, 2> units = units_.value_or(std::array{length_unit("mm"), length_unit("mm")});
    const double first = parse_number(row[0], units[0]);
    const double second = parse_number(row[1], units[1]);
    if (rules_.increasing && !table.first.empty() && first <= table.first.back()) {
      throw InputError("the first column must grow from row to row");
    }
    table.first.push_back(first);
    table.second.push_back(second);
  }

  TableRules rules_;
  std::optional<std::array<Unit, 2>> units_;
};

}  // namespace

std::string read_table_text(const std::filesystem::path& path) {
  return read_text_file(path, kLargestTable);
}

TwoColumns parse_two_columns(const std::string& content, const std::filesystem::path& path,
                             const TableRules& rules, std::vector<Problem>& problems) {
  std::istringstream text(content);
  TableParser parser(rules);
  const std::size_t known_problems = problems.size();
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    try {
      parser.read_line(line);
    } catch (const InputError& error) {
      problems.push_back({path.string(), number, 0, "", error.what()});
    }
  }
  if (problems.size() == known_problems && parser.table.first.size() < 2) {
    problems.push_back({path.string(), 0, 0, "", "expected at least two rows of numbers"});
  }
  return std::move(parser.table);
}

TwoColumns read_two_columns(const std::filesystem::path& path, const TableRules& rules) {
  std::vector<Problem> problems;
  TwoColumns table = parse_two_columns(read_table_text(path), path, rules, problems);
  if (!problems.empty()) throw ProblemsError(std::move(problems));
  return table;
}

}  // namespace tread
