#pragma once
// Fields of surface.h5 over a stretch of the rail, seen obliquely. [paper, Fig. 17]

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/engine/station_plan.hpp"
#include "io/report/relief.hpp"

namespace tread {

/// What is shown of a surface.h5, and how.
struct SurfaceView {
  std::string field;        ///< "max_pressure"
  std::string title;        ///< "Largest pressure"
  std::string value_label;  ///< with unit: "p [MPa]"
  double scale = 1;         ///< from the field's unit to that of the label
};

/// Only rows that have been in contact, and one more on either side.
struct SurfaceMap {
  std::string column;          ///< name and unit, "max_pressure [Pa]"
  std::vector<double> x, y;    ///< nodes along and across the rail, middles of elements for their fields [m]
  std::vector<double> values;  ///< [station][row], in the field's unit
};

/// A field within the stretch. InputError where the file does not hold it over two stations or nothing lies
/// there.
SurfaceMap read_surface_map(const std::filesystem::path& path, const std::string& field, const Span& stretch);

/// With titles, labels and units of the view.
Relief relief(const SurfaceMap& map, const SurfaceView& view);

/// A row per value.
std::string surface_maps_csv(const std::vector<SurfaceMap>& maps);

}  // namespace tread
