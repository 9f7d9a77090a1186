#include "drivers/studies/study/study_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "core/math/interpolation.hpp"
#include "drivers/report/figure_parts.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

Series series_of(const FinishedRun& run, const CurvePanel& panel) {
  CurvePoints points = read_curve(run, panel.curve);
  return {panel.prefix + run.label, std::move(points.x), std::move(points.y), Stroke::solid};
}

/// Force that full slip would transmit on the side of the run's mean F_L, in the panel's unit.
Series limit_of(const FinishedRun& run, const CurvePanel& panel) {
  RunCurve curve = panel.curve;
  curve.y = {"vertical_force", "N"};
  const auto mean = [&](const char* force) { return run.number(force).value_or(0); };
  const double f = signed_friction(run.scene.contact ? run.scene.contact->largest_friction() : 0,
                                   mean("longitudinal_force_N.mean"), mean("vertical_force_N.mean"));
  curve.y_scale *= f;
  CurvePoints points = read_curve(run, curve);
  return {(f < 0 ? "−f F_N, " : "f F_N, ") + run.label, std::move(points.x), std::move(points.y),
          Stroke::dotted};
}

Range united(const Range& a, const Range& b) {
  return {std::min(a[0], b[0]), std::max(a[1], b[1])};
}

/// Stretch of interest of all runs, as far as they have come.
Range in_sight(const std::vector<FinishedRun>& runs, const Range& way) {
  std::optional<Range> range;
  for (const FinishedRun& run : runs) {
    if (!run.rolled()) continue;
    const Range one = stretch_in_sight(run.scene, run.corrugation(), way);
    if (one[0] < one[1]) range = range ? united(*range, one) : one;
  }
  return range.value_or(way);
}

bool same_track(const Scene& a, const Scene& b) {
  const auto places = [](const Scene& s) {
    std::vector<double> x;
    for (int i = 0; s.fastenings && s.rail && i < s.fastenings->count; ++i) x.push_back(s.fastening_x(i));
    return x;
  };
  return places(a) == places(b);
}

/// Marks the fastenings and the corrugation if they are common to all runs.
void mark_common_track(const std::vector<FinishedRun>& runs, Figure& figure) {
  const FinishedRun& first = runs.front();
  const Corrugation corrugation = first.corrugation();
  bool one_corrugation = true;
  for (const FinishedRun& run : runs) {
    const Corrugation other = run.corrugation();
    if (!same_track(run.scene, first.scene)) return;
    one_corrugation =
        one_corrugation && other.first() == corrugation.first() && other.last() == corrugation.last();
  }
  mark_track(first.scene, one_corrugation ? corrugation : Corrugation(), *figure.x_range, figure);
}

/// Step of 1, 2 or 5 times a power of ten with at most `most` steps in `length`.
double even_step(double length, int most) {
  const double decade = std::pow(10.0, std::floor(std::log10(length / most)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * decade * most >= length) return factor * decade;
  return 10 * decade;
}

/// Stroke that tells mean, smallest and largest values of a group apart.
Stroke stroke_of(const std::string& label) {
  if (label.find("mean") != std::string::npos) return Stroke::solid;
  return label.find("smallest") != std::string::npos ? Stroke::dotted : Stroke::dashed;
}

std::vector<double> abscissae(const std::vector<CurvePoints>& all, const Figure& figure) {
  bool same = true;
  Range range = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const CurvePoints& curve : all) {
    same = same && curve.x == all.front().x;
    if (!curve.x.empty()) range = united(range, {curve.x.front(), curve.x.back()});
  }
  constexpr int kMostRows = 1000;
  if (all.empty() || range[0] > range[1]) return {};
  if (same && all.front().x.size() <= static_cast<std::size_t>(kMostRows)) return all.front().x;
  if (figure.x_range)
    range = {std::max(range[0], (*figure.x_range)[0]), std::min(range[1], (*figure.x_range)[1])};
  if (!(range[1] > range[0])) return {range[0]};
  const double step = even_step(range[1] - range[0], kMostRows - 1);
  std::vector<double> places;
  for (double k = std::ceil(range[0] / step - 1e-9); k * step <= range[1] + 1e-9 * step; ++k)
    places.push_back(k * step);
  return places;
}

}  // namespace

Figure curves_figure(const CurvesSpec& spec, const std::vector<FinishedRun>& all) {
  std::vector<FinishedRun> runs;
  std::copy_if(all.begin(), all.end(), std::back_inserter(runs),
               [](const FinishedRun& run) { return run.rolled(); });
  Figure figure;
  figure.title = spec.title;
  figure.x_label = spec.x_label;
  figure.name = spec.name;
  std::optional<Range> way;
  for (const CurvePanel& wanted : spec.panels) {
    std::vector<Series> curves;
    for (const FinishedRun& run : runs) {
      curves.push_back(series_of(run, wanted));
      if (runs.size() > 1) curves.back().colour = static_cast<int>(curves.size()) - 1;
    }
    for (const Series& curve : curves)
      if (!curve.x.empty()) {
        const auto ends = std::minmax_element(curve.x.begin(), curve.x.end());
        const Range range = {*ends.first, *ends.second};
        way = way ? united(*way, range) : range;
      }
    for (std::size_t i = 0; wanted.limit && i < runs.size(); ++i) {
      curves.push_back(limit_of(runs[i], wanted));
      curves.back().colour = curves[i].colour;
    }
    figure.panels.push_back(panel(wanted.y_label, std::move(curves), {}, wanted.height));
  }
  if (!way) return figure;
  const bool along_the_rail =
      spec.on_the_rail && !spec.panels.empty() && spec.panels.front().curve.x.unit == "m";
  figure.x_range = spec.whole_way || !along_the_rail ? *way : in_sight(runs, *way);
  if (along_the_rail) mark_common_track(runs, figure);
  return figure;
}

Figure trend_figure(std::string title, std::string x_label, const std::vector<TrendPanel>& panels,
                    const std::vector<TrendRun>& runs) {
  Figure figure;
  figure.title = std::move(title);
  figure.x_label = std::move(x_label);
  std::map<std::string, std::vector<TrendRun>> groups;
  for (const TrendRun& run : runs) groups[run.group].push_back(run);
  for (auto& [name, group] : groups)
    std::stable_sort(group.begin(), group.end(),
                     [](const TrendRun& a, const TrendRun& b) { return a.x < b.x; });
  for (const TrendPanel& wanted : panels) {
    std::vector<Series> curves;
    int colour = -1;
    for (const auto& [name, group] : groups) {
      ++colour;
      for (const auto& [label, path] : wanted.curves) {
        Series series{label, {}, {}, stroke_of(label), colour};
        if (!name.empty()) series.label += fmt::format(", {}", name);
        for (const TrendRun& run : group)
          if (const auto value = run.run->result(path)) {
            series.x.push_back(run.x);
            series.y.push_back(wanted.scale * *value);
          }
        if (!series.x.empty()) curves.push_back(std::move(series));
      }
    }
    if (!curves.empty()) figure.panels.push_back(panel(wanted.y_label, std::move(curves), {}, 180));
  }
  return figure;
}

std::vector<TrendPanel> fluctuation_panels() {
  const std::string von_mises = "surface.axis_max_von_mises_Pa";
  const std::string work = "surface.axis_frictional_work_J_in_1.1_mm_cell";
  const auto three = [](const std::string& name, const std::string& path) {
    return std::vector<std::pair<std::string, std::string>>{{name + ", largest", path + ".max"},
                                                            {name + ", mean", path + ".mean"},
                                                            {name + ", smallest", path + ".min"}};
  };
  return {{"F_N [kN]", three("F_N", "vertical_force_N"), 1e-3},
          {"F_L [kN]", three("F_L", "longitudinal_force_N"), 1e-3},
          {"Von Mises [MPa]", three("Von Mises stress", von_mises), 1e-6},
          {"Work [mJ]", three("frictional work", work), 1e3}};
}

std::string figure_csv(const Figure& figure) {
  std::vector<CurvePoints> all;
  std::string text = csv_cell(figure.x_label);
  for (const Panel& panel : figure.panels)
    for (const Series& series : panel.series) {
      all.push_back(first_passage({series.x, series.y}));
      text += fmt::format(",{}", csv_cell(series.label + ": " + panel.y_label));
    }
  text += '\n';
  for (const double x : abscissae(all, figure)) {
    text += fmt::format("{:.6g}", x);
    for (const CurvePoints& curve : all) {
      const double value = value_at(curve.x, curve.y, x);
      text += std::isfinite(value) ? fmt::format(",{:.5g}", value) : ",";
    }
    text += '\n';
  }
  return text;
}

}  // namespace tread
