#include "io/scene/surface_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "io/scene/key.hpp"
#include "io/scene/rail_reach.hpp"
#include "io/scene/surface_file.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

void check_surface(const Scene& scene, const std::string& table, const SurfaceSpec& surface,
                   Require require) {
  require(scene.contact.has_value(), {table}, "depths of a running surface need [contact]");
  if (!scene.contact || !scene.wheel || !scene.rail) return;
  if (surface.kind == "waves")
    require(surface.wavelength <= surface.length + kLengthTolerance,
            {table + ".wavelength", table + ".length"},
            fmt::format("not one wave of {} fits into the length of {}; state a smaller wavelength or a "
                        "larger length",
                        format_quantity(surface.wavelength, "mm"), format_quantity(surface.length, "mm")));
  if (!surface.on_wheel()) {
    if (surface.file_x.empty())
      return check_on_rail(*scene.rail, surface.at, {table + ".at", table}, "the depth's place", require);
    const double first = surface.at + surface.file_x.front(), last = surface.at + surface.file_x.back();
    return check_on_rail(*scene.rail, first, last, {table + ".at", table + ".file", table},
                         fmt::format("the file's depths, x = {:.6g} m to {:.6g} m, are", first, last),
                         require);
  }
  const double diameter = scene.wheel->diameter;
  const double turn = std::numbers::pi * diameter;
  if (surface.kind == "flat")
    require(surface.length <= 0.5 * diameter, {table + ".length", "wheel.diameter"},
            fmt::format(
                "a chord of {:.4g} mm on a wheel of {:.4g} mm is no flat; state at most half the diameter",
                1e3 * surface.length, 1e3 * diameter));
  if (surface.kind == "flat" && surface.length <= 0.5 * diameter) {
    const double depth = 0.5 * (diameter - std::sqrt(diameter * diameter - surface.length * surface.length));
    require(depth <= kDeepestSurface, {table + ".length", "wheel.diameter"},
            fmt::format("a chord of {:.4g} mm is {:.3g} mm deep on a wheel of {:.4g} mm; at most {:g} mm are "
                        "possible: state a shorter one",
                        1e3 * surface.length, 1e3 * depth, 1e3 * diameter, 1e3 * kDeepestSurface));
  }
  const bool measured = surface.kind == "profile" || surface.kind == "map";
  if (surface.kind == "polygon" || (measured && surface.file_x.empty())) return;
  const double length = measured ? surface.file_x.back() - surface.file_x.front() : surface.length;
  require(length <= turn * (1 + 1e-6), {table + (measured ? ".file" : ".length"), table},
          fmt::format("the depth is {:.6g} m long, the wheel's circumference {:.6g} m; shorten the depth",
                      length, turn));
}

}  // namespace

void check_surfaces(const Scene& scene, Require require) {
  for (const auto& [name, surface] : scene.surfaces)
    check_surface(scene, std::string(kSurfaceTables) + name, surface, require);
}

}  // namespace tread
