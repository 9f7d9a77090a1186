#pragma once
// Noise of measured or rounded points about a smooth line.

#include <optional>
#include <vector>

namespace tread {

/// Standard deviation of points' z about the smooth line that they lie on [m], from the third divided
/// differences of four neighbours each, whose median leaves corners of the line aside, less the line's share,
/// told by every second point. Nothing for fewer than 20 points. `y` grows. [m]
std::optional<double> point_scatter(const std::vector<double>& y, const std::vector<double>& z);

/// Scatter of a profile's points from which pressures scatter with them [m]: rounding to 1 um raised the
/// largest pressure of S1002 by a quarter.
inline constexpr double kRoughProfile = 1e-7;

/// Deviation of a smoothing spline that such points take [m].
inline double smoothing_of(double scatter) {
  return 4 * scatter;
}

}  // namespace tread
