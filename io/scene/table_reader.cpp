#include "io/scene/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "io/text/text.hpp"
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

bool is_unit(const std::string& text) {
  try {
    parse_unit(text);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

bool same_unit(const Unit& a, const Unit& b) {
  return a.exponent == b.exponent && a.numerator == b.numerator && a.denominator == b.denominator &&
         a.dimension == b.dimension;
}

/// "[mm], [um]"
std::string listed_units(const std::vector<std::string>& texts) {
  return fmt::format("[{}]", fmt::join(texts, "], ["));
}

/// "; a comma separates columns ..." where commas split the numbers of a line that other separators divide
/// into as many cells as there are columns, else "".
std::string comma_hint(const std::string& line, std::size_t columns) {
  const std::string text = with_decimal_points(line);
  if (text.empty() || table_cells(text).size() != columns) return "";
  return "; a comma separates columns: write decimal points, not commas";
}

/// Rows of as many numbers as there are columns, in SI.
class TableParser {
 public:
  TableParser(const TableRules& rules, std::size_t columns) : rules_(rules), columns_(columns) {
    if (rules.units)
      units_ = std::vector<Unit>{length_unit((*rules.units)[0]), length_unit((*rules.units)[1])};
  }

  void read_line(const std::string& line) {
    ++line_;
    std::vector<std::string> units = bracketed(line);
    const bool enough = units.size() >= columns_;
    if (enough) units.resize(columns_);
    if (rows.empty() && enough && is_header(units, line)) return read_header(units, line);
    if (rows.empty() && enough)
      ignored_ = fmt::format("; {} on line {} are no units", listed_units(units), line_);
    const std::vector<std::string> row = table_cells(line);
    if (!row.empty())
      add_row(row, line);
    else if (header_line_ > 0 && enough && units != texts_)
      refuse_late_header(units);
  }

  /// Adds a problem where the last column goes beyond the rules' bound.
  bool check_depths(const std::string& path, std::vector<Problem>& problems) const {
    const std::vector<double>& row = rows[deepest_row_];
    if (rules_.deepest >= std::abs(row.back())) return true;
    // Lines say nothing in a binary file.
    const std::string place =
        columns_ == 3 ? fmt::format(" at x = {:.6g} m, y = {:.6g} m", row[0], row[1]) : "";
    problems.push_back(
        {path, deepest_line_, 0, "",
         fmt::format("a depth of {:.4g} mm{} is not allowed; it must be from {:g} to {:g} mm: check the unit "
                     "of the column, [{}]{}",
                     1e3 * row.back(), place, -1e3 * rules_.deepest, 1e3 * rules_.deepest,
                     texts_.empty() ? "mm" : texts_.back(), finer_unit(row.back()))});
    return false;
  }

  std::vector<std::vector<double>> rows;
  std::vector<std::string> names;           ///< in the headers, "" where none states one
  bool angles = false;                      ///< in the first column
  Dimension dimension = kLength.dimension;  ///< of the first column

 private:
  Unit unit_of_column(std::size_t column, const std::string& text) {
    if (columns_ == 3 && column == 0 && text == "deg")
      throw InputError(
          "[deg] is not a length: a map takes x along the circumference, in a unit such as [mm]; angles are "
          "for [surface] with kind = \"profile\" on the wheel");
    if (column == 1 && rules_.pure_second) return pure_unit(text);
    if (column > 1) return length_unit(text);
    if (column == 1) return unit_of(text, rules_.second);
    if (!rules_.angle_first || text != "deg") return unit_of(text, rules_.first);
    angles = true;
    return {0, std::numbers::pi, 180, {}};
  }

  /// Names before the units of the columns.
  std::vector<std::string> names_of(const std::string& line) const {
    std::vector<std::string> found = names_before_units(line);
    found.resize(columns_);
    return found;
  }

  /// Returns true for "# way [inch]  wear [inch]": a word before each column's bracket, no digits, no more.
  bool is_words_and_units(std::string_view line) const {
    line.remove_prefix(std::min(line.find_first_not_of("# \t"), line.size()));
    for (std::size_t i = 0; i < columns_; ++i) {
      const std::size_t open = line.find('[');
      const std::size_t close = line.find(']', open);
      if (table_cells(std::string(line.substr(0, open))).size() != 1) return false;
      if (line.substr(0, close).find_first_of("0123456789", open) != line.npos) return false;
      line.remove_prefix(close + 1);
    }
    return trimmed(line).empty();
  }

  /// Returns true for a line with a unit, or a column's name, among its brackets; others are comments. Where
  /// a file may state no units, unknown ones must not pass for a comment.
  bool is_header(const std::vector<std::string>& texts, const std::string& line) const {
    const auto is_column = [&](const std::string& name) {
      return std::ranges::any_of(rules_.names, [&](const ColumnNames& column) {
        return std::ranges::find(column, lower_case(name)) != column.end();
      });
    };
    return std::ranges::any_of(texts, is_unit) || std::ranges::any_of(names_of(line), is_column) ||
           (!rules_.needs_units && header_line_ == 0 && is_words_and_units(line));
  }

  void read_header(const std::vector<std::string>& texts, const std::string& line) {
    try {
      const std::vector<std::string> found = names_of(line);
      require_column_order(found, rules_.names);
      names.resize(columns_);
      for (std::size_t i = 0; i < columns_; ++i)
        if (!found[i].empty()) names[i] = found[i];
      if (rules_.downwards) refuse_heights(line);
      state_units(texts);
    } catch (const InputError&) {
      // This header is the problem, not that there is none.
      if (!units_) units_ = std::vector<Unit>(columns_, length_unit("mm"));
      throw;
    }
  }

  /// Throws InputError where the last column's name is one of heights.
  void refuse_heights(const std::string& line) const {
    const std::string name = names_of(line).back();
    const bool height = lower_case(name) == "z" || lower_case(name) == "height";
    if (!height || lower_case(line).find("depth") != std::string::npos) return;
    throw InputError(fmt::format(
        "the column {} counts upwards, and depths count downwards: turn its sign and name it d", name));
  }

  void state_units(const std::vector<std::string>& texts) {
    std::vector<Unit> stated;
    for (std::size_t i = 0; i < columns_; ++i) {
      stated.push_back(unit_of_column(i, texts[i]));
      if (rules_.units && !same_unit((*units_)[i], stated[i]))
        throw InputError(fmt::format("the file states [{}] where [{}] was stated outside of it", texts[i],
                                     (*rules_.units)[i]));
    }
    if (header_line_ > 0) require_same_units(stated, texts);
    units_ = stated;
    dimension = stated[0].dimension;
    texts_ = texts;
    header_line_ = line_;
  }

  void require_same_units(const std::vector<Unit>& stated, const std::vector<std::string>& texts) const {
    if (std::equal(stated.begin(), stated.end(), units_->begin(), same_unit)) return;
    throw InputError(fmt::format("the units are {} here and {} on line {}; leave one of the lines out",
                                 listed_units(texts), listed_units(texts_), header_line_));
  }

  /// Throws InputError for units behind the first numbers that are not those before them.
  void refuse_late_header(const std::vector<std::string>& texts) {
    const bool had_angles = angles;
    std::vector<Unit> stated;
    try {
      for (std::size_t i = 0; i < columns_; ++i) stated.push_back(unit_of_column(i, texts[i]));
    } catch (const InputError&) {
      angles = had_angles;
      return;  // a comment
    }
    angles = had_angles;
    require_same_units(stated, texts);
  }

  /// "; in [um] it would be 0.03 mm" where the depths fit in a unit of that kind, else "".
  std::string finer_unit(double deepest) const {
    const Unit& stated = units_->back();
    const double size = std::pow(10, stated.exponent) * stated.numerator / stated.denominator;
    for (const auto& [name, finer] : {std::pair{"mm", 1e-3}, std::pair{"um", 1e-6}}) {
      const double depth = deepest / size * finer;
      if (finer < 0.99 * size && std::abs(depth) <= rules_.deepest)
        return fmt::format("; in [{}] it would be {:.4g} mm", name, 1e3 * depth);
    }
    return "";
  }

  std::string example() const {
    if (columns_ == 3) return "# x [mm]  y [mm]  d [um]";
    return "# " + (rules_.pure_second ? "x [m]  f [-]" : rules_.example);
  }

  void add_row(const std::vector<std::string>& row, const std::string& line) {
    if (row.size() != columns_)
      throw InputError(fmt::format("expected {} numbers, found {} columns{}", columns_, row.size(),
                                   row.size() > 2 * columns_
                                       ? "; leave the others out, with a line of units at the top"
                                       : comma_hint(line, columns_)));
    const bool missing = !units_ && rules_.needs_units;
    if (!units_) units_ = std::vector<Unit>(columns_, length_unit("mm"));
    if (missing)
      throw InputError(
          fmt::format("the units are missing: put a line such as \"{}\" before the numbers{}{}", example(),
                      rules_.units_option.empty() ? "" : ", or state " + rules_.units_option, ignored_));
    std::vector<double> values;
    for (std::size_t i = 0; i < columns_; ++i) values.push_back(parse_number(row[i], (*units_)[i]));
    if (rules_.increasing && !rows.empty() && values[0] <= rows.back()[0])
      throw InputError("the first column must grow from row to row");
    if (rows.empty() || std::abs(values.back()) > std::abs(rows[deepest_row_].back())) {
      deepest_row_ = rows.size();
      deepest_line_ = line_;
    }
    rows.push_back(std::move(values));
  }

  TableRules rules_;
  std::size_t columns_;
  std::optional<std::vector<Unit>> units_;
  std::vector<std::string> texts_;  ///< the units as the header states them
  std::string ignored_;          ///< clause on the last line before the numbers whose brackets hold no units
  int line_ = 0;                 ///< from 1
  int header_line_ = 0;          ///< 0: no header yet
  std::size_t deepest_row_ = 0;  ///< with the largest magnitude in the last column
  int deepest_line_ = 0;
};

/// Reads all lines; false where one is bad or there are fewer than `least` rows.
bool parse_rows(TableParser& parser, const std::string& content, const std::filesystem::path& path,
                std::size_t least, std::vector<Problem>& problems) {
  if (!read_table_lines(
          content, path, [&](const std::string& line) { parser.read_line(line); }, problems))
    return false;
  if (parser.rows.size() >= least) return parser.check_depths(path.string(), problems);
  problems.push_back({path.string(), 0, 0, "",
                      least == 2 ? "expected at least two rows of numbers"
                                 : fmt::format("expected at least {} rows of numbers", least)});
  return false;
}

/// The values of a column, each once, increasing.
std::vector<double> distinct(const std::vector<std::vector<double>>& rows, std::size_t column) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const auto& row : rows) values.push_back(row[column]);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::string missing_point(const GridColumns& grid, std::size_t rows, double x, double y) {
  return fmt::format(
      "{} places along times {} across are not the {} points of the file: that at x = {:.6g} m, y = "
      "{:.6g} m is missing; resample the map to a grid",
      grid.x.size(), grid.y.size(), rows, x, y);
}

}  // namespace

std::vector<std::string> table_cells(const std::string& line) {
  std::string text = line.substr(0, line.find('#'));
  for (char& c : text)
    if (c == ',' || c == ';') c = ' ';
  std::istringstream stream(text);
  std::vector<std::string> found;
  for (std::string cell; stream >> cell;) found.push_back(cell);
  return found;
}

bool read_table_lines(const std::string& content, const std::filesystem::path& path,
                      FunctionRef<void(const std::string& line)> read, std::vector<Problem>& problems) {
  std::istringstream text(content);
  const std::size_t known_problems = problems.size();
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    try {
      read(line);
    } catch (const InputError& error) {
      problems.push_back({path.string(), number, 0, "", error.what()});
    }
  }
  return problems.size() == known_problems;
}

std::string read_table_text(const std::filesystem::path& path) {
  return without_mark(read_text_file(path, kLargestTable));
}

TwoColumns parse_two_columns(const std::string& content, const std::filesystem::path& path,
                             const TableRules& rules, std::vector<Problem>& problems) {
  TableParser parser(rules, 2);
  parse_rows(parser, content, path, 2, problems);
  TwoColumns table{{}, {}, parser.angles, parser.names, parser.dimension};
  for (const auto& row : parser.rows) {
    table.first.push_back(row[0]);
    table.second.push_back(row[1]);
  }
  return table;
}

GridColumns parse_grid(const std::string& content, const std::filesystem::path& path,
                       std::vector<Problem>& problems, double deepest) {
  const std::vector<ColumnNames> names = {{"x", "s"}, {"y"}, {"d", "depth", "z", "height"}};
  TableParser parser({.needs_units = true, .names = names, .deepest = deepest, .downwards = true}, 3);
  if (!parse_rows(parser, content, path, 4, problems)) return {};
  std::vector<std::vector<double>>& rows = parser.rows;
  GridColumns grid{distinct(rows, 0), distinct(rows, 1), {}};
  const auto report = [&](const std::string& message) {
    problems.push_back({path.string(), 0, 0, "", message});
    return GridColumns{};
  };
  if (grid.x.size() < 2 || grid.y.size() < 2)
    return report(fmt::format("there are {} places along and {} across; a map needs two of both",
                              grid.x.size(), grid.y.size()));
  std::sort(rows.begin(), rows.end(),
            [](const auto& a, const auto& b) { return std::pair(a[1], a[0]) < std::pair(b[1], b[0]); });
  // A sound file has now the points of the grid, row by row.
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && rows[i][0] == rows[i - 1][0] && rows[i][1] == rows[i - 1][1])
      return report(fmt::format("the point x = {:.6g} m, y = {:.6g} m stands twice", rows[i][0], rows[i][1]));
    const double x = grid.x[i % grid.x.size()];
    const double y = grid.y[i / grid.x.size()];
    if (rows[i][0] != x || rows[i][1] != y) return report(missing_point(grid, rows.size(), x, y));
    grid.z.push_back(rows[i][2]);
  }
  if (rows.size() < grid.x.size() * grid.y.size())
    return report(missing_point(grid, rows.size(), grid.x[rows.size() % grid.x.size()],
                                grid.y[rows.size() / grid.x.size()]));
  return grid;
}

TwoColumns read_two_columns(const std::filesystem::path& path, const TableRules& rules) {
  std::vector<Problem> problems;
  TwoColumns table = parse_two_columns(read_table_text(path), path, rules, problems);
  if (!problems.empty()) throw ProblemsError(std::move(problems));
  return table;
}

}  // namespace tread
