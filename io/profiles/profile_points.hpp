#pragma once
// Points of a profile's file, before their axes are understood.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/column_order.hpp"
#include "io/text/line_fault.hpp"
#include "io/text/text.hpp"

namespace tread {

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

/// Names of the columns of a profile; drawings name them x and y, too.
inline const std::vector<ColumnNames> kProfileNames = {{"y", "x"}, {"z", "y"}};

/// Lines of a text, without the ends that Unix and DOS give them.
std::vector<std::string> lines_of(const std::string& text);

/// Numbers at the beginning of a line, separated by blanks, tabs, commas or semicolons, up to `most`.
std::vector<double> leading_numbers(std::string_view line, std::size_t most);

/// Returns true if commas stand in the numbers of a row that blanks or semicolons divide.
bool has_decimal_commas(const std::string& row);

/// Message on decimal commas in a line.
std::string comma_fault(const std::string& line);

}  // namespace tread
