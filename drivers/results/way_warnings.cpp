#include "drivers/results/way_warnings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/travel.hpp"
#include "drivers/engine/beam/beam_section.hpp"
#include "drivers/engine/model/evaluated_stretch.hpp"
#include "drivers/engine/model/sections.hpp"
#include "drivers/engine/start/rail_beam.hpp"
#include "drivers/results/rail_ends.hpp"
#include "io/scene/rail_reach.hpp"

namespace tread {

namespace {

/// Sentence on the duration with which the wheel surely rolls to x [m].
std::string way_to(const Model& model, double x) {
  const std::optional<double> duration = duration_to(model.scene, x);
  if (!duration) return "motion.traction may stop it or turn it back before";
  const std::string text = fmt::format("motion.duration = \"{:.4g} ms\" passes it", 1e3 * *duration);
  Scene longer = model.scene;
  longer.motion->duration = *duration;
  const std::string keys =
      keys_for_way(model, travel_of(longer).last).value_or("a longer rail than there may be");
  return keys.empty() ? text : fmt::format("{}, with {}", text, keys);
}

/// Sentence if a wheel does not roll over what the scene evaluates.
std::string place_warning(const Model& model) {
  const Scene& scene = model.scene;
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
  return way_warning(model, what, place, enough, lost);
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

/// Sentence where a table of friction that varies lies beyond all that the wheel touches.
std::string friction_table_warning(const Scene& scene) {
  const ContactSpec& contact = *scene.contact;
  if (contact.friction_law != "table" || contact.least_friction() == contact.largest_friction()) return "";
  const double first = contact.friction_start + contact.friction_x.front();
  const double last = contact.friction_start + contact.friction_x.back();
  const Span way = run_span(scene);
  if (first < way.last && last > way.first) return "";
  return fmt::format(
      "contact.friction_file covers x = {:.4g} to {:.4g} m, but the wheel touches the rail from x = {:.4g} "
      "to {:.4g} m: f is constant there, {:.4g}; change contact.friction_start",
      first, last, way.first, way.last,
      first < way.last ? contact.friction_at_x.back() : contact.friction_at_x.front());
}

/// Distance over which the rail's deflection dies away on its fastenings: three times the characteristic
/// length of a beam on an elastic foundation [m].
double bent_length(const Scene& scene) {
  const BeamProperties beam = timoshenko(rail_beam_section(scene), scene.rail_material());
  double compliance = 1 / scene.fastenings->stiffness;
  if (scene.sleepers) compliance += 1 / scene.sleepers->stiffness;
  const double foundation = 1 / (compliance * scene.fastenings->spacing);
  return 3 * std::pow(4 * beam.bending_stiffness / foundation, 0.25);
}

/// Sentence where F_N is evaluated so near to the rail's right end that the end bends under the wheel.
std::string rail_end_warning(const Model& model) {
  const Scene& scene = model.scene;
  if (!scene.fastenings || scene.fastenings->stiffness <= 0 || !scene.motion || stands(scene)) return "";
  const Corrugation corrugation = scene.corrugation ? corrugation_of(*scene.corrugation, 0) : Corrugation{};
  const double last = std::min(evaluated_stretch(scene, corrugation).last, travel_of(scene).last);
  const double end = scene.rail->length - scene.rail->origin;
  const double enough = bent_length(scene);
  if (end - last >= enough) return "";
  const double length = 0.1 * std::ceil(10 * (scene.rail->origin + last + enough));
  return fmt::format(
      "the rail ends at x = {:.4g} m, {:.3g} m beyond the evaluated way, and bends over {:.3g} m on its "
      "fastenings: its end changes F_N; state rail.length = \"{:.4g} m\" and fastenings.count = {}",
      end, end - last, enough, length, most_fastenings(*scene.fastenings, length));
}

/// Sentence where traction acts on a rail that its ends alone hold along x.
std::string free_foot_warning(const Scene& scene) {
  if (!scene.fastenings || scene.fastenings->along.kind != "free" || !scene.motion) return "";
  const MotionSpec& motion = *scene.motion;
  if (motion.traction_mu.value_or(0) == 0 && motion.traction_torque.value_or(0) == 0) return "";
  return fmt::format(
      "fastenings.along = \"free\" under motion.traction: its ends alone hold the rail of {:.4g} m along x, "
      "so that F_L, creepage and frictional work depend on rail.length; state fastenings.along = \"held\" or "
      "\"elastic\"",
      scene.rail->length);
}

}  // namespace

std::string way_warning(const Model& model, const std::string& what, const Span& aim, double enough,
                        const char* lost) {
  const Scene& scene = model.scene;
  if (!scene.motion) return "";
  if (aim.last <= scene.start_x())
    return fmt::format(
        "the wheel starts at x = {:.4g} m, ahead of {}, x = {:.4g} to {:.4g} m, so that {}; let it lie ahead "
        "of the start",
        scene.start_x(), what, aim.first, aim.last, lost);
  if (stands(scene)) return "";
  const Travel way = travel_of(scene);
  if (way.sure >= enough) return "";
  const bool may = way.sure < way.last;
  return fmt::format("the wheel {} x = {:.4g} m and {} {} {}, x = {:.4g} to {:.4g} m, so that {}; {}",
                     may ? "may roll only to" : "rolls to", way.sure, may ? "may not" : "does not",
                     way.sure > aim.first ? "pass" : "reach", what, aim.first, aim.last, lost,
                     way_to(model, aim.last));
}

void add_way_warnings(const Model& model, std::vector<std::string>& warnings) {
  const Scene& scene = model.scene;
  warnings.push_back(place_warning(model));
  for (const auto& [name, zone] : scene.zones)
    warnings.push_back(way_warning(model, fmt::format("zone.{}", name), {zone.start, zone.end()}, zone.start,
                                   "its elements have no effect on the rail"));
  warnings.push_back(fastening_warning(scene));
  warnings.push_back(friction_table_warning(scene));
  warnings.push_back(rail_end_warning(model));
  warnings.push_back(free_foot_warning(scene));
}

}  // namespace tread
