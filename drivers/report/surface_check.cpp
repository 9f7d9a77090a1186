#include "drivers/report/surface_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "drivers/engine/model/surfaces.hpp"
#include "drivers/results/run_results.hpp"

namespace tread {

namespace {

/// y from which to which a shape reaches [m]; nothing for one that is alike all across.
std::optional<Span> reach_across(const SurfaceSpec& spec) {
  if (spec.kind == "dent") return Span{spec.centre - spec.width / 2, spec.centre + spec.width / 2};
  if (spec.kind == "map") return Span{spec.centre + spec.file_y.front(), spec.centre + spec.file_y.back()};
  return std::nullopt;
}

/// Place on the surface [m].
struct SurfacePlace {
  double x, y;
};

/// The deepest point of a file; nothing for other shapes.
std::optional<SurfacePlace> deepest_of_file(const SurfaceSpec& spec) {
  if (spec.file_depth.empty()) return std::nullopt;
  const auto at = static_cast<std::size_t>(std::max_element(spec.file_depth.begin(), spec.file_depth.end()) -
                                           spec.file_depth.begin());
  const std::size_t columns = spec.file_x.size();
  return SurfacePlace{spec.at + spec.file_x[at % columns],
                      spec.file_y.empty() ? 0 : spec.centre + spec.file_y[at / columns]};
}

}  // namespace

std::string surface_text(const Scene& scene, const std::string& name, const SurfaceSpec& spec) {
  const DepthBounds bounds = shape_of(scene, spec)->bounds();
  std::string text =
      fmt::format("{}: {} on the {}, depths of {:.4g} to {:.4g} mm, ", name, spec.kind,
                  spec.on_wheel() ? "wheel" : "rail", -1e3 * bounds.highest + 0.0, 1e3 * bounds.deepest);
  const std::vector<Span> places = places_of(scene, spec, run_span(scene));
  if (places.empty()) return text + "which the run does not meet";
  text += "x =";
  for (const Span& place : places)
    text +=
        fmt::format("{} {:.4g} to {:.4g} m", &place == &places.front() ? "" : ",", place.first, place.last);
  const std::optional<Span> across = reach_across(spec);
  if (across) text += fmt::format(", y = {:.4g} to {:.4g} mm", 1e3 * across->first, 1e3 * across->last);
  if (const std::optional<SurfacePlace> place = deepest_of_file(spec)) {
    text += fmt::format(", deepest at x = {:.4g} m", place->x);
    if (across) text += fmt::format(", y = {:.4g} mm", 1e3 * place->y);
  }
  return text;
}

Json surface_shape_json(const Scene& scene, const std::string& name, const SurfaceSpec& spec) {
  const DepthBounds bounds = shape_of(scene, spec)->bounds();
  Json json = {{"name", name},
               {"kind", spec.kind},
               {"on", spec.on_wheel() ? "wheel" : "rail"},
               {"depth_m", {-bounds.highest + 0.0, bounds.deepest}},
               {"x_m", Json::array()}};
  for (const Span& place : places_of(scene, spec, run_span(scene)))
    json["x_m"].push_back({place.first, place.last});
  const std::optional<Span> across = reach_across(spec);
  if (across) json["y_m"] = {across->first, across->last};
  if (const std::optional<SurfacePlace> place = deepest_of_file(spec)) {
    json["deepest_x_m"] = place->x;
    if (across) json["deepest_y_m"] = place->y;
  }
  return json;
}

}  // namespace tread
