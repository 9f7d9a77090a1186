#include "drivers/report/surface_figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/engine/model/station_plan.hpp"
#include "drivers/report/figure_parts.hpp"
#include "drivers/report/patch_snapshots.hpp"

namespace tread {

namespace {

template <class Value>
Series along_axis(std::string label, const SurfaceResults& surface, const Value& value,
                  Stroke stroke = Stroke::solid) {
  Series series{std::move(label), {}, {}, stroke};
  for (const AxisNode& node : surface.axis) {
    series.x.push_back(node.x);
    series.y.push_back(value(node));
  }
  return series;
}

/// The cell of the surface that a node stands for.
Polygon cell_about(const PatchAxes& surface, const PatchWindow& window, int i, int row, double wheel_x) {
  const auto r = static_cast<std::size_t>(row);
  const auto middle = [](double a, double b) { return 0.5 * (a + b); };
  const double x0 = middle(window.x(std::max(i - 1, 0)), window.x(i)) - wheel_x;
  const double x1 = middle(window.x(i), window.x(std::min(i + 1, window.stations() - 1))) - wheel_x;
  const double y0 = middle(surface.y[r > 0 ? r - 1 : 0], surface.y[r]);
  const double y1 = middle(surface.y[r], surface.y[std::min(r + 1, surface.y.size() - 1)]);
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

PatchAxes axes(const Model& model) {
  const SurfaceGrid& grid = model.contact->nodes().grid();
  return {grid.x, grid.y};
}

std::vector<Layer> stick_and_slip(const PatchAxes& surface, const PatchSample& sample) {
  const PatchWindow window(surface, sample);
  Layer stick{"sticks", {}, {}};
  Layer slip{"slips", {}, {}};
  for (int i = 0; i < window.stations(); ++i)
    for (int row = 0; row < static_cast<int>(surface.y.size()); ++row) {
      const PatchState state = window.state(i, row);
      if (state == PatchState::out) continue;
      (state == PatchState::slip ? slip : stick)
          .cells.push_back(cell_about(surface, window, i, row, sample.wheel_x));
    }
  return {stick, slip};
}

}  // namespace

Figure surface_figure(const Model& model, const RunResults& r) {
  const SurfaceResults& s = r.surface;
  const Range way = {s.axis.front().x, s.axis.back().x};
  Figure figure = over_the_rail(
      "surface", "Largest stresses and frictional work of the passage on the patch's longitudinal axis",
      model.scene, model.contact->corrugation(), stretch_in_sight(model, way));
  figure.x_label = "Position on the rail [m]";
  figure.panels.push_back(panel(
      "Stress [MPa]",
      {along_axis("largest pressure", s, [](const AxisNode& n) { return 1e-6 * n.max_pressure; }),
       along_axis("largest Von Mises stress", s, [](const AxisNode& n) { return 1e-6 * n.max_von_mises; }),
       along_axis("largest surface shear stress", s, [](const AxisNode& n) { return 1e-6 * n.max_shear; })},
      {}, 240));
  figure.panels.push_back(
      panel("Work [mJ]",
            {along_axis("frictional work", s, [](const AxisNode& n) { return 1e3 * kWorkCell * n.work; }),
             along_axis(
                 "by samples", s, [](const AxisNode& n) { return 1e3 * kWorkCell * n.sampled_work; },
                 Stroke::dotted)},
            {}, 170));
  add_surface_panel(shown_surfaces(model, s.axis_y), 90, figure);
  figure.caption += fmt::format(
      "On the row of nodes at y = {:.1f} mm. Von Mises stress: centres of the row of surface elements that "
      "carries the largest, at samples. "
      "Frictional work of a cell of 1.1 mm x 1.1 mm: every step with the traction of its middle; by samples: "
      "the sum over the samples alone.",
      1e3 * s.axis_y);
  return figure;
}

Figure snapshots_figure(const Model& model, const RunResults& r) {
  Figure figure = snapshots_figure({axes(model), r.surface.axis_row, *model.scene.contact,
                                    shown_surfaces(model, r.surface.axis_y), r.instants});
  figure.name = "patch-instants";
  return figure;
}

Drawings stick_slip_drawings(const Model& model, const RunResults& r) {
  constexpr double kWidth = 150;  ///< five to a row [px]
  const PatchAxes surface = axes(model);
  double half = 0;
  for (const PatchSample& sample : r.instants) {
    for (const Layer& layer : stick_and_slip(surface, sample))
      for (const Polygon& cell : layer.cells)
        for (const auto& corner : cell)
          half = std::max({half, std::abs(corner[0]), std::abs(corner[1] - r.surface.axis_y)});
  }
  const double y = r.surface.axis_y;
  Drawings drawings{"stick-slip", {}};
  for (std::size_t k = 0; k < r.instants.size(); ++k)
    drawings.drawings.push_back({fmt::format("{}  x = {:.3f} m", instant_name(k), r.instants[k].wheel_x),
                                 stick_and_slip(surface, r.instants[k]),
                                 Window{{-half, y - half}, {half, y + half}}, kWidth});
  return drawings;
}

PatchMovie patch_movie(const Model& model, const RunResults& r) {
  PatchMovie movie;
  movie.name = "patch-movie";
  const bool preload = r.samples.empty();
  movie.rolls = !preload && !stands(model.scene);
  movie.title = movie.rolls ? "The patch on its way" : "The patch at rest";
  movie.x_label = "Along the rail from the wheel's axis [mm]";
  movie.y_label = "Across the rail [mm]";
  movie.labels = {"Pressure [MPa]", "Surface shear stress [MPa]", "Slip speed [mm/s]"};
  const PatchAxes surface = axes(model);
  for (const double y : surface.y) movie.y.push_back(1e3 * y);
  for (const PatchSample& sample : r.movie) {
    const PatchWindow window(surface, sample);
    MovieFrame frame;
    frame.centre = 1e3 * sample.wheel_x;
    const auto later = std::lower_bound(r.samples.begin(), r.samples.end(), sample.time - 0.5 * r.dt,
                                        [](const Sample& s, double time) { return s.time < time; });
    frame.note = fmt::format("t = {:.3f} ms, wheel at x = {:.4f} m", 1e3 * sample.time, sample.wheel_x);
    if (later != r.samples.end())
      frame.note +=
          fmt::format(", F_N {:.2f} kN, F_L {:.2f} kN, creepage {:.3f} %", 1e-3 * later->vertical_force,
                      1e-3 * later->longitudinal_force, 100 * later->creepage_mean);
    frame.fields.resize(movie.labels.size());
    for (int i = 0; i < window.stations(); ++i) {
      frame.x.push_back(1e3 * window.x(i));
      for (int row = 0; row < static_cast<int>(surface.y.size()); ++row) {
        frame.fields[0].push_back(static_cast<float>(1e-6 * window.pressure(i, row)));
        frame.fields[1].push_back(static_cast<float>(1e-6 * window.shear(i, row)));
        frame.fields[2].push_back(static_cast<float>(1e3 * window.slip_speed(i, row)));
        frame.state.push_back(static_cast<std::uint8_t>(window.state(i, row)));
      }
    }
    movie.frames.push_back(std::move(frame));
  }
  movie.caption = fmt::format(
      "Left from above{}{}; right the same as a relief, drag it to turn it. Averages at the rail's "
      "surface nodes.",
      movie.rolls ? ", rolling to the right" : "",
      preload ? "" : ": red lines part what sticks from what slips");
  return movie;
}

}  // namespace tread
