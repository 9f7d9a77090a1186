#include "drivers/report/figure_parts.hpp"

#include <algorithm>
#include <utility>

#include "drivers/engine/model/station_plan.hpp"

namespace tread {

Panel panel(std::string y_label, std::vector<Series> series, std::vector<Marker> levels, double height) {
  return {std::move(y_label), std::move(series), std::move(levels), height, std::nullopt};
}

void mark_track(const Scene& scene, const Corrugation& corrugation, const Range& range, Figure& figure) {
  if (!corrugation.smooth() && corrugation.first() < range[1])
    figure.bands.push_back({corrugation.first(), corrugation.last(), "corrugation"});
  if (!scene.fastenings || !scene.rail) return;
  for (int i = 0; i < scene.fastenings->count; ++i) {
    const double x = scene.fastening_x(i);
    if (x > range[0] && x < range[1]) figure.positions.push_back({x, ""});
  }
  if (!figure.positions.empty()) figure.caption += "Vertical lines: fastenings. ";
}

double signed_friction(double f, double longitudinal_force, double load) {
  return longitudinal_force < -0.01 * f * load ? -f : f;
}

bool over_time(const Model& model) {
  return !model.contact || stands(model.scene);
}

std::vector<double> abscissae_of(const Model& model, const RunResults& r) {
  const bool times = over_time(model);
  std::vector<double> all;
  for (const Sample& sample : r.samples) all.push_back(times ? 1e3 * sample.time : sample.wheel_x);
  return all;
}

Range whole_way(const Model& model, const RunResults& r) {
  const std::vector<double> all = abscissae_of(model, r);
  const auto [first, last] = std::ranges::minmax_element(all);
  return {*first, *last};
}

Figure over_the_rail(std::string name, std::string title, const Scene& scene, const Corrugation& corrugation,
                     const Range& range) {
  Figure figure;
  figure.name = std::move(name);
  figure.title = std::move(title);
  figure.x_label = "Position of the wheel [m]";
  figure.x_range = range;
  mark_track(scene, corrugation, range, figure);
  return figure;
}

Figure over_the_way(std::string name, std::string title, const Model& model, const RunResults& r) {
  const Range way = whole_way(model, r);
  if (!over_time(model))
    return over_the_rail(std::move(name), std::move(title), model.scene, model.contact->corrugation(), way);
  Figure figure;
  figure.name = std::move(name);
  figure.title = std::move(title);
  figure.x_label = "Time [ms]";
  figure.x_range = way;
  return figure;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

ShownSurfaces shown_surfaces(const Model& model, double y) {
  const SurfacePair& pair = model.contact->surfaces();
  return {pair.corrugation(), pair.rail_depth(), pair.wheel_depth(), y};
}

std::vector<Series> running_surfaces(const ShownSurfaces& surfaces, const Range& range) {
  std::vector<Series> list;
  const auto add = [&](const char* name, const auto& depth) {
    constexpr int kPoints = 800;
    Series series{name, {}, {}, list.empty() ? Stroke::solid : Stroke::dashed};
    for (int i = 0; i <= kPoints; ++i) {
      const double x = range[0] + (range[1] - range[0]) * i / kPoints;
      series.x.push_back(x);
      series.y.push_back(-1e3 * depth(x));
    }
    list.push_back(std::move(series));
  };
  const SurfaceDepths depths{surfaces.corrugation.view(), surfaces.rail.view(), surfaces.wheel.view()};
  if (!surfaces.corrugation.smooth() || !surfaces.rail.smooth())
    add("rail's surface", [&](double x) { return depths.rail(x, surfaces.y); });
  if (!surfaces.wheel.smooth())
    add("wheel's surface that meets it",
        [&](double x) { return depths.wheel_depth.at(x, surfaces.y).depth; });
  return list;
}

void add_surface_panel(const ShownSurfaces& surfaces, double height, Figure& figure) {
  if (std::vector<Series> series = running_surfaces(surfaces, *figure.x_range); !series.empty())
    figure.panels.push_back(panel("Surface [mm]", std::move(series), {}, height));
}

Range stretch_in_sight(const Model& model, const Range& way) {
  const Range seen = stretch_in_sight(model.scene, model.contact->corrugation(), way);
  return seen[0] < seen[1] ? seen : way;
}

Range stretch_in_sight(const Scene& scene, const Corrugation& corrugation, const Range& way) {
  const Range range = corrugation.smooth() ? Range{scene.zone_start, scene.zone_start + scene.zone_length}
                                           : Range{corrugation.first() - 0.12, corrugation.last() + 0.08};
  return {std::max(range[0], way[0]), std::min(range[1], way[1])};
}

}  // namespace tread
