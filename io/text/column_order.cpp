#include "io/text/column_order.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>

#include "core/error.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

bool belongs(const ColumnNames& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

bool is_part_of_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// The last word of the text.
std::string last_word(std::string_view text) {
  while (!text.empty() && !is_part_of_name(text.back())) text.remove_suffix(1);
  std::size_t first = text.size();
  while (first > 0 && is_part_of_name(text[first - 1])) --first;
  return std::string(text.substr(first));
}

}  // namespace

std::vector<std::string> names_before_units(std::string_view line) {
  std::vector<std::string> names;
  for (std::size_t open = line.find('['); open != std::string_view::npos; open = line.find('[')) {
    const std::size_t close = line.find(']', open);
    if (close == std::string_view::npos) break;
    names.push_back(last_word(line.substr(0, open)));
    line.remove_prefix(close + 1);
  }
  return names;
}

void require_column_order(const std::vector<std::string>& found, std::span<const ColumnNames> expected) {
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
    const std::string name = lower_case(found[i]);
    if (belongs(expected[i], name)) continue;
    if (std::ranges::none_of(expected, [&](const ColumnNames& other) { return belongs(other, name); }))
      continue;
    std::vector<std::string> order;
    for (const ColumnNames& column : expected) order.push_back(column.front());
    throw InputError(
        fmt::format("the columns are named {}; expected {} in this order: move the columns, and their names",
                    fmt::join(found, ", "), fmt::join(order, ", ")));
  }
}

}  // namespace tread
