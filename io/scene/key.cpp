#include "io/scene/key.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tread {

bool Bounds::contains(double value) const {
  return (open_low ? value > low : value >= low) && (open_high ? value < high : value <= high);
}

std::string Condition::alternatives() const {
  if (names_file) return "a file";
  std::string text;
  for (const std::string& value : values) text += fmt::format("{}\"{}\"", text.empty() ? "" : " or ", value);
  return text;
}

void TableNames::add(std::string_view table) {
  if (table.starts_with(kMaterialTables)) materials.emplace_back(table.substr(kMaterialTables.size()));
  if (table.starts_with(kZoneTables)) zones.emplace_back(table.substr(kZoneTables.size()));
  if (table.starts_with(kSupportTables)) supports.emplace_back(table.substr(kSupportTables.size()));
  if (table.starts_with(kSurfaceTables)) surfaces.emplace_back(table.substr(kSurfaceTables.size()));
  if (table.starts_with(kBodyTables)) bodies.emplace_back(table.substr(kBodyTables.size()));
  if (table.starts_with(kProbeTables)) probes.emplace_back(table.substr(kProbeTables.size()));
}

std::string Condition::why_idle() const {
  if (needs_table()) return fmt::format("has no effect without [{}]", key);
  return fmt::format("has {} with {} = {}", negated ? "no effect" : "an effect only", key, alternatives());
}

std::optional<double> number_at(const Field& field) {
  if (const auto* value = std::get_if<double*>(&field)) return **value;
  if (const auto* value = std::get_if<int*>(&field)) return **value;
  if (const auto* value = std::get_if<std::optional<double>*>(&field)) return **value;
  if (const auto* value = std::get_if<DampingField>(&field))
    return *value->rayleigh_beta != 0 ? *value->rayleigh_beta : *value->high_frequency_fraction;
  return std::nullopt;
}

std::string describe_range(const Key& key) {
  const auto text = [&](double value) {
    return key.unit.empty() ? fmt::format("{:.6g}", value) : format_quantity(value, key.unit);
  };
  const Bounds& range = key.range;
  std::string low, high;
  if (std::isfinite(range.low)) low = (range.open_low ? "above " : "at least ") + text(range.low);
  if (std::isfinite(range.high)) high = (range.open_high ? "below " : "at most ") + text(range.high);
  return low + (low.empty() || high.empty() ? "" : " and ") + high;
}

}  // namespace tread
