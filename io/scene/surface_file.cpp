#include "io/scene/surface_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/scene/table_reader.hpp"

namespace tread {

namespace {

constexpr std::uint64_t kLargestMap = 10'000'000;  ///< values

/// InputError where the dataset states no unit.
std::string unit_of(const Hdf5File& file, const std::string& dataset) {
  const Hdf5Attributes attributes = file.attributes(dataset);
  for (const char* name : {"unit", "units"})
    if (const auto found = attributes.find(name); found != attributes.end())
      if (const auto* text = std::get_if<std::string>(&found->second)) return *text;
  throw InputError(fmt::format("dataset '{}' has no attribute 'unit'; give it one, such as \"mm\"", dataset));
}

std::vector<double> values_of(const Hdf5File& file, const std::string& dataset) {
  std::vector<double> values;
  if (file.type(dataset) == "double") {
    values = file.read<double>(dataset);
  } else if (file.type(dataset) == "float") {
    const std::vector<float> floats = file.read<float>(dataset);
    values.assign(floats.begin(), floats.end());
  } else {
    throw InputError(
        fmt::format("dataset '{}' does not hold floating-point numbers as this machine has them; write it as "
                    "little-endian float64",
                    dataset));
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw InputError(fmt::format("dataset '{}': value {} is {}, and every place of the map needs a number",
                                   dataset, i, values[i]));
  return values;
}

/// Number of values of a dataset in the file `name`, before they are read: a file may state any.
std::uint64_t size_of(const Hdf5File& file, const std::string& dataset, const std::string& name) {
  std::uint64_t size = 1;
  for (const std::uint64_t length : file.shape(dataset)) {
    if (length > kLargestMap || size * length > kLargestMap)
      throw InputError(
          fmt::format("{}: dataset '{}' has more than {} values, a map at most; state fewer places", name,
                      dataset, kLargestMap));
    size *= length;
  }
  return size;
}

std::string text_of(const Hdf5File& file, const std::string& name) {
  const std::vector<std::uint64_t> places = {size_of(file, "y", name), size_of(file, "x", name)};
  size_of(file, "depth", name);
  if (file.shape("depth") != places)
    throw InputError(fmt::format("dataset 'depth' does not have {} rows, one for each y, of {} values",
                                 places[0], places[1]));
  const std::vector<double> x = values_of(file, "x");
  const std::vector<double> y = values_of(file, "y");
  const std::vector<double> depth = values_of(file, "depth");
  std::string text = fmt::format("# x [{}]  y [{}]  d [{}]\n", unit_of(file, "x"), unit_of(file, "y"),
                                 unit_of(file, "depth"));
  for (std::size_t j = 0; j < y.size(); ++j)
    for (std::size_t i = 0; i < x.size(); ++i)
      text += fmt::format("{} {} {}\n", x[i], y[j], depth[j * x.size() + i]);
  return text;
}

}  // namespace

std::string read_map_text(const std::filesystem::path& path) {
  return begins_as_hdf5(path) ? text_of(Hdf5File::open_to_read(path), path.string()) : read_table_text(path);
}

void set_depths(const std::string& text, const std::string& name, CorrugationSpec& corrugation,
                std::vector<Problem>& problems) {
  if (corrugation.kind != "map") {
    TwoColumns columns = parse_two_columns(text, name,
                                           {.needs_units = true,
                                            .increasing = true,
                                            .names = kDepthNames,
                                            .deepest = kDeepestSurface,
                                            .downwards = true},
                                           problems);
    corrugation.table_x = std::move(columns.first);
    corrugation.table_depth = std::move(columns.second);
    return;
  }
  GridColumns grid = parse_grid(text, name, problems, kDeepestSurface);
  corrugation.table_x = std::move(grid.x);
  corrugation.map_y = std::move(grid.y);
  corrugation.table_depth = std::move(grid.z);
}

void set_depths(const std::string& text, const std::string& name, double wheel_radius, SurfaceSpec& surface,
                std::vector<Problem>& problems) {
  if (surface.kind == "map") {
    GridColumns grid = parse_grid(text, name, problems, kDeepestSurface);
    surface.file_x = std::move(grid.x);
    surface.file_y = std::move(grid.y);
    surface.file_depth = std::move(grid.z);
    return;
  }
  const TableRules rules{.needs_units = true,
                         .increasing = true,
                         .angle_first = surface.on_wheel(),
                         .names = kDepthNames,
                         .deepest = kDeepestSurface,
                         .downwards = true};
  TwoColumns columns = parse_two_columns(text, name, rules, problems);
  if (columns.angles)
    for (double& x : columns.first) x *= wheel_radius;
  surface.file_x = std::move(columns.first);
  surface.file_depth = std::move(columns.second);
}

}  // namespace tread
