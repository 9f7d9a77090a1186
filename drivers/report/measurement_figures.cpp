#include "drivers/report/measurement_figures.hpp"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "drivers/report/figure_parts.hpp"
#include "drivers/results/force_spectrum.hpp"

namespace tread {

namespace {

/// Scale and unit in which a figure shows a column.
struct Shown {
  double scale;
  const char* unit;
};

Shown shown(const std::string& unit) {
  if (unit == "m") return {1e3, "mm"};
  if (unit == "Pa") return {1e-6, "MPa"};
  if (unit == "N") return {1e-3, "kN"};
  return {1, unit == "m/s2" ? "m/s²" : "m/s"};
}

class Columns {
 public:
  Columns(const Model& model, const RunResults& results) : model_(model), r_(results) {}

  Figure figure(std::string title) const {
    Figure figure;
    figure.title = std::move(title);
    figure.x_label = model_.contact ? "Position of the wheel [m]" : "Time [ms]";
    figure.x_range = Range{abscissa(0), abscissa(r_.samples.size() - 1)};
    if (model_.contact) mark_track(model_, *figure.x_range, figure);
    return figure;
  }

  Series curve(std::string label, std::size_t column) const {
    Series series{std::move(label), {}, {}, Stroke::solid};
    const double scale = shown(r_.measured.channels()[column].channel.unit).scale;
    for (std::size_t i = 0; i < r_.samples.size(); ++i) {
      series.x.push_back(abscissa(i));
      series.y.push_back(scale * r_.measured.row(i)[column]);
    }
    return series;
  }

  /// Curves of the columns "<name>_<part>" for the parts that there are.
  std::vector<Series> curves(const std::string& name, const std::vector<std::string>& parts) const {
    std::vector<Series> list;
    for (const std::string& part : parts)
      if (const std::size_t c = r_.measured.column(name + "_" + part); c < r_.measured.columns())
        list.push_back(curve(part.substr(part.rfind('_') + 1), c));
    return list;
  }

  /// Values of a column over the evaluated stretch that are numbers, in SI.
  std::vector<double> evaluated(std::size_t column) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < r_.samples.size(); ++i) {
      const double x = r_.samples[i].wheel_x;
      const double value = r_.measured.row(i)[column];
      if (x >= r_.evaluated_first && x <= r_.evaluated_last && std::isfinite(value)) values.push_back(value);
    }
    return values;
  }

 private:
  double abscissa(std::size_t i) const {
    return model_.contact ? r_.samples[i].wheel_x : 1e3 * r_.samples[i].time;
  }

  const Model& model_;
  const RunResults& r_;
};

Figure probe_figure(const Columns& columns, const std::string& name, const ProbeSpec& probe) {
  Figure figure = columns.figure("Probe " + name);
  if (probe.has_motion())
    for (const auto& [label, part] :
         {std::pair("Displacement [mm]", "displacement"), std::pair("Velocity [m/s]", "velocity"),
          std::pair("Acceleration [m/s²]", "acceleration")}) {
      // Along the rail the axle box moves by metres, across and up by a millimetre.
      std::vector<std::string> parts = {std::string(part) + "_y", std::string(part) + "_z"};
      if (probe.body != "axle_box") parts.insert(parts.begin(), std::string(part) + "_x");
      figure.panels.push_back(panel(label, columns.curves(name, parts), {}, 150));
    }
  if (probe.has_stress())
    figure.panels.push_back(panel("Stress [MPa]",
                                  columns.curves(name, {"stress_xx", "stress_yy", "stress_zz", "stress_yz",
                                                        "stress_zx", "stress_xy", "von_mises"}),
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

/// Forces of the fastenings about the evaluated stretch.
Figure fastening_figure(const Columns& columns, const Model& model, const RunResults& r) {
  Figure figure = columns.figure("Forces of the fastenings on the rail");
  std::vector<Series> series;
  const double spacing = model.scene.fastenings->spacing;
  for (const std::size_t c : numbered(r.measured, "fastening_{:02}_force")) {
    const double x = r.measured.channels()[c].at;
    if (x >= r.evaluated_first - spacing && x <= r.evaluated_last + spacing)
      series.push_back(columns.curve(fmt::format("x = {:.3f} m", x), c));
  }
  figure.panels.push_back(panel("Force upwards [kN]", std::move(series), {}, 240));
  return figure;
}

Figure depth_figure(const Columns& columns, const RunResults& r) {
  Series largest{"largest over the evaluated stretch", {}, {}, Stroke::solid};
  Series mean{"mean over it", {}, {}, Stroke::dashed};
  for (const std::size_t c : numbered(r.measured, "von_mises_below_{:02}")) {
    const Statistics s = statistics(columns.evaluated(c));
    for (Series* series : {&largest, &mean}) series->x.push_back(1e3 * r.measured.channels()[c].at);
    largest.y.push_back(1e-6 * s.max);
    mean.y.push_back(1e-6 * s.mean);
  }
  Figure figure;
  figure.title = "Von Mises stress under the patch";
  figure.x_label = "Depth below the running surface [mm]";
  figure.panels = {panel("Stress [MPa]", {std::move(largest), std::move(mean)}, {}, 240)};
  figure.caption = "Of the rail's elements under the centre of the preload's patch, the largest along it.";
  return figure;
}

}  // namespace

Figure spectrum_figure(const RunResults& results) {
  const ForceSpectrum spectrum =
      force_spectrum(results.samples, results.evaluated_first, results.evaluated_last);
  Figure figure;
  if (spectrum.square.empty()) return figure;
  figure.title = "Spectrum of F_N over the evaluated stretch";
  figure.x_label = "Frequency [Hz]";
  figure.x_range = Range{0, spectrum.spacing * static_cast<double>(spectrum.square.size() - 1)};
  Series lines{"amplitude of the lines", {}, {}, Stroke::solid};
  for (std::size_t k = 1; k < spectrum.square.size(); ++k) {
    lines.x.push_back(spectrum.spacing * static_cast<double>(k));
    lines.y.push_back(1e-3 * std::sqrt(2 * spectrum.square[k]));
  }
  Series octaves{"root mean square in one-third octaves", {}, {}, Stroke::solid};
  for (std::size_t i = 0; i < spectrum.bands.size(); ++i)
    for (const double edge : {spectrum.bands[i].low(), spectrum.bands[i].high()}) {
      octaves.x.push_back(edge);
      octaves.y.push_back(1e-3 * spectrum.rms[i]);
    }
  figure.panels = {panel("F_N [kN]", {std::move(lines)}, {}, 200)};
  if (!octaves.x.empty()) figure.panels.push_back(panel("F_N [kN]", {std::move(octaves)}, {}, 160));
  figure.caption =
      "Mean and trend taken off, Hann's window. A band holds at least four waves of the stretch.";
  return figure;
}

Chapter measurement_chapter(const Model& model, const RunResults& r) {
  Chapter chapter{"Measurements", {}};
  if (r.measured.columns() == 0 || r.samples.empty()) return chapter;
  const Columns columns(model, r);
  for (const auto& [name, probe] : model.scene.probes)
    chapter.blocks.emplace_back(probe_figure(columns, name, probe));
  if (model.scene.output.fastening_forces && model.fastenings)
    chapter.blocks.emplace_back(fastening_figure(columns, model, r));
  if (model.scene.output.stress_depth && model.contact) chapter.blocks.emplace_back(depth_figure(columns, r));
  return chapter;
}

}  // namespace tread
