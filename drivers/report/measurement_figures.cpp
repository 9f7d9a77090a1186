#include "drivers/report/measurement_figures.hpp"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "drivers/report/figure_parts.hpp"

namespace tread {

namespace {

/// Factor by which Hann's window w spreads the mean square of a sine over lines: n sum(w2) / sum(w)2 [-].
constexpr double kHannSpread = 1.5;

/// Factor from SI to the unit in which a figure shows a column.
double shown(const std::string& unit) {
  if (unit == "m" || unit == "Pa" || unit == "N") return unit == "m" ? 1e3 : unit == "Pa" ? 1e-6 : 1e-3;
  return 1;
}

Series curve(std::string label, const Model& model, const RunResults& r, std::size_t column) {
  Series series{std::move(label), abscissae_of(model, r), {}, Stroke::solid};
  const double scale = shown(r.measured.channels()[column].channel.unit);
  for (std::size_t i = 0; i < r.samples.size(); ++i) series.y.push_back(scale * r.measured.row(i)[column]);
  return series;
}

/// Curves of the columns "<name>_<part>".
std::vector<Series> curves(const std::string& name, const std::vector<std::string>& parts, const Model& model,
                           const RunResults& r) {
  std::vector<Series> list;
  list.reserve(parts.size());
  for (const std::string& part : parts)
    list.push_back(curve(part.substr(part.rfind('_') + 1), model, r,
                         r.measured.column(fmt::format("{}_{}", name, part))));
  return list;
}

Figure probe_figure(const std::string& name, const ProbeSpec& probe, const Model& model,
                    const RunResults& r) {
  Figure figure = over_the_way("probe-" + name, "Probe " + name, model, r);
  if (probe.has_motion())
    for (const auto& [label, part] :
         {std::pair("Displacement [mm]", "displacement"), std::pair("Velocity [m/s]", "velocity"),
          std::pair("Acceleration [m/s²]", "acceleration")}) {
      // Along the rail the axle box moves by metres, across and up by a millimetre.
      std::vector<std::string> parts = {std::string(part) + "_y", std::string(part) + "_z"};
      if (probe.body != "axle_box") parts.insert(parts.begin(), std::string(part) + "_x");
      figure.panels.push_back(panel(label, curves(name, parts, model, r), {}, 150));
    }
  if (probe.has_stress())
    figure.panels.push_back(panel(
        "Stress [MPa]",
        curves(name,
               {"stress_xx", "stress_yy", "stress_zz", "stress_yz", "stress_zx", "stress_xy", "von_mises"},
               model, r),
        {}, 220));
  if (probe.has_motion()) figure.caption += "Accelerations are means over the interval between two samples.";
  return figure;
}

/// Columns whose names are numbered from 1 on.
std::vector<std::size_t> numbered(const MeasuredRows& measured, const char* pattern) {
  std::vector<std::size_t> columns;
  for (int k = 1;; ++k) {
    const std::size_t c = measured.column(fmt::format(fmt::runtime(pattern), k));
    if (c == measured.columns()) return columns;
    columns.push_back(c);
  }
}

/// Forces of the fastenings about the evaluated stretch, without a wheel about the blow.
Figure fastening_figure(const Model& model, const RunResults& r) {
  Figure figure = over_the_way("fastening-forces", "Forces of the fastenings on the rail", model, r);
  std::vector<Series> series;
  const double spacing = model.scene.fastenings->spacing;
  const double blow = model.scene.hammer ? model.scene.hammer->position : 0;
  const double first = (model.contact ? r.evaluated_first : blow) - spacing;
  const double last = (model.contact ? r.evaluated_last : blow) + spacing;
  for (const std::size_t c : numbered(r.measured, "fastening_{:02}_force")) {
    const double x = r.measured.channels()[c].at;
    if (x >= first && x <= last) series.push_back(curve(fmt::format("x = {:.3f} m", x), model, r, c));
  }
  figure.panels.push_back(panel("Force upwards [kN]", std::move(series), {}, 240));
  return figure;
}

Figure depth_figure(const Model& model, const RunResults& r) {
  Series largest{"largest over the evaluated stretch", {}, {}, Stroke::solid};
  Series mean{"mean over it", {}, {}, Stroke::dashed};
  for (const std::size_t c : numbered(r.measured, "von_mises_below_{:02}")) {
    const Statistics s = measured_statistics(model, r, c);
    for (Series* series : {&largest, &mean}) series->x.push_back(1e3 * r.measured.channels()[c].at);
    largest.y.push_back(1e-6 * s.max);
    mean.y.push_back(1e-6 * s.mean);
  }
  Figure figure;
  figure.name = "stress-over-depth";
  figure.title = "Von Mises stress under the patch";
  figure.x_label = "Depth below the running surface [mm]";
  figure.panels = {panel("Stress [MPa]", {std::move(largest), std::move(mean)}, {}, 240)};
  figure.caption = "Of the rail's elements under the centre of the preload's patch, the largest along it.";
  return figure;
}

}  // namespace

Figure spectrum_figure(const RunResults& results) {
  const ForceSpectrum& spectrum = results.spectrum;
  Figure figure;
  if (spectrum.square.empty()) return figure;
  figure.name = "spectrum";
  figure.title = "Spectrum of F_N over the evaluated stretch";
  figure.x_label = "Frequency [Hz]";
  figure.x_range = Range{0, spectrum.spacing * static_cast<double>(spectrum.square.size() - 1)};
  Series lines{"amplitude of a sine on the line", {}, {}, Stroke::solid};
  for (std::size_t k = 1; k < spectrum.square.size(); ++k) {
    lines.x.push_back(spectrum.spacing * static_cast<double>(k));
    lines.y.push_back(1e-3 * std::sqrt(2 * kHannSpread * spectrum.square[k]));
  }
  Series octaves{"root mean square in one-third octaves", {}, {}, Stroke::solid};
  for (std::size_t i = 0; i < spectrum.bands.size(); ++i)
    for (const double edge : {spectrum.bands[i].low(), spectrum.bands[i].high()}) {
      octaves.x.push_back(edge);
      octaves.y.push_back(1e-3 * spectrum.rms[i]);
    }
  figure.panels = {panel("F_N [kN]", {std::move(lines)}, {}, 200)};
  for (const ForceSine& ripple : results.ripples)
    figure.positions.push_back({ripple.frequency, fmt::format("{:.3g} mm", 1e3 * ripple.length)});
  if (!octaves.x.empty()) figure.panels.push_back(panel("F_N [kN]", {std::move(octaves)}, {}, 160));
  figure.caption =
      "Mean and trend taken off, Hann's window: a sine between two lines shows up to 15 % less than its "
      "amplitude. Bands are at least four lines wide: a sine leaks from narrower ones into their neighbours.";
  if (!results.ripples.empty())
    figure.caption += " Vertical lines: frequencies at which elements of these lengths pass.";
  return figure;
}

Chapter measurement_chapter(const Model& model, const RunResults& r) {
  Chapter chapter{"Measurements", {}};
  if (r.measured.columns() == 0 || r.samples.empty()) return chapter;
  for (const auto& [name, probe] : model.scene.probes)
    chapter.blocks.emplace_back(probe_figure(name, probe, model, r));
  if (model.scene.output.fastening_forces && model.fastenings)
    chapter.blocks.emplace_back(fastening_figure(model, r));
  if (model.scene.output.stress_depth && model.contact) chapter.blocks.emplace_back(depth_figure(model, r));
  return chapter;
}

}  // namespace tread
