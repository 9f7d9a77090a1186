#pragma once
// Order of a file's columns by the names in its header.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tread {

/// Names that a column goes by, in lower case. The first is the usual one, in the case that messages show.
using ColumnNames = std::vector<std::string>;

/// Names before units in brackets: "x" and "d" of "# way x [m], depth (d) [mm]".
std::vector<std::string> names_before_units(std::string_view line);

/// Throws InputError where a column has a name that belongs to another one. Users may call columns as they
/// like: other names are those of any column.
void require_column_order(const std::vector<std::string>& found, std::span<const ColumnNames> expected);

}  // namespace tread
