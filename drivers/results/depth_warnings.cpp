#include "drivers/results/depth_warnings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "drivers/engine/model/sections.hpp"
#include "drivers/engine/model/surfaces.hpp"
#include "drivers/results/way_warnings.hpp"
#include "io/scene/resolving_size.hpp"

namespace tread {

namespace {

/// Elements a wave below which F_N is more than about 4 % off. [dial.md]
constexpr double kElementsOfWave = 10;
/// Slope of the corrugation above which its depth is no small change of a smooth rail.
constexpr double kSlope = 0.05;
/// The same of a defect; a flat of 50 mm has 0.06, a severe squat 0.1.
constexpr double kSlopeOfDefect = 0.2;
/// The bound of a curve through places over its steepest secant (MonotoneCubic::steepest).
constexpr double kBoundOverSecants = 2;
/// Step at an end of a table of depths that a measured rail does not have [m].
constexpr double kStep = 5e-6;

/// Sentence where a corrugation lies under the wheel at rest, or only there: the static state has a smooth
/// rail.
std::string start_warning(const Model& model, const Corrugation& corrugation) {
  constexpr double kHardly = 0.1;  // of the Hertz approach
  constexpr int kSamples = 20;     // over the patch
  const Scene& scene = model.scene;
  if (!scene.motion)
    return "[corrugation] acts on a rolling wheel alone: without [motion] the rail is smooth; state it as "
           "[surface.NAME], which the static state has";
  const double half = model.hertz_patch.semi_axis_x;
  double deepest = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const double depth =
        corrugation.depth(scene.start_x() + half * (2.0 * i / kSamples - 1), corrugation.centre());
    if (std::abs(depth) > std::abs(deepest)) deepest = depth;
  }
  if (std::abs(deepest) <= kHardly * model.hertz_patch.approach) return "";
  return fmt::format(
      "the corrugation is {:.3g} um deep under the wheel at its start, x = {:.4g} m, where the static state "
      "has a smooth rail: F_N jumps; let corrugation.start lie {:.3g} mm ahead, or state it as "
      "[surface.NAME], which the static state has",
      1e6 * deepest, scene.start_x(), 2e3 * half);
}

/// Sentence where a length has too few elements; `part`: what to resolve.
std::string length_warning(const std::string& what, double length, double element, const char* part) {
  if (length / element >= kElementsOfWave) return "";
  return fmt::format(
      "{} has {:.1f} elements ({:.3g} mm on elements of {:.3g} mm): below {:g}, "
      "forces are off by several per cent; {}",
      what, length / element, 1e3 * length, 1e3 * element, kElementsOfWave,
      resolving_size(length / kElementsOfWave, part));
}

/// Sentence where a slope is so steep that depths may be in a wrong unit; `key`: that states them.
std::string slope_warning(const std::string& what, double slope, double bound, const std::string& key) {
  if (slope <= bound) return "";
  return fmt::format(
      "{} has a slope of {:.2g}: above {:g} its depth is no small change of a smooth surface; look at the "
      "units of {}",
      what, slope, bound, key);
}

/// Key that states how deep a corrugation is.
const char* depth_key(const CorrugationSpec& corrugation) {
  if (corrugation.in_file()) return "corrugation.file";
  return corrugation.kind == "random" ? "corrugation.rms" : "corrugation.depth";
}

/// Across: the faces of the rail that the wheel can touch.
Span touchable(const Model& model) {
  const SurfaceProfile& rail = model.contact->surfaces().rail_profile();
  const auto [first, last] = model.contact->searching().edges();
  return {rail.edge_p(first, 0), rail.edge_p(last - 1, 1)};
}

/// Across: the corrugation, about its stated centre or y = 0.
Span span_across(const CorrugationSpec& corrugation) {
  const double centre = corrugation.centre.value_or(0);
  if (corrugation.map_y.empty()) return {centre - corrugation.width, centre + corrugation.width};
  return {centre + corrugation.map_y.front(), centre + corrugation.map_y.back()};
}

/// Across: a dent, or the rows of a map; none where a shape is the same all across.
std::optional<Span> span_across(const SurfaceSpec& spec) {
  if (spec.kind == "dent") return Span{spec.centre - 0.5 * spec.width, spec.centre + 0.5 * spec.width};
  if (spec.kind == "map") return Span{spec.centre + spec.file_y.front(), spec.centre + spec.file_y.back()};
  return std::nullopt;
}

/// Sentence where depths lie beside all faces that the wheel can touch. `table`: that states their centre.
std::string beside_warning(const Model& model, const std::string& table, const Span& depths,
                           const char* effect) {
  const Span touched = touchable(model);
  if (depths.last > touched.first && depths.first < touched.last) return "";
  return fmt::format(
      "{} lies at y = {:.3g} to {:.3g} mm, beside what the wheel can touch, y = {:.3g} to {:.3g} mm, and {}; "
      "change {}.centre",
      table, 1e3 * depths.first, 1e3 * depths.last, 1e3 * touched.first, 1e3 * touched.last, effect, table);
}

/// Outer rows of a map that are not zero are steps, where the wheel can touch them.
std::string side_warning(const Model& model) {
  const CorrugationSpec& corrugation = *model.scene.corrugation;
  if (corrugation.map_y.empty()) return "";
  const std::vector<double>& depth = corrugation.table_depth;
  const Span rows = span_across(corrugation);
  const Span touched = touchable(model);
  const auto deepest = [&](double y, auto begin, auto end) {
    double most = 0;
    if (y <= touched.first || y >= touched.last) return most;
    for (; begin != end; ++begin) most = std::max(most, std::abs(*begin));
    return most;
  };
  const auto places = std::ssize(corrugation.table_x);
  const double sides[] = {deepest(rows.first, depth.begin(), depth.begin() + places),
                          deepest(rows.last, depth.end() - places, depth.end())};
  if (std::max(sides[0], sides[1]) <= kStep) return "";
  return fmt::format(
      "the outer rows of {}, y = {:.3g} and {:.3g} mm, are up to {:.3g} and {:.3g} um deep: beside them the "
      "depth is 0, so that the rail has a step along each; let both rows fade to 0",
      corrugation.file, 1e3 * rows.first, 1e3 * rows.last, 1e6 * sides[0], 1e6 * sides[1]);
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

/// Sentence where a shape of the rail, or a short one of the wheel, is not met on the way, or not as a whole.
std::string unmet_warning(const Model& model, const std::string& name, const SurfaceSpec& spec) {
  const Scene& scene = model.scene;
  const DepthBounds bounds = shape_of(scene, spec)->bounds();
  const Span place{spec.at + bounds.first, spec.at + bounds.last};
  if (!spec.on_wheel()) {
    return is_short(spec)
               ? way_warning(model, "surface." + name, place, place.last, "its forces are incomplete")
               : way_warning(model, "surface." + name, place, place.first, "it has no effect");
  }
  if (!is_short(spec) || stands(scene)) return "";
  const Span way = run_span(scene);
  if (!places_of(scene, spec, way).empty()) return "";
  return fmt::format(
      "surface.{} meets the rail at x = {:.4g} to {:.4g} m and once a turn, {:.4g} m; the wheel touches it "
      "from x = {:.4g} to {:.4g} m, so that it has no effect; change surface.{}.at or motion.duration",
      name, place.first, place.last, std::numbers::pi * scene.wheel->diameter, way.first, way.last, name);
}

std::string coarse_surface_warning(const Model& model, const std::string& name, const SurfaceSpec& spec) {
  const std::optional<double> length = shortest_length(spec, model.wheel_radius());
  return length ? length_warning("surface." + name, *length, model.sizes.contact, "it") : "";
}

/// Sentences where the corrugation has too few elements along or across.
void add_coarse_corrugation(const Model& model, std::vector<std::string>& warnings) {
  const CorrugationSpec& spec = *model.scene.corrugation;
  const double element = model.sizes.contact;
  if (!spec.in_file())
    warnings.push_back(
        length_warning("a wave of the corrugation", spec.shortest_wave(), element, "the wave"));
  if (spec.kind != "map")
    warnings.push_back(length_warning("the width of the corrugation", 2 * spec.width, element, "it"));
}

std::string surface_warning(const Model& model, const std::string& name, const SurfaceSpec& spec) {
  const Scene& scene = model.scene;
  const std::vector<ZoneSpec> zones = scene.all_zones();
  if (std::string unmet = unmet_warning(model, name, spec); !unmet.empty()) return unmet;
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
          "m: the elements there are too coarse for it; change surface.{}.at or solution_zone.start, or add "
          "a "
          "table [zone.{}] with start and length",
          name, places.front().first, places.front().last, zones.front().start, zones.front().end(), name,
          name);
  }
  return coarse_surface_warning(model, name, spec);
}

void add_corrugation_warnings(const Model& model, std::vector<std::string>& warnings) {
  const CorrugationSpec& spec = *model.scene.corrugation;
  const Corrugation corrugation = corrugation_of(spec, spec.centre.value_or(0));
  warnings.push_back(start_warning(model, corrugation));
  if (spec.centre)
    warnings.push_back(beside_warning(model, "corrugation", span_across(spec), "has no effect"));
  if (spec.in_file()) {
    warnings.push_back(step_warning(spec));
    warnings.push_back(side_warning(model));
  }
  add_coarse_corrugation(model, warnings);
  const double bound = corrugation.steepest();
  warnings.push_back(slope_warning("the corrugation", spec.kind == "sine" ? bound : bound / kBoundOverSecants,
                                   kSlope, depth_key(spec)));
}

void add_surface_warnings(const Model& model, const std::string& name, const SurfaceSpec& spec,
                          std::vector<std::string>& warnings) {
  const std::string table = "surface." + name;
  if (const std::optional<Span> depths = span_across(spec))
    warnings.push_back(beside_warning(
        model, table, *depths, spec.kind == "map" ? "its outer row alone has an effect" : "has no effect"));
  warnings.push_back(surface_warning(model, name, spec));
  if (spec.kind == "flat") return;  // its chord is as steep as it is
  const double bound = shape_of(model.scene, spec)->bounds().steepest;
  if (spec.file_x.empty())
    warnings.push_back(slope_warning(table, bound, kSlopeOfDefect, table + ".depth"));
  else
    warnings.push_back(slope_warning(table, bound / kBoundOverSecants, kSlopeOfDefect, table + ".file"));
}

}  // namespace

std::vector<std::string> coarse_depth_warnings(const Model& model) {
  std::vector<std::string> warnings;
  if (model.scene.corrugation) add_coarse_corrugation(model, warnings);
  for (const auto& [name, spec] : model.scene.surfaces)
    warnings.push_back(coarse_surface_warning(model, name, spec));
  std::erase(warnings, "");
  return warnings;
}

void add_depth_warnings(const Model& model, std::vector<std::string>& warnings) {
  if (model.scene.corrugation) add_corrugation_warnings(model, warnings);
  for (const auto& [name, spec] : model.scene.surfaces) add_surface_warnings(model, name, spec, warnings);
}

}  // namespace tread
