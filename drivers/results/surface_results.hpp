#pragma once
// What the passage leaves on the rail's surface: on the patch's longitudinal axis, in figures, in files.

#include <filesystem>
#include <vector>

#include "core/math/statistics.hpp"
#include "kernels/contact/surface_fields.hpp"

namespace tread {

/// A surface cell of the paper's mesh, 1.1 mm x 1.1 mm: frictional work is stated for one [m2].
/// [paper, section 3.3]
inline constexpr double kPaperCell = 1.1e-3 * 1.1e-3;

/// A node on the patch's longitudinal axis.
struct AxisNode {
  double x = 0;              ///< [m]
  double max_pressure = 0;   ///< [Pa]
  double max_shear = 0;      ///< [Pa]
  double max_von_mises = 0;  ///< in the row of elements that carries the largest [Pa]
  double work = 0;           ///< frictional, every step [J/m2]
  double sampled_work = 0;   ///< frictional, by samples [J/m2]
};

/// The figures hold for a stretch that the patch has passed from end to end; zero if there is none.
struct SurfaceResults {
  int axis_row = 0;            ///< of the grid: where the pressure is largest
  double axis_y = 0;           ///< [m]
  std::vector<AxisNode> axis;  ///< of the stations that were in contact
  double first = 0, last = 0;  ///< the stretch [m]
  bool covers(const AxisNode& node) const { return node.x >= first && node.x <= last; }

  double max_pressure = 0, max_shear = 0, max_von_mises = 0;  ///< of the whole width [Pa]
  double max_work = 0;                                        ///< of the whole width [J/m2]
  Statistics von_mises;                                       ///< on the axis [Pa]
  Statistics cell_work, sampled_cell_work;                    ///< on the axis, in kPaperCell [J]
  double total_work = 0, total_sampled_work = 0;              ///< of the whole passage and width [J]
};

/// With the figures of the stretch [first, last] [m].
SurfaceResults surface_results(const SurfaceFields& fields, double first, double last);

/// The fields of the stations that were in contact, with coordinates and units.
void write_surface(const std::filesystem::path& path, const SurfaceFields& fields);

/// A row per node of the axis.
void write_axis(const std::filesystem::path& path, const SurfaceResults& surface);

}  // namespace tread
