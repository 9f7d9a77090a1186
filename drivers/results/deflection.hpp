#pragma once
// The rail's surface about the wheel, at rest and rolling. [paper, Fig. 7]

#include <filesystem>
#include <vector>

#include "io/report/report.hpp"
#include "kernels/contact/rail_line.hpp"

namespace tread {

/// Vertical displacement of the running surface on the patch's longitudinal axis, by distance from the wheel.
struct Deflection {
  std::vector<double> x;        ///< distance from the wheel, -0.5 to 0.5 [m]
  std::vector<double> at_rest;  ///< static displacement [m]
  std::vector<double> rolling;  ///< displacement while rolling [m]
  double static_x = 0;          ///< place of the wheel at rest [m]
  double wheel_x = 0;           ///< place of the wheel when rolling() was noted [m]

  /// Asymmetry of a displacement within 0.1 m of the wheel [-]: root mean square of the odd part over that of
  /// the even part. The even part counts from its value at 0.1 m.
  static double asymmetry(const std::vector<double>& displacement);
};

/// `static_x`: Scene::start_x().
Deflection deflection(const RailLine& line, double static_x);

/// Writes a table with the columns x_from_wheel, static, rolling [m].
void write_deflection(const std::filesystem::path& path, const Deflection& deflection);

Figure deflection_figure(const Deflection& deflection);

}  // namespace tread
