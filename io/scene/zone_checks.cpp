#include "io/scene/zone_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "io/scene/key.hpp"

namespace tread {

namespace {

void check_on_track(const Scene& scene, Require require) {
  const double left = -scene.rail->origin;
  const double right = scene.rail->length - scene.rail->origin;
  const auto check = [&](const std::string& table, const char* name, const ZoneSpec& zone) {
    require(
        zone.start >= left - kLengthTolerance && zone.end() <= right + kLengthTolerance,
        {table + ".start", table + ".length", "rail.length", "rail.origin"},
        fmt::format("{}, x = {:.6g} m to {:.6g} m, is not inside the track, {:.6g} m to {:.6g} m; move or "
                    "shorten it, or lengthen the rail",
                    name, zone.start, zone.end(), left, right));
  };
  check("solution_zone", "the solution zone", scene.solution_zone());
  for (const auto& [name, zone] : scene.zones) check(std::string(kZoneTables) + name, "the zone", zone);
}

/// A tyre is not divided finely at two places that coincide after a turn.
void check_turn(const Scene& scene, Require require) {
  double first = scene.solution_zone().start, last = scene.solution_zone().end();
  std::vector<std::string> keys;
  for (const auto& [name, zone] : scene.zones) {
    first = std::min(first, zone.start);
    last = std::max(last, zone.end());
    keys.push_back(std::string(kZoneTables) + name + ".start");
  }
  const double most = 0.9 * std::numbers::pi * scene.wheel->diameter;
  require(
      last - first < most, keys,
      fmt::format("the zones lie over {:.6g} m of the rail; those of a tyre have to lie within nine tenths "
                  "of a turn, {:.6g} m: move them together, or leave one out",
                  last - first, most));
}

}  // namespace

void check_zones(const Scene& scene, Require require) {
  if (!scene.rail || !scene.wheel) return;
  check_on_track(scene, require);
  if (!scene.zones.empty() && scene.wheel->shape == "tyre") check_turn(scene, require);
}

}  // namespace tread
