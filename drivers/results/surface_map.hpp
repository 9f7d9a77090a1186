#pragma once
// Fields of surface.h5 over a stretch of the rail, seen obliquely. [paper, Fig. 17]

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/engine/model/station_plan.hpp"
#include "io/report/relief.hpp"

namespace tread {

/// Field of a surface.h5 with title, label and scale of its picture.
struct SurfaceView {
  std::string field;        ///< name such as "max_pressure"
  std::string title;        ///< title such as "Largest pressure"
  std::string value_label;  ///< label with unit: "p [MPa]"
  double scale = 1;         ///< factor from the field's unit to that of the label
};

/// Values of a surface field on the rows that have been in contact, and one more row on either side.
struct SurfaceMap {
  std::string column;          ///< name and unit, such as "max_pressure [Pa]"
  std::vector<double> x, y;    ///< nodes along and across the rail, elements' middles for element fields [m]
  std::vector<double> values;  ///< values [station][row], in the field's unit
};

/// Reads a field within the stretch. Throws InputError if the file does not hold the field over two stations
/// or nothing lies in the stretch.
SurfaceMap read_surface_map(const std::filesystem::path& path, const std::string& field, const Span& stretch);

/// Relief with titles, labels and units of the view.
Relief relief(const SurfaceMap& map, const SurfaceView& view);

/// Table with a row per value.
std::string surface_maps_csv(const std::vector<SurfaceMap>& maps);

}  // namespace tread
