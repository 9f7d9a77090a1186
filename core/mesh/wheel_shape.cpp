#include "core/mesh/wheel_shape.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/millimetre.hpp"

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

std::vector<ShapeFault> WheelShape::faults() const {
  std::vector<ShapeFault> list;
  const auto require = [&](const char* name, double value, double least, double most, const char* reason) {
    if (!(value >= least && value <= most))
      list.push_back({fmt::format("wheel.{}", name),
                      fmt::format("{:g} mm is outside {:g} to {:g} mm of a half wheelset: {}", value / mm,
                                  least / mm, most / mm, reason)});
  };
  require("diameter", diameter, kSmallestDiameter, kLargestDiameter,
          "rim, brake ring and hub need their room between tread and axle; wheel.shape = \"tyre\" takes "
          "other diameters");
  require("axle_bore", axle_bore, kNarrowestBore, kWidestBore,
          "the axle is swept about its axis and leaves a wall in the journal");
  require("lateral_offset", lateral_offset, -kMostAside, kMostAside, "the rail has to lie under the tread");
  require("web_thickness", web_thickness, kThinnestWeb, kThickestWeb,
          "the web has to fit between rim and hub");
  require("web_offset", web_offset, -kMostOffset, kMostOffset, "the web has to end within rim and hub");
  require("web_wave", web_wave, -kMostWave, kMostWave, "the elements of a steeper web would be skewed");
  require("brake_ring_thickness", brake_ring_thickness, 0, 0.1,
          "two rings of this thickness make up the mass");
  return list;
}

void WheelShape::check() const {
  const std::vector<ShapeFault> list = faults();
  if (!list.empty()) throw InputError(fmt::format("{}: {}", list.front().key, list.front().message));
}

}  // namespace tread
