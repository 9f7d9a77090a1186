#pragma once
// Stress in the rail, a half-space z > 0, under tractions on its surface. [Love, Phil. Trans. R. Soc. A 228
// (1929) 377; Johnson, Contact Mechanics, sect. 3.2 and 3.6]

#include "kernels/half_space/half_space_rolling.hpp"

namespace tread::half_space {

/// Stress [Pa]; x along the rail, y across, z down; tension positive.
struct Stress {
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, xz = 0;
};

double von_mises(const Stress& stress);

/// Load on the rail's surface: pressure and the opposite of the tractions on the wheel; fields on `grid`
/// [Pa].
struct SurfaceLoad {
  const Grid& grid;
  const std::vector<double>& pressure;
  const Tractions& on_wheel;
  double poissons_ratio;
};

/// Stress at x, y and depth z > 0 [m], in closed form.
Stress rail_stress(const SurfaceLoad& load, double x, double y, double z);

struct Box {
  double x = 0, y = 0, top = 0;              ///< middle of the upper face; its depth >= 0 [m]
  double length = 0, width = 0, height = 0;  ///< sizes along x, y, z [m]
};

/// Mean stress over a box, by Gauss points: the stress that a one-point element of that size can show.
Stress mean_rail_stress(const SurfaceLoad& load, const Box& box);

/// Largest Von Mises stress [Pa] of the mean stresses over boxes within `reach` [m] of `box` along x.
double largest_box_stress(const SurfaceLoad& load, const Box& box, double reach);

}  // namespace tread::half_space
