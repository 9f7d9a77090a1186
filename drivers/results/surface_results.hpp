#pragma once
// Effects of the passage on the rail's surface: on the patch's longitudinal axis, as summary values and as
// files.

#include <filesystem>
#include <vector>

#include "core/math/statistics.hpp"
#include "io/files/hdf5_file.hpp"
#include "kernels/contact/surface_fields.hpp"

namespace tread {

/// The surface cell, 1.1 mm x 1.1 mm, for which frictional work is stated [m2]. [paper, section 3.3]
inline constexpr double kWorkCell = 1.1e-3 * 1.1e-3;

/// A node on the patch's longitudinal axis.
struct AxisNode {
  double x = 0;              ///< [m]
  double max_pressure = 0;   ///< [Pa]
  double max_shear = 0;      ///< stress in the row of elements that carries the largest [Pa]
  double max_von_mises = 0;  ///< in the row of elements that carries the largest [Pa]
  double work = 0;           ///< frictional work, every step [J/m2]
  double sampled_work = 0;   ///< frictional work, by samples [J/m2]
};

/// Surface on the axis and summary values. The values hold for a stretch that the patch has passed from end
/// to end; zero if there is none.
struct SurfaceResults {
  int axis_row = 0;            ///< row of the grid with the largest pressure
  double axis_y = 0;           ///< [m]
  std::vector<AxisNode> axis;  ///< nodes of the stations that were in contact
  double first = 0, last = 0;  ///< ends of the stretch [m]
  bool covers(const AxisNode& node) const { return node.x >= first && node.x <= last; }

  double max_pressure = 0, max_shear = 0, max_von_mises = 0;  ///< of the whole width [Pa]
  double max_work = 0;                                        ///< of the whole width [J/m2]
  Statistics von_mises;                                       ///< on the axis [Pa]
  Statistics cell_work, sampled_cell_work;                    ///< on the axis, in kWorkCell [J]
  double total_work = 0, total_sampled_work = 0;              ///< of the whole passage and width [J]
};

/// Results with the values of the stretch [first, last] [m].
SurfaceResults surface_results(const SurfaceFields& fields, double first, double last);

/// Writes the fields of the stations that were in contact, with coordinates and units.
void write_surface(const std::filesystem::path& path, const SurfaceFields& fields,
                   const Hdf5Attributes& attributes = {});

/// Writes a row per node of the axis.
void write_axis(const std::filesystem::path& path, const SurfaceResults& surface);

}  // namespace tread
