#pragma once
// A field of surface.h5 over a stretch of the rail, seen from above. [paper, Fig. 17]

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/station_plan.hpp"
#include "io/report.hpp"

namespace tread {

/// Only rows that have been in contact, and one more on either side.
struct SurfaceMap {
  std::vector<double> x, y;    ///< nodes along and across the rail [m]
  std::vector<double> values;  ///< [station][row], in the field's unit
};

/// A field over the nodes, "max_pressure", within the stretch. InputError where the file does not hold it or
/// nothing lies there.
SurfaceMap read_surface_map(const std::filesystem::path& path, const std::string& field, const Span& stretch);

/// With values times `scale`.
Heatmap heatmap(const SurfaceMap& map, std::string title, std::string value_label, double scale);

/// A row per node; `column`: name and unit of the values.
std::string surface_map_csv(const SurfaceMap& map, const std::string& column);

}  // namespace tread
