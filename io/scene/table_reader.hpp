#pragma once
// Text files of columns: profiles, measured depths, curves of a force.

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/function_ref.hpp"
#include "io/scene/problems.hpp"
#include "io/text/column_order.hpp"
#include "io/text/units.hpp"

namespace tread {

/// Rules of a file of two columns. Both are lengths unless the rules say otherwise.
struct TableRules {
  bool needs_units = false;  ///< a line such as "# x [m]  d [mm]" must come before the numbers
  bool increasing = false;   ///< the first column must grow from row to row
  bool pure_second = false;  ///< the second column holds pure numbers, with the unit [-]
  bool angle_first = false;  ///< the first column may hold angles, with the unit [deg]
  std::optional<std::array<std::string, 2>> units = {};  ///< stated elsewhere; the file may not state others
  std::vector<Quantity> first = {kLength};               ///< quantities that the first column may hold
  std::vector<Quantity> second = {kLength};              ///< quantities that the second column may hold
  std::string example = "x [m]  d [mm]";                 ///< names and units of both columns in messages
  std::vector<ColumnNames> names = {};  ///< by column; with these the header's order is checked
  std::string units_option = {};        ///< that states the units too, for messages
  double deepest = std::numeric_limits<double>::infinity();  ///< largest magnitude in the last column [m]
  bool downwards = false;  ///< the last column holds depths: one that is named z or height is refused
};

/// Names of depths or heights along a way.
inline const std::vector<ColumnNames> kDepthNames = {{"x", "s", "angle"}, {"d", "depth", "z", "height"}};

/// x and coefficient of friction.
inline const TableRules kFrictionTable = {.needs_units = true,
                                          .increasing = true,
                                          .pure_second = true,
                                          .names = {{"x", "s"}, {"f", "mu", "friction"}}};

/// Across and from the axle.
inline const TableRules kWebOutline = {
    .needs_units = true, .example = "y [mm]  r [mm]", .names = {{"y"}, {"r", "z", "radius"}}};

struct TwoColumns {
  std::vector<double> first;   ///< in SI; [rad] where the rules allow angles and the file states [deg]
  std::vector<double> second;  ///< in SI, or pure numbers
  bool angles = false;         ///< the first column holds angles
  std::vector<std::string> names = {};      ///< that the lines of units state, "" where they state none
  Dimension dimension = kLength.dimension;  ///< of the first column
};

/// Values at all pairs of x and y.
struct GridColumns {
  std::vector<double> x;  ///< increasing [m]
  std::vector<double> y;  ///< increasing [m]
  std::vector<double> z;  ///< z[j * x.size() + i] belongs to (x[i], y[j]) [m]
};

/// The cells of a line of such a file, between blanks, commas or semicolons, up to a '#'.
std::vector<std::string> table_cells(const std::string& line);

/// Calls read(line) for every line of such a file. The InputErrors that it throws are added to `problems`
/// with the number of the line; returns false if there was one.
bool read_table_lines(const std::string& content, const std::filesystem::path& path,
                      FunctionRef<void(const std::string& line)> read, std::vector<Problem>& problems);

/// The text of such a file, without a byte-order mark. Throws InputError.
std::string read_table_text(const std::filesystem::path& path);

/// Reads two numbers a line, separated by blanks, commas or semicolons; '#' starts a comment. A line before
/// the numbers whose first two brackets hold units declares them; without it, where the rules allow, both are
/// millimetres. Every bad line is added to `problems` with its number; `path` is the file's name in them.
TwoColumns parse_two_columns(const std::string& content, const std::filesystem::path& path,
                             const TableRules& rules, std::vector<Problem>& problems);

/// Reads x, y and z of a grid's points, a line each in any order, with a line of units such as "# x [mm]  y
/// [mm]  d [um]" before them. Problems as above; every x needs every y once, and no z may go beyond `deepest`
/// [m] up or down.
GridColumns parse_grid(const std::string& content, const std::filesystem::path& path,
                       std::vector<Problem>& problems,
                       double deepest = std::numeric_limits<double>::infinity());

/// Two columns of a file. Throws InputError, ProblemsError where lines are bad.
TwoColumns read_two_columns(const std::filesystem::path& path, const TableRules& rules);

}  // namespace tread
