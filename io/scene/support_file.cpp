#include "io/scene/support_file.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <variant>

#include "core/error.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/table_reader.hpp"
#include "io/text/text.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

const std::string kRow = "row";  ///< name of a table that stands for a row
const std::string kRowTable = std::string(kSupportTables) + kRow + ".";
const std::string kCounted = "fastening";

/// The keys of a support's table: columns that a file may have.
std::vector<Key> column_keys() {
  TableNames names;
  names.supports = {kRow};
  std::vector<Key> keys = scene_keys(names);
  std::erase_if(keys, [](const Key& key) { return !key.locate || !key.path.starts_with(kRowTable); });
  return keys;
}

std::string column_name(const Key& key) {
  return key.path.substr(kRowTable.size());
}

/// A number of a file as the value of the key.
struct ColumnRules {
  bool whole;  ///< whole numbers alone
  Bounds range;
};

ColumnRules rules_of(const Key& key) {
  if (key.kind == Kind::boolean) return {true, {0, 1}};
  return {key.kind == Kind::integer, key.range};
}

void set(const Field& field, double value) {
  if (const auto* number = std::get_if<double*>(&field)) **number = value;
  if (const auto* number = std::get_if<std::optional<double>*>(&field)) **number = value;
  if (const auto* number = std::get_if<int*>(&field)) **number = static_cast<int>(value);
  if (const auto* truth = std::get_if<bool*>(&field)) **truth = value != 0;
}

/// Names before units in brackets.
struct NamedUnit {
  std::string name, unit;
  bool operator==(const NamedUnit&) const = default;
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
    ++line_;
    const std::vector<NamedUnit> names = named_units(line);
    const auto counted = std::ranges::find(names, kCounted, &NamedUnit::name);
    if (counted != names.end() && columns_.empty()) {
      stated_ = names;
      header_line_ = line_;
      for (const NamedUnit& column : names) add_column(column);
      return;
    }
    // Another unit stands in a comment, such as "fastening [12] is loose".
    if (counted != names.end() && counted->unit == "-" && names != stated_)
      throw InputError(fmt::format("the columns are {} here and {} on line {}; leave one of the lines out",
                                   listed(names), listed(stated_), header_line_));
    const std::vector<std::string> row = table_cells(line);
    if (!row.empty()) add_row(row);
  }

  std::vector<SupportSpec> supports;

 private:
  struct Column {
    const Key* key;
    Unit unit;
    std::string unit_text;  ///< as the header states it
  };

  /// "fastening [-], shift [mm]"
  static std::string listed(const std::vector<NamedUnit>& columns) {
    std::vector<std::string> texts;
    for (const NamedUnit& column : columns) texts.push_back(fmt::format("{} [{}]", column.name, column.unit));
    return fmt::format("{}", fmt::join(texts, ", "));
  }

  void add_column(const NamedUnit& stated) {
    const auto key = std::ranges::find(keys_, stated.name, column_name);
    if (key == keys_.end()) {
      std::vector<std::string> names;
      for (const Key& known : keys_) names.push_back(column_name(known));
      throw InputError(
          fmt::format("the column \"{}\" is unknown; choose from: {}", stated.name, fmt::join(names, ", ")));
    }
    if (std::ranges::find(columns_, &*key, &Column::key) != columns_.end())
      throw InputError(fmt::format("the column {} stands twice", stated.name));
    columns_.push_back({&*key, unit_of(*key, stated), stated.unit});
  }

  static Unit unit_of(const Key& key, const NamedUnit& stated) {
    if (!key.quantity) {
      if (stated.unit == "-") return {};
      throw InputError(fmt::format("{} [{}]: [{}] is not [-], the unit of a pure number", stated.name,
                                   stated.unit, stated.unit));
    }
    const Unit unit = parse_unit(stated.unit);
    if (unit.dimension == key.quantity->dimension) return unit;
    throw InputError(fmt::format("{} [{}]: expected a {} (units: {})", stated.name, stated.unit,
                                 key.quantity->name, key.quantity->accepted));
  }

  /// A bound in the column's unit.
  static std::string bound(const Column& column, double value) {
    return column.key->quantity ? format_quantity(value, column.unit_text) : fmt::format("{:g}", value);
  }

  void add_row(const std::vector<std::string>& row) {
    if (columns_.empty())
      throw InputError(
          "the columns have no names: put a line such as \"# fastening [-]  shift [mm]  stiffness [-]\" "
          "before the numbers");
    if (row.size() != columns_.size())
      throw InputError(fmt::format("expected {} numbers, found {} columns", columns_.size(), row.size()));
    Scene scene;
    scene.supports[kRow] = {};
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto& [key, unit, text] = columns_[i];
      const double value = parse_number(row[i], unit);
      const auto [whole, range] = rules_of(*key);
      if (!range.contains(value) || (whole && value != std::floor(value)))
        throw InputError(fmt::format("{} = {} is not {} from {} to {}", column_name(*key),
                                     row[i] + (key->quantity ? " " + text : ""),
                                     whole ? "a whole number" : "a number", bound(columns_[i], range.low),
                                     bound(columns_[i], range.high)));
      set(key->locate(scene), value);
    }
    supports.push_back(scene.supports[kRow]);
  }

  const std::vector<Key> keys_ = column_keys();
  std::vector<Column> columns_;
  std::vector<NamedUnit> stated_;  ///< the header
  int line_ = 0;                   ///< from 1
  int header_line_ = 0;
};

}  // namespace

std::vector<SupportSpec> parse_supports(const std::string& content, const std::filesystem::path& path,
                                        std::vector<Problem>& problems) {
  SupportParser parser;
  const bool sound = read_table_lines(
      content, path, [&](const std::string& line) { parser.read_line(line); }, problems);
  const auto report = [&](const std::string& message) {
    problems.push_back({path.string(), 0, 0, "", message});
  };
  if (sound && parser.supports.empty()) report("expected a row of numbers");
  std::ranges::sort(parser.supports, {}, &SupportSpec::fastening);
  const auto twice = std::ranges::adjacent_find(parser.supports, {}, &SupportSpec::fastening);
  if (twice != parser.supports.end()) report(fmt::format("fastening {} stands twice", twice->fastening));
  return std::move(parser.supports);
}

}  // namespace tread
