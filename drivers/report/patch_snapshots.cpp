#include "drivers/report/patch_snapshots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace tread {

namespace {

constexpr int kInstants = 10;  ///< [paper, Fig. 16]
constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

/// The place of the sample within the span whose pressure comes first by `before`.
template <class Before>
std::optional<double> extreme(const std::vector<double>& x, const std::vector<double>& pressure,
                              const Span& span, const Before& before) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i] >= span.first && x[i] <= span.last && (!found || before(pressure[i], pressure[*found])))
      found = i;
  return found ? std::optional(x[*found]) : std::nullopt;
}

/// Returns true if the node or one beside it along the rail carries pressure.
bool near_patch(const PatchWindow& window, int i, int row) {
  return window.pressure(i, row) > 0 || (i > 0 && window.pressure(i - 1, row) > 0) ||
         (i + 1 < window.stations() && window.pressure(i + 1, row) > 0);
}

/// Values on the axis at every second instant, from 0 or 1, each from node to node of its patch.
template <class Value>
Series every_second(const std::string& label, const PatchSnapshots& instants, std::size_t start,
                    const Value& value) {
  Series series{fmt::format("{} at {}, {}, ...", label, instant_name(start), instant_name(start + 2)),
                {},
                {},
                Stroke::solid};
  const int row = instants.axis_row;
  for (std::size_t k = start; k < instants.samples.size(); k += 2) {
    const PatchWindow window(instants.axes, instants.samples[k]);
    for (int i = 0; i < window.stations(); ++i) {
      series.x.push_back(window.x(i));
      series.y.push_back(near_patch(window, i, row) ? value(window, i, row) : kGap);
    }
    series.x.push_back(series.x.back());
    series.y.push_back(kGap);
  }
  return series;
}

}  // namespace

std::vector<double> even_places(const Span& stretch, int count) {
  std::vector<double> places;
  places.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
    places.push_back(stretch.first + (stretch.last - stretch.first) * (k + 0.5) / count);
  return places;
}

std::vector<double> typical_places(const Span& stretch, double wavelength, const std::vector<double>& x,
                                   const std::vector<double>& pressure) {
  const Span last_wave{std::max(stretch.first, stretch.last - wavelength), stretch.last};
  const Span inner{stretch.first + wavelength, stretch.last - 2 * wavelength};
  const std::optional<double> t4 = extreme(x, pressure, inner, std::less<>());
  if (!t4) return even_places(last_wave, kInstants);
  // The span begins or ends with t4 itself, so there is a sample in it.
  const double t1 = *extreme(x, pressure, {*t4 - wavelength, *t4}, std::greater<>());
  const double t7 = *extreme(x, pressure, {*t4, *t4 + wavelength}, std::greater<>());
  const double t10 = *extreme(x, pressure, {t7, t7 + wavelength}, std::less<>());
  std::vector<double> places;
  for (const auto& [from, to] : {std::pair{t1, *t4}, std::pair{*t4, t7}, std::pair{t7, t10}})
    for (const double part : {0.0, 1.0 / 3, 2.0 / 3}) places.push_back(from + part * (to - from));
  places.push_back(t10);
  return places;
}

std::vector<double> typical_places(const Scene& scene, const Span& stretch, double smooth_way,
                                   const std::vector<double>& x, const std::vector<double>& pressure) {
  if (scene.corrugation && scene.corrugation->kind == "sine")
    return typical_places(stretch, scene.corrugation->wavelength, x, pressure);
  return even_places({std::max(stretch.first, stretch.last - smooth_way), stretch.last}, kInstants);
}

std::string instant_name(std::size_t instant) {
  return fmt::format("t{}", instant + 1);
}

Figure snapshots_figure(const PatchSnapshots& instants) {
  Figure figure;
  figure.title = "Pressure and surface shear stress on the patch's longitudinal axis, by instant";
  figure.x_label = "Position on the rail [m]";
  const PatchWindow first(instants.axes, instants.samples.front());
  const PatchWindow last(instants.axes, instants.samples.back());
  figure.x_range = Range{first.x(0), last.x(last.stations() - 1)};
  for (std::size_t k = 0; k < instants.samples.size(); ++k)
    figure.positions.push_back({instants.samples[k].wheel_x, instant_name(k)});
  const auto curves = [&](const std::string& label, auto value) {
    std::vector<Series> series;
    for (const std::size_t start : {std::size_t{0}, std::size_t{1}})
      if (start < instants.samples.size()) series.push_back(every_second(label, instants, start, value));
    return series;
  };
  const auto pressure = [](const PatchWindow& w, int i, int row) { return 1e-6 * w.pressure(i, row); };
  const double f = instants.contact.largest_friction();
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
  add_surface_panel(instants.surfaces, 70, figure);
  figure.caption = "Nodal averages. The rail slips where the shear stress meets f p.";
  if (instants.contact.friction_law != "coulomb")
    figure.caption =
        "Nodal averages. f is the largest coefficient of friction of the law; slip begins at lower ones.";
  return figure;
}

std::string snapshots_csv(const PatchSnapshots& instants) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "instant,wheel_x [m],x [m],pressure [Pa],shear [Pa],friction_limit [Pa]\n");
  const int row = instants.axis_row;
  for (std::size_t k = 0; k < instants.samples.size(); ++k) {
    const PatchWindow window(instants.axes, instants.samples[k]);
    for (int i = 0; i < window.stations(); ++i) {
      if (!near_patch(window, i, row)) continue;
      const double pressure = window.pressure(i, row);
      fmt::format_to(out, "{},{:.6g},{:.6g},{:.5g},{:.5g},{:.5g}\n", instant_name(k),
                     instants.samples[k].wheel_x, window.x(i), pressure, window.shear(i, row),
                     instants.contact.largest_friction() * pressure);
    }
  }
  return {text.data(), text.size()};
}

}  // namespace tread
