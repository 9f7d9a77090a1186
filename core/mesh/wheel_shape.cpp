#include "core/mesh/wheel_shape.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace tread {

WebLine WheelShape::web_line(double share) const {
  using std::numbers::pi;
  constexpr double kTop = 0.7698003589195010;  // the largest value of the S: 4 / (3 sqrt 3)
  const double s = share;
  const double wave = std::sin(2 * pi * s) * std::sin(pi * s);
  const double steep =
      2 * pi * std::cos(2 * pi * s) * std::sin(pi * s) + pi * std::sin(2 * pi * s) * std::cos(pi * s);
  return {web_offset * (s * s * (3 - 2 * s) - 0.5) + web_wave / kTop * wave,
          web_offset * 6 * s * (1 - s) + web_wave / kTop * steep};
}

void WheelShape::check() const {
  const auto refuse = [](const char* key, double value, double least, double most, const char* reason) {
    if (!(value >= least && value <= most))
      throw InputError(
          fmt::format("wheel.{} = {} m is outside {} ... {} m: {}", key, value, least, most, reason));
  };
  refuse("diameter", diameter, 0.66, 1.4, "rim, brake ring and hub need their room between tread and axle");
  refuse("axle_bore", axle_bore, 0.02, 0.11,
         "the axle is swept about its axis and leaves a wall in the journal");
  refuse("lateral_offset", lateral_offset, -0.03, 0.03, "the rail has to lie under the tread");
  refuse("web_thickness", web_thickness, kThinnestWeb, kThickestWeb,
         "the web has to fit between rim and hub");
  refuse("web_offset", web_offset, -kMostOffset, kMostOffset, "the web has to end within rim and hub");
  refuse("web_wave", web_wave, -kMostWave, kMostWave, "the elements of a steeper web would be skewed");
  refuse("brake_ring_thickness", brake_ring_thickness, 0, 0.1,
         "two rings of this thickness make up the mass");
}

}  // namespace tread
