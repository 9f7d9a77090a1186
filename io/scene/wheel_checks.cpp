#include "io/scene/wheel_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "core/geometry/built_in_profiles.hpp"
#include "core/mesh/wheel_shape.hpp"
#include "core/travel.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

bool has_arc(const WheelSpec& wheel) {
  return wheel.profile == "arc" || wheel.profile == "cylinder";
}

/// A part of a ring: the tread that meets the rail, which is longer than the way where the wheel spins faster
/// than it rolls, and the overhang on both sides.
void check_overhang(const Scene& scene, const WheelSpec& wheel, Require require) {
  if (!wheel.overhang) return;
  require(scene.gravity == 0, {"wheel.overhang", "scene.gravity"},
          "a part of a ring is not balanced about its axle; state scene.gravity = \"0 m/s2\", or leave "
          "the overhang out");
  const double way = scene.motion ? scene.motion->speed * scene.motion->duration : 0;
  const double spin = scene.motion ? std::max(1.0, scene.motion->spin_ratio()) : 1;
  const double most = kLargestPart * std::numbers::pi * wheel.diameter - 2 * *wheel.overhang;
  const std::string reason =
      way < most
          ? fmt::format(", because motion.creepage makes it spin {:.3g} times as fast as free rolling", spin)
          : "";
  require(way * spin < most, {"wheel.overhang", "motion.duration", "motion.creepage"},
          fmt::format("the wheel rolls on most of its ring{}; leave the overhang out", reason));
}

void check_tyre(const Scene& scene, const WheelSpec& wheel, Require require) {
  require(has_arc(wheel), {"wheel.profile", "wheel.shape"},
          "a tyre has the profile arc or cylinder; state one of them, or wheel.shape = \"half_wheelset\"");
  require(wheel.thickness < wheel.diameter / 2, {"wheel.thickness", "wheel.diameter"},
          fmt::format("a ring of {} has no hole in a wheel of {}; state a smaller wheel.thickness",
                      format_quantity(wheel.thickness, "mm"), format_quantity(wheel.diameter, "mm")));
  require(wheel.profile != "arc" || wheel.width < 2 * wheel.crown_radius,
          {"wheel.width", "wheel.crown_radius", "wheel.profile"},
          fmt::format("a ring of {} is wider than the arc of its profile, {}; state a smaller wheel.width, a "
                      "larger wheel.crown_radius or wheel.profile = \"cylinder\"",
                      format_quantity(wheel.width, "mm"), format_quantity(2 * wheel.crown_radius, "mm")));
  const bool guided = wheel.bore == "guided";
  require(!guided || !scene.vehicle, {"wheel.bore", "vehicle"},
          "a guided bore carries a load, not a vehicle; state [load] and vehicle.present = false");
  require(!guided || scene.rail, {"wheel.bore", "rail"},
          "a guided bore rolls on a rail; add [rail], or state wheel.bore = \"free\"");
  check_overhang(scene, wheel, require);
}

void check_web_file(const WheelSpec& wheel, Require require) {
  require(
      !wheel.web_thickness && !wheel.brake_rings && wheel.web_offset == 0 && wheel.web_wave == 0,
      {"wheel.web_thickness", "wheel.brake_rings", "wheel.web_offset", "wheel.web_wave", "wheel.web"},
      "the file of wheel.web holds the whole web; leave out wheel.web_thickness, web_offset, web_wave and "
      "brake_rings");
  try {
    if (!wheel.web_r.empty()) WebOutline(wheel.web_y, wheel.web_r);
  } catch (const InputError& error) {
    require(false, {"wheel.web"}, error.what());
  }
}

void check_dimensions(const WheelSpec& wheel, Require require) {
  WheelShape shape;
  shape.diameter = wheel.diameter;
  shape.lateral_offset = wheel.lateral_offset;
  shape.axle_bore = wheel.axle_bore;
  for (const ShapeFault& fault : shape.faults()) require(false, {fault.key, "wheel.shape"}, fault.message);
}

void check_half_wheelset(const WheelSpec& wheel, Require require) {
  check_dimensions(wheel, require);
  require(!has_arc(wheel), {"wheel.profile", "wheel.shape"},
          fmt::format(
              "a half wheelset has the profile {} or a file; state one of them, or wheel.shape = \"tyre\"",
              fmt::join(kBuiltInWheels, ", ")));
  require(!wheel.brake_rings || (wheel.web_offset == 0 && wheel.web_wave == 0),
          {"wheel.brake_rings", "wheel.web_offset", "wheel.web_wave"},
          "brake rings are bolted to a straight web; state wheel.brake_rings = false, or leave out "
          "wheel.web_offset and wheel.web_wave");
  if (wheel.web != "stated") check_web_file(wheel, require);
}

}  // namespace

void check_wheel(const Scene& scene, Require require) {
  if (!scene.wheel) return;
  if (scene.wheel->shape == "tyre")
    check_tyre(scene, *scene.wheel, require);
  else
    check_half_wheelset(*scene.wheel, require);
}

}  // namespace tread
