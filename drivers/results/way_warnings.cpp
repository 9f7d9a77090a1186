#include "drivers/results/way_warnings.hpp"

#include <fmt/core.h>

#include <cmath>
#include <optional>

#include "core/travel.hpp"
#include "drivers/engine/sections.hpp"
#include "io/scene/rail_reach.hpp"

namespace tread {

namespace {

/// Sentence on the duration that lets the wheel roll to x [m].
std::string way_to(const Scene& scene, double x) {
  const std::optional<double> duration = duration_to(scene, x);
  if (!duration) return "the brakes stop it before";
  const std::string text = fmt::format("motion.duration = \"{:.4g} ms\" passes it", 1e3 * *duration);
  const bool on_rail = x + kRailEndMargin <= scene.rail->length - scene.rail->origin;
  if (on_rail) return text;
  return fmt::format("{}, with {}", text,
                     keys_to_reach(scene, x).value_or("a longer rail than there may be"));
}

/// Sentence if a wheel does not roll over what the scene evaluates.
std::string place_warning(const Scene& scene) {
  std::string what = "the solution zone";
  Span place{scene.zone_start, scene.solution_zone().end()};
  double enough = place.first;
  const char* lost = "the run's values are those of the way from the start";
  if (scene.corrugation) {
    const Corrugation corrugation = corrugation_of(*scene.corrugation, 0);
    what = "the corrugation";
    place = {corrugation.first(), corrugation.last()};
    enough = place.last;
    lost = "values over it are incomplete";
  }
  if (place.last <= scene.start_x()) lost = "nothing is evaluated: its values in the summary are no results";
  return way_warning(scene, what, place, enough, lost);
}

/// Sentence where the wheel rolls more than a span beyond the outer fastenings, where others have room.
std::string fastening_warning(const Scene& scene) {
  if (!scene.fastenings) return "";
  const FasteningSpec& f = *scene.fastenings;
  const Travel way = travel_of(scene);
  const double first = scene.fastening_x(0), last = scene.fastening_x(f.count - 1);
  const double span = f.spacing + 0.5 * f.pad_length;
  if (way.last > last + span)
    return fmt::format(
        "the wheel comes to x = {:.4g} m, but the last fastening stands at x = {:.4g} m, so that nothing "
        "carries the rail beyond it; state fastenings.count = {}",
        way.last, last, most_fastenings(f, scene.rail->length));
  if (way.first >= first - span) return "";
  const double more = std::floor((f.first - 0.5 * f.pad_length) / f.spacing);
  return fmt::format(
      "the wheel rolls from x = {:.4g} m on, but the first fastening stands at x = {:.4g} m, so that nothing "
      "carries the rail ahead of it; state fastenings.first = \"{:.6g} m\" and fastenings.count = {:g}",
      way.first, first, f.first - more * f.spacing, f.count + more);
}

}  // namespace

std::string way_warning(const Scene& scene, const std::string& what, const Span& aim, double enough,
                        const char* lost) {
  if (!scene.motion) return "";
  if (aim.last <= scene.start_x())
    return fmt::format(
        "the wheel starts at x = {:.4g} m, ahead of {}, x = {:.4g} to {:.4g} m, so that {}; let it lie ahead "
        "of the start",
        scene.start_x(), what, aim.first, aim.last, lost);
  if (scene.motion->speed <= 0) return "";
  const double way = travel_of(scene).last;
  if (way >= enough) return "";
  return fmt::format(
      "the wheel rolls to x = {:.4g} m and does not {} {}, x = {:.4g} to {:.4g} m, so that {}; {}", way,
      way > aim.first ? "pass" : "reach", what, aim.first, aim.last, lost, way_to(scene, aim.last));
}

void add_way_warnings(const Scene& scene, std::vector<std::string>& warnings) {
  warnings.push_back(place_warning(scene));
  for (const auto& [name, zone] : scene.zones)
    warnings.push_back(way_warning(scene, fmt::format("zone.{}", name), {zone.start, zone.end()}, zone.start,
                                   "its elements have no effect on the rail"));
  warnings.push_back(fastening_warning(scene));
}

}  // namespace tread
