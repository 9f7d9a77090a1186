#include "io/scene/support_file.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

#include "core/error.hpp"
#include "io/scene/table_reader.hpp"
#include "io/text/text.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

/// A column that a file may have; only shifts have a unit.
struct SupportColumn {
  const char* name;
  double least, most;
  bool whole;  ///< whole numbers alone
  void (*set)(SupportSpec& support, double value);
};

constexpr const char* kCounted = "fastening";
constexpr const char* kShifted = "shift";

const std::vector<SupportColumn> kSupportColumns = {
    {kCounted, 1, 10000, true, [](SupportSpec& s, double value) { s.fastening = static_cast<int>(value); }},
    {kShifted, -10, 10, false, [](SupportSpec& s, double value) { s.shift = value; }},
    {"stiffness", 0, 1000, false, [](SupportSpec& s, double value) { s.stiffness = value; }},
    {"damping", 0, 1000, false, [](SupportSpec& s, double value) { s.damping = value; }},
    {"bed", 0, 1000, false, [](SupportSpec& s, double value) { s.bed = value; }},
    {"holds", 0, 1, true, [](SupportSpec& s, double value) { s.holds = value != 0; }},
};

/// Names before units in brackets.
struct NamedUnit {
  std::string name, unit;
};

std::vector<NamedUnit> named_units(const std::string& line) {
  std::vector<NamedUnit> found;
  std::size_t from = 0;
  while (true) {
    const std::size_t open = line.find('[', from);
    const std::size_t close = line.find(']', open == std::string::npos ? open : open + 1);
    if (close == std::string::npos) return found;
    const std::size_t name = line.find_first_not_of("#,; \t", from);
    found.push_back({std::string(trimmed(std::string_view(line).substr(name, open - name))),
                     line.substr(open + 1, close - open - 1)});
    from = close + 1;
  }
}

class SupportParser {
 public:
  void read_line(const std::string& line) {
    const std::vector<NamedUnit> names = columns_.empty() ? named_units(line) : std::vector<NamedUnit>{};
    if (std::ranges::any_of(names, [](const NamedUnit& column) { return column.name == kCounted; })) {
      for (const NamedUnit& column : names) add_column(column);
      return;
    }
    const std::vector<std::string> row = table_cells(line);
    if (!row.empty()) add_row(row);
  }

  std::vector<SupportSpec> supports;

 private:
  void add_column(const NamedUnit& stated) {
    const auto known = std::ranges::find(kSupportColumns, stated.name, &SupportColumn::name);
    std::vector<std::string> names;
    for (const SupportColumn& column : kSupportColumns) names.emplace_back(column.name);
    if (known == kSupportColumns.end())
      throw InputError(
          fmt::format("the column \"{}\" is unknown; choose from: {}", stated.name, fmt::join(names, ", ")));
    if (std::ranges::find(columns_, &*known) != columns_.end())
      throw InputError(fmt::format("the column {} stands twice", stated.name));
    const bool pure = stated.name != kShifted;
    if (pure && stated.unit != "-")
      throw InputError(fmt::format("{} [{}]: [{}] is not [-], the unit of a pure number", stated.name,
                                   stated.unit, stated.unit));
    if (!pure) {
      shift_unit_ = parse_unit(stated.unit);
      if (shift_unit_.dimension != kLength.dimension)
        throw InputError(
            fmt::format("shift [{}]: expected a length (units: {})", stated.unit, kLength.accepted));
    }
    columns_.push_back(&*known);
  }

  void add_row(const std::vector<std::string>& row) {
    if (columns_.empty())
      throw InputError(
          "the columns have no names: put a line such as \"# fastening [-]  shift [mm]  stiffness [-]\" "
          "before "
          "the numbers");
    if (row.size() != columns_.size())
      throw InputError(fmt::format("expected {} numbers, found {} columns", columns_.size(), row.size()));
    SupportSpec support;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const SupportColumn& column = *columns_[i];
      const double value = column.name == kShifted ? parse_number(row[i], shift_unit_) : parse_number(row[i]);
      if (value < column.least || value > column.most || (column.whole && value != std::floor(value)))
        throw InputError(fmt::format("{} = {} is not {} from {:g} to {:g}{}", column.name, row[i],
                                     column.whole ? "a whole number" : "a number", column.least, column.most,
                                     column.name == kShifted ? " m" : ""));
      column.set(support, value);
    }
    supports.push_back(support);
  }

  std::vector<const SupportColumn*> columns_;
  Unit shift_unit_;
};

}  // namespace

std::vector<SupportSpec> parse_supports(const std::string& content, const std::filesystem::path& path,
                                        std::vector<Problem>& problems) {
  SupportParser parser;
  std::istringstream text(content);
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
  const auto report = [&](const std::string& message) {
    problems.push_back({path.string(), 0, 0, "", message});
  };
  if (problems.size() == known_problems && parser.supports.empty()) report("expected a row of numbers");
  std::ranges::sort(parser.supports, {}, &SupportSpec::fastening);
  const auto twice = std::ranges::adjacent_find(parser.supports, {}, &SupportSpec::fastening);
  if (twice != parser.supports.end()) report(fmt::format("fastening {} stands twice", twice->fastening));
  return std::move(parser.supports);
}

}  // namespace tread
