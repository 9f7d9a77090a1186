#include "drivers/results/resolution.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/geometry/point_scatter.hpp"
#include "core/travel.hpp"
#include "drivers/engine/sections.hpp"
#include "drivers/engine/surfaces.hpp"

namespace tread {

namespace {

/// Elements across the patch below which nodal pressures are more than about 10 % low. [contact-choices.md]
constexpr double kElementsOfPatch = 4;
/// Elements a wave below which F_N is more than about 4 % off. [dial.md]
constexpr double kElementsOfWave = 10;
/// Slope of the corrugation above which its depth is no small change of a smooth rail.
constexpr double kSlope = 0.05;
/// Step at an end of a table of depths that a measured rail does not have [m].
constexpr double kStep = 5e-6;

/// Sentence on the duration that lets the wheel roll to x [m].
std::string way_to(const Scene& scene, double x) {
  const std::optional<double> duration = duration_to(scene, x);
  if (!duration) return "the brakes stop it before";
  const std::string text = fmt::format("motion.duration = \"{:.4g} ms\" passes it", 1e3 * *duration);
  const double lacking = x + kRailEndMargin - (scene.rail->length - scene.rail->origin);
  return lacking > 0 ? fmt::format("{} on a rail {:.2g} m longer", text, lacking + 0.1) : text;
}

/// Sentence if a rolling wheel starts ahead of `aim`, or does not come to x = `enough` [m] of it.
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

/// Sentence if a wheel does not roll over what the scene evaluates.
std::string place_warning(const Scene& scene) {
  std::string what = "the solution zone";
  Span place{scene.zone_start, scene.solution_zone().end()};
  double enough = place.first;
  const char* lost = "the run leaves no stresses";
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

/// Sentence where a corrugation lies under the wheel at rest, or only there: the static state has a smooth
/// rail.
std::string start_warning(const Model& model) {
  constexpr double kHardly = 0.1;  // of the Hertz approach
  constexpr int kSamples = 20;     // over the patch
  const Scene& scene = model.scene;
  if (!scene.motion)
    return "[corrugation] acts on a rolling wheel alone: without [motion] the rail is smooth; state it as "
           "[surface.NAME], which the static state has";
  const double line = scene.corrugation->centre.value_or(0);
  const Corrugation corrugation = corrugation_of(*scene.corrugation, line);
  const double half = model.hertz_patch.semi_axis_x;
  double deepest = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const double depth = corrugation.depth(scene.start_x() + half * (2.0 * i / kSamples - 1), line);
    if (std::abs(depth) > std::abs(deepest)) deepest = depth;
  }
  if (std::abs(deepest) <= kHardly * model.hertz_patch.approach) return "";
  return fmt::format(
      "the corrugation is {:.3g} um deep under the wheel at its start, x = {:.4g} m, where the static state "
      "has a smooth rail: F_N jumps; let corrugation.start lie {:.3g} mm ahead, or state it as "
      "[surface.NAME], which the static state has",
      1e6 * deepest, scene.start_x(), 2e3 * half);
}

/// Length of the shorter axis of the patch [m].
double shorter_axis(const Model& model) {
  if (model.line_width > 0 && model.wheel_load() > 0)
    return std::min(2 * model.line_semi_axis(), model.line_width);
  return 2 * std::min(model.hertz_patch.semi_axis_x, model.hertz_patch.semi_axis_y);
}

std::string patch_warning(const Model& model) {
  const std::optional<double> across = too_few_elements_across_patch(model);
  if (!across) return "";
  const double shorter = shorter_axis(model);
  return fmt::format(
      "the contact patch has {:.1f} elements across ({:.3g} mm of Hertz on elements of {:.3g} mm): "
      "below {:g}, pressures and stresses are too low and slip, shear and creepage are not resolved; "
      "scene.element_size = \"{:.2g} mm\" resolves it",
      *across, 1e3 * shorter, 1e3 * model.sizes.contact, kElementsOfPatch, 1e3 * shorter / kElementsOfPatch);
}

/// Shortest wave of the corrugation [m].
double shortest_wave(const CorrugationSpec& corrugation) {
  return corrugation.kind == "random" ? corrugation.shortest : corrugation.wavelength;
}

/// Sentence where a length has too few elements; `part`: what to resolve.
std::string length_warning(const std::string& what, double length, double element, const char* part) {
  if (length / element >= kElementsOfWave) return "";
  return fmt::format(
      "{} has {:.1f} elements ({:.3g} mm on elements of {:.3g} mm): below {:g}, "
      "forces are off by several per cent; scene.element_size = \"{:.2g} mm\" resolves {}",
      what, length / element, 1e3 * length, 1e3 * element, kElementsOfWave, 1e3 * length / kElementsOfWave,
      part);
}

std::string slope_warning(const CorrugationSpec& corrugation) {
  const double slope = std::numbers::pi * corrugation.depth / corrugation.wavelength;
  if (corrugation.kind != "sine" || slope <= kSlope) return "";
  return fmt::format(
      "the corrugation rises by {:.2g} of its length ({:.3g} mm deep, {:.3g} mm long): above {:g} it is no "
      "roughness of a rail; look at the units of corrugation.depth",
      slope, 1e3 * corrugation.depth, 1e3 * corrugation.wavelength, kSlope);
}

/// Across: the faces of the rail that the wheel can touch.
Span touchable(const Model& model) {
  const SurfaceProfile& rail = model.contact->surfaces().rail_profile();
  const auto [first, last] = model.contact->searching().edges();
  return {rail.edge_p(first, 0), rail.edge_p(last - 1, 1)};
}

/// Outer rows of a map that are not zero are steps, where the wheel can touch them.
std::string side_warning(const Model& model) {
  const CorrugationSpec& corrugation = *model.scene.corrugation;
  if (corrugation.map_y.empty()) return "";
  const std::vector<double>& depth = corrugation.table_depth;
  const Span touched = touchable(model);
  const auto deepest = [&](double y, auto begin, auto end) {
    double most = 0;
    if (y <= touched.first || y >= touched.last) return most;
    for (; begin != end; ++begin) most = std::max(most, std::abs(*begin));
    return most;
  };
  const auto places = std::ssize(corrugation.table_x);
  const double sides[] = {deepest(corrugation.map_y.front(), depth.begin(), depth.begin() + places),
                          deepest(corrugation.map_y.back(), depth.end() - places, depth.end())};
  if (std::max(sides[0], sides[1]) <= kStep) return "";
  return fmt::format(
      "the outer rows of {}, y = {:.3g} and {:.3g} mm, are up to {:.3g} and {:.3g} um deep: beside them the "
      "depth is 0, so that the rail has a step along each; let both rows fade to 0",
      corrugation.file, 1e3 * corrugation.map_y.front(), 1e3 * corrugation.map_y.back(), 1e6 * sides[0],
      1e6 * sides[1]);
}

/// Depth that begins or ends beside zero is a step in the rail.
std::string step_warning(const CorrugationSpec& corrugation) {
  const std::vector<double>& depth = corrugation.table_depth;
  if (depth.empty()) return "";
  double first = 0;
  double last = 0;
  const std::size_t places = corrugation.table_x.size();
  for (std::size_t row = 0; row < depth.size(); row += places) {  // a map has several
    first = std::max(first, std::abs(depth[row]));
    last = std::max(last, std::abs(depth[row + places - 1]));
  }
  if (std::max(first, last) <= kStep) return "";
  return fmt::format(
      "the depths of {} begin with {:.3g} um and end with {:.3g} um: beyond the file the depth is 0, "
      "so that the rail has a step there; let both ends fade to 0",
      corrugation.file, 1e6 * first, 1e6 * last);
}

/// Shortest length that a shape changes in [m]; nothing where it is measured.
std::optional<double> shortest_length(const SurfaceSpec& spec, double radius) {
  if (spec.kind == "dent") return std::min(spec.length, spec.width);
  if (spec.kind == "waves") return spec.wavelength;
  if (spec.kind == "polygon") return 2 * std::numbers::pi * radius / spec.order;
  if (spec.kind == "dip" || spec.kind == "flat") return spec.length;
  return std::nullopt;
}

bool is_short(const SurfaceSpec& spec) {
  return spec.kind == "dent" || spec.kind == "flat" || spec.kind == "dip";
}

/// Sentence where a dent lies beside all faces that the wheel can touch.
std::string dent_warning(const Model& model, const std::string& name, const SurfaceSpec& spec) {
  if (spec.kind != "dent") return "";
  const Span touched = touchable(model);
  const Span dent{spec.centre - 0.5 * spec.width, spec.centre + 0.5 * spec.width};
  if (dent.last > touched.first && dent.first < touched.last) return "";
  return fmt::format(
      "surface.{} lies at y = {:.3g} to {:.3g} mm, beside what the wheel can touch, y = {:.3g} to "
      "{:.3g} mm, and has no effect; change surface.{}.centre",
      name, 1e3 * dent.first, 1e3 * dent.last, 1e3 * touched.first, 1e3 * touched.last, name);
}

/// Sentence where a shape of the rail, or a short one of the wheel, is not met on the way, or not as a whole.
std::string unmet_warning(const Scene& scene, const std::string& name, const SurfaceSpec& spec) {
  const DepthBounds bounds = shape_of(scene, spec)->bounds();
  const Span place{spec.at + bounds.first, spec.at + bounds.last};
  if (!spec.on_wheel()) {
    return is_short(spec)
               ? way_warning(scene, "surface." + name, place, place.last, "its forces are incomplete")
               : way_warning(scene, "surface." + name, place, place.first, "it has no effect");
  }
  if (!is_short(spec) || !scene.motion || scene.motion->speed <= 0) return "";
  const Span way = run_span(scene);
  if (!places_of(scene, spec, way).empty()) return "";
  return fmt::format(
      "surface.{} meets the rail at x = {:.4g} to {:.4g} m and once a turn, {:.4g} m; the wheel touches it "
      "from x = {:.4g} to {:.4g} m, so that it has no effect; change surface.{}.at or motion.duration",
      name, place.first, place.last, std::numbers::pi * scene.wheel->diameter, way.first, way.last, name);
}

std::string surface_warning(const Model& model, const std::string& name, const SurfaceSpec& spec) {
  const Scene& scene = model.scene;
  const std::vector<ZoneSpec> zones = scene.all_zones();
  if (std::string unmet = unmet_warning(scene, name, spec); !unmet.empty()) return unmet;
  const bool is_detail = is_short(spec) || (spec.kind == "map" && !spec.on_wheel());
  if (is_detail && scene.motion) {
    const std::vector<Span> places = places_of(scene, spec, run_span(scene));
    const auto outside = [&](const Span& place) {
      return std::all_of(zones.begin(), zones.end(), [&](const ZoneSpec& zone) {
        return place.last < zone.start || place.first > zone.end();
      });
    };
    if (!places.empty() && std::all_of(places.begin(), places.end(), outside))
      return fmt::format(
          "surface.{} meets the rail at x = {:.6g} to {:.6g} m, outside the solution zone, {:.6g} to {:.6g} "
          "m: the "
          "elements there are too coarse for it; change surface.{}.at or solution_zone.start, or add a table "
          "[zone.{}] with start and length",
          name, places.front().first, places.front().last, zones.front().start, zones.front().end(), name,
          name);
  }
  const std::optional<double> length = shortest_length(spec, model.wheel_radius());
  return length ? length_warning("surface." + name, *length, model.sizes.contact, "it") : "";
}

/// Sentence where the rail's head is of another stiffness or density than the beams that stand for the rail.
std::string head_warning(const Scene& scene) {
  constexpr double kAlike = 0.01;
  if (scene.start() != "rolling") return "";
  const Material& head = scene.head_material();
  const Material& rail = scene.rail_material();
  const auto alike = [](double a, double b) { return std::abs(a - b) <= kAlike * b; };
  if (alike(head.youngs_modulus, rail.youngs_modulus) && alike(head.density, rail.density)) return "";
  return "the start of a rolling wheel takes a rail of rail.material alone: a head of another Young's "
         "modulus "
         "or density makes F_N swing at first; let the wheel roll further before the corrugation";
}

/// Sentence where a profile's points scatter. `table`: "wheel" or "rail".
std::string profile_warning(const char* table, const std::vector<double>& y, const std::vector<double>& z) {
  const double scatter = point_scatter(y, z).value_or(0);
  if (scatter < kRoughProfile) return "";
  return fmt::format(
      "the points of {}.profile scatter by {:.2g} um about a smooth line, and pressures with them; "
      "{}.profile_smoothing = \"{:.2g} mm\" smooths it",
      table, 1e6 * scatter, table, 1e3 * smoothing_of(scatter));
}

/// Sentence where the histories have hardly a sample.
std::string history_warning(const Scene& scene) {
  constexpr double kFewest = 10;
  if (!scene.motion || scene.motion->duration >= kFewest * scene.output.history_interval) return "";
  return fmt::format(
      "output.history_interval = {:.4g} ms gives fewer than {:g} samples of a run of {:.4g} ms: state a "
      "shorter one",
      1e3 * scene.output.history_interval, kFewest, 1e3 * scene.motion->duration);
}

}  // namespace

std::optional<double> too_few_elements_across_patch(const Model& model) {
  const double across = shorter_axis(model) / model.sizes.contact;
  if (!model.contact || across <= 0 || across >= kElementsOfPatch) return std::nullopt;
  return across;
}

std::vector<std::string> resolution_warnings(const Model& model) {
  std::vector<std::string> warnings;
  if (!model.contact) return warnings;
  warnings.push_back(history_warning(model.scene));
  const WheelSpec& wheel = *model.scene.wheel;
  const RailSpec& rail = *model.scene.rail;
  warnings.push_back(profile_warning("wheel", wheel.profile_y, wheel.profile_z));
  warnings.push_back(profile_warning("rail", rail.profile_y, rail.profile_z));
  warnings.push_back(head_warning(model.scene));
  warnings.push_back(patch_warning(model));
  warnings.push_back(place_warning(model.scene));
  for (const auto& [name, zone] : model.scene.zones)
    warnings.push_back(way_warning(model.scene, fmt::format("zone.{}", name), {zone.start, zone.end()},
                                   zone.start, "its elements have no effect on the rail"));
  if (model.scene.corrugation) warnings.push_back(start_warning(model));
  if (const std::optional<CorrugationSpec>& corrugation = model.scene.corrugation;
      corrugation && corrugation->in_file()) {
    warnings.push_back(step_warning(*corrugation));
    warnings.push_back(side_warning(model));
  } else if (corrugation) {
    warnings.push_back(length_warning("a wave of the corrugation", shortest_wave(*corrugation),
                                      model.sizes.contact, "the wave"));
    warnings.push_back(slope_warning(*corrugation));
  }
  for (const auto& [name, spec] : model.scene.surfaces) {
    warnings.push_back(dent_warning(model, name, spec));
    warnings.push_back(surface_warning(model, name, spec));
  }
  std::erase(warnings, "");
  return warnings;
}

}  // namespace tread
