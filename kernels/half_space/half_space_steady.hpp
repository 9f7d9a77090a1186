#pragma once
// Steady rolling of an elliptic contact on half-spaces, as summary values. [Kalker, ch. 4]

#include <cstddef>
#include <optional>
#include <vector>

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
  double force = 0;  ///< F_L [N]
};

struct SteadyCreepage {
  double mean = 0;   ///< [-]
  double error = 0;  ///< standard error of the mean over the mean, by the grids' scatter [-]
};

/// Grids of steady_creepage() that must converge.
inline constexpr std::size_t kLeastGrids = 6;

/// Mean of the creepages of grids, without those that did not converge. NumericalError below kLeastGrids.
SteadyCreepage mean_of_grids(const std::vector<std::optional<double>>& grids);

/// Creepage of steady rolling: the mean of twelve grids, of 22 to 44 cells along a semi-axis, in parallel. A
/// cell is in contact or not, slips or sticks as a whole, so single grids scatter by 1 %, and slip of second
/// order leaves little trend. Sets of grids differ by 0.2 % at 0.6 of full sliding, 0.6 % at 0.9, mostly
/// upward with finer ones; scatter alone understates it. [docs/records/verification.md]
/// The grids take 1.5 s of one core at 0.6 of full sliding, 3.5 s at 0.95 and half a minute at 0.98.
/// NumericalError as mean_of_grids().
SteadyCreepage steady_creepage(const SteadyCase& steady);

}  // namespace tread::half_space
