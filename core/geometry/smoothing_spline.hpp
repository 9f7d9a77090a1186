#pragma once
// Smoothing of measured points by a cubic spline.

#include <vector>

namespace tread {

/// Replaces the points (y, z) by those of the smoothest cubic spline over the chord length that leaves no
/// point farther than `largest` [m], and returns the distance of each point from its old place [m]. At least
/// 4 points, no two successive ones alike. [Reinsch, Numer. Math. 10 (1967) 177]
std::vector<double> smooth(std::vector<double>& y, std::vector<double>& z, double largest);

}  // namespace tread
