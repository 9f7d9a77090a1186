#include "drivers/surface_figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "drivers/figure_parts.hpp"

namespace tread {

namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

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

std::string name(std::size_t instant) {
  return fmt::format("t{}", instant + 1);
}

/// The window of an instant as the file keeps it.
class PatchWindow {
 public:
  PatchWindow(const Model& model, const PatchSample& sample)
      : nodes_(model.contact->nodes()), sample_(sample), size_(sample.state.size()) {}

  int stations() const { return nodes_.capacity(); }
  double x(int i) const {
    const auto& x = nodes_.grid().x;
    return x[std::min(static_cast<std::size_t>(sample_.first + i), x.size() - 1)];
  }
  double value(std::size_t field, int i, int row) const {
    return sample_.fields[field * size_ + nodes_.grid().node(i, row)];
  }
  double pressure(int i, int row) const { return value(0, i, row); }
  double shear(int i, int row) const { return std::hypot(value(1, i, row), value(2, i, row)); }
  double slip_speed(int i, int row) const { return std::hypot(value(3, i, row), value(4, i, row)); }
  PatchState state(int i, int row) const {
    return static_cast<PatchState>(sample_.state[nodes_.grid().node(i, row)]);
  }

 private:
  const PatchNodes& nodes_;
  const PatchSample& sample_;
  std::size_t size_;
};

/// Values on the axis at every second instant, from 0 or 1, each from node to node of its patch.
template <class Value>
Series every_second(const std::string& label, const Model& model, const RunResults& r, std::size_t start,
                    const Value& value) {
  Series series{fmt::format("{} at {}, {}, ...", label, name(start), name(start + 2)), {}, {}, Stroke::solid};
  const int row = r.surface.axis_row;
  for (std::size_t k = start; k < r.instants.size(); k += 2) {
    const PatchWindow window(model, r.instants[k]);
    for (int i = 0; i < window.stations(); ++i) {
      const bool near = window.pressure(i, row) > 0 || (i > 0 && window.pressure(i - 1, row) > 0) ||
                        (i + 1 < window.stations() && window.pressure(i + 1, row) > 0);
      series.x.push_back(window.x(i));
      series.y.push_back(near ? value(window, i, row) : kGap);
    }
    series.x.push_back(series.x.back());
    series.y.push_back(kGap);
  }
  return series;
}

/// The cell of the surface that a node stands for.
Polygon cell_about(const SurfaceGrid& grid, const PatchWindow& window, int i, int row, double wheel_x) {
  const auto r = static_cast<std::size_t>(row);
  const auto middle = [](double a, double b) { return 0.5 * (a + b); };
  const double x0 = middle(window.x(std::max(i - 1, 0)), window.x(i)) - wheel_x;
  const double x1 = middle(window.x(i), window.x(std::min(i + 1, window.stations() - 1))) - wheel_x;
  const double y0 = middle(grid.y[r > 0 ? r - 1 : 0], grid.y[r]);
  const double y1 = middle(grid.y[r], grid.y[std::min(r + 1, grid.y.size() - 1)]);
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

std::vector<Layer> stick_and_slip(const Model& model, const PatchSample& sample) {
  const SurfaceGrid& grid = model.contact->nodes().grid();
  const PatchWindow window(model, sample);
  Layer stick{"sticks", {}, {}};
  Layer slip{"slips", {}, {}};
  for (int i = 0; i < window.stations(); ++i)
    for (int row = 0; row < grid.rows(); ++row) {
      const PatchState state = window.state(i, row);
      if (state == PatchState::out) continue;
      (state == PatchState::slip ? slip : stick)
          .cells.push_back(cell_about(grid, window, i, row, sample.wheel_x));
    }
  return {stick, slip};
}

}  // namespace

Figure surface_figure(const Model& model, const RunResults& r) {
  const SurfaceResults& s = r.surface;
  const Corrugation& corrugation = model.contact->corrugation();
  Figure figure;
  figure.title = "Largest stresses and frictional work of the passage on the patch's longitudinal axis";
  figure.x_label = "Position on the rail [m]";
  const Range way = {s.axis.front().x, s.axis.back().x};
  figure.x_range = stretch_in_sight(model, way);
  if ((*figure.x_range)[0] >= (*figure.x_range)[1]) figure.x_range = way;
  mark_track(model, *figure.x_range, figure);
  figure.panels.push_back(panel(
      "Stress [MPa]",
      {along_axis("largest pressure", s, [](const AxisNode& n) { return 1e-6 * n.max_pressure; }),
       along_axis("largest Von Mises stress", s, [](const AxisNode& n) { return 1e-6 * n.max_von_mises; }),
       along_axis("largest surface shear stress", s, [](const AxisNode& n) { return 1e-6 * n.max_shear; })},
      {}, 240));
  figure.panels.push_back(
      panel("Work [mJ]",
            {along_axis("frictional work", s, [](const AxisNode& n) { return 1e3 * kPaperCell * n.work; }),
             along_axis(
                 "by samples", s, [](const AxisNode& n) { return 1e3 * kPaperCell * n.sampled_work; },
                 Stroke::dotted)},
            {}, 170));
  if (!corrugation.smooth())
    figure.panels.push_back(
        panel("Rail surface [mm]", {running_surface(corrugation, *figure.x_range)}, {}, 90));
  figure.caption += fmt::format(
      "On the row of nodes at y = {:.1f} mm. Von Mises stress: centres of the row of surface elements that "
      "carries the largest, at samples. "
      "Frictional work of a cell of 1.1 mm x 1.1 mm, the paper's surface mesh: every step with the traction "
      "of its middle; by samples as the paper sums it, eq. (5) there.",
      1e3 * s.axis_y);
  return figure;
}

Figure instants_figure(const Model& model, const RunResults& r) {
  const Corrugation& corrugation = model.contact->corrugation();
  const double f = model.scene.contact->friction;
  Figure figure;
  figure.title = "Pressure and surface shear stress on the axis at the instants below";
  figure.x_label = "Position on the rail [m]";
  const double reach = model.contact->reach();
  figure.x_range = Range{r.instants.front().wheel_x - reach, r.instants.back().wheel_x + reach};
  for (std::size_t k = 0; k < r.instants.size(); ++k)
    figure.positions.push_back({r.instants[k].wheel_x, name(k)});
  const auto curves = [&](const std::string& label, auto value) {
    std::vector<Series> series;
    for (const std::size_t start : {std::size_t{0}, std::size_t{1}})
      if (start < r.instants.size()) series.push_back(every_second(label, model, r, start, value));
    return series;
  };
  const auto pressure = [](const PatchWindow& w, int i, int row) { return 1e-6 * w.pressure(i, row); };
  const auto size = [](const PatchWindow& w, int i, int row) { return 1e-6 * w.shear(i, row); };
  figure.panels.push_back(panel("Pressure [MPa]", curves("p", pressure), {}, 190));
  std::vector<Series> shear = curves("shear stress", size);
  std::vector<Series> limit =
      curves("f p", [&](const PatchWindow& w, int i, int row) { return f * pressure(w, i, row); });
  for (Series& series : limit) {
    series.stroke = Stroke::dotted;
    shear.push_back(std::move(series));
  }
  figure.panels.push_back(panel("Shear stress [MPa]", std::move(shear), {}, 190));
  if (!corrugation.smooth())
    figure.panels.push_back(
        panel("Rail surface [mm]", {running_surface(corrugation, *figure.x_range)}, {}, 70));
  figure.caption = "Nodal averages. The rail slips where the shear stress meets f p.";
  return figure;
}

Drawings stick_slip_drawings(const Model& model, const RunResults& r) {
  constexpr double kWidth = 150;  ///< five to a row [px]
  double half = 0;
  for (const PatchSample& sample : r.instants) {
    for (const Layer& layer : stick_and_slip(model, sample))
      for (const Polygon& cell : layer.cells)
        for (const auto& corner : cell)
          half = std::max({half, std::abs(corner[0]), std::abs(corner[1] - r.surface.axis_y)});
  }
  const double y = r.surface.axis_y;
  Drawings drawings;
  for (std::size_t k = 0; k < r.instants.size(); ++k)
    drawings.push_back({fmt::format("{}  x = {:.3f} m", name(k), r.instants[k].wheel_x),
                        stick_and_slip(model, r.instants[k]), Window{{-half, y - half}, {half, y + half}},
                        kWidth});
  return drawings;
}

PatchMovie patch_movie(const Model& model, const RunResults& r) {
  PatchMovie movie;
  movie.title = "The patch on its way";
  movie.x_label = "Along the rail from the wheel's axis [mm]";
  movie.y_label = "Across the rail [mm]";
  movie.labels = {"Pressure [MPa]", "Surface shear stress [MPa]", "Slip speed [mm/s]"};
  const SurfaceGrid& grid = model.contact->nodes().grid();
  for (const double y : grid.y) movie.y.push_back(1e3 * y);
  for (const PatchSample& sample : r.movie) {
    const PatchWindow window(model, sample);
    MovieFrame frame;
    frame.centre = 1e3 * sample.wheel_x;
    const auto later = std::lower_bound(r.samples.begin(), r.samples.end(), sample.time - 0.5 * r.dt,
                                        [](const Sample& s, double time) { return s.time < time; });
    frame.note = fmt::format("t = {:.3f} ms, wheel at x = {:.4f} m", 1e3 * sample.time, sample.wheel_x);
    if (later != r.samples.end())
      frame.note +=
          fmt::format(", F_N {:.2f} kN, F_L {:.2f} kN, creepage {:.3f} %", 1e-3 * later->vertical_force,
                      1e-3 * later->longitudinal_force, 100 * later->creepage_node);
    frame.fields.resize(movie.labels.size());
    for (int i = 0; i < window.stations(); ++i) {
      frame.x.push_back(1e3 * window.x(i));
      for (int row = 0; row < grid.rows(); ++row) {
        frame.fields[0].push_back(static_cast<float>(1e-6 * window.pressure(i, row)));
        frame.fields[1].push_back(static_cast<float>(1e-6 * window.shear(i, row)));
        frame.fields[2].push_back(static_cast<float>(1e3 * window.slip_speed(i, row)));
        frame.state.push_back(static_cast<std::uint8_t>(window.state(i, row)));
      }
    }
    movie.frames.push_back(std::move(frame));
  }
  movie.caption =
      "Left from above, rolling to the right: red lines part what sticks from what slips; right the same as "
      "a "
      "relief, drag it to turn it. Averages at the rail's surface nodes.";
  return movie;
}

}  // namespace tread
