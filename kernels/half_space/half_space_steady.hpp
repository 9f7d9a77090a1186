#pragma once
// Steady rolling of an elliptic contact on half-spaces, as summary values. [Kalker, ch. 4]

#include "kernels/half_space/half_space_rolling.hpp"

namespace tread::half_space {

/// Work per passage [J] of a square surface element of side `element` [m] centred on y = 0.
double centre_element_work(const Grid& grid, const FrictionState& state, double element);

/// Elliptic contact that rolls steadily.
struct SteadyCase {
  Material material;
  double radius_x = 0, radius_y = 0;  ///< radii of the gap, positive [m]
  double load = 0;                    ///< F_N [N]
  double friction_coefficient = 0;
  double force = 0;    ///< F_L [N]
  double element = 0;  ///< side of the surface element of `element_work` [m]
};

struct SteadySummary {
  double creepage = 0;
  double slip_fraction = 0;
  double max_shear = 0;     ///< [Pa]
  double work = 0;          ///< [J] per metre rolled
  double element_work = 0;  ///< [J] per passage
};

/// Summary of steady rolling on square cells of side `cell` [m].
SteadySummary steady_summary(const SteadyCase& steady, double cell);
/// Limit of fine grids: the line over the size of the cells, by least squares, through twelve grids of `cell`
/// to `cell` / 2 [m]. A cell is in contact or not, slips or sticks as a whole, so values of single grids
/// scatter about the line; creepage by 0.3 % from cells of a tenth of the shorter semi-axis.
SteadySummary extrapolated_summary(const SteadyCase& steady, double cell);

}  // namespace tread::half_space
