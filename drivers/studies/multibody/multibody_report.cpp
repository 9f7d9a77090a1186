#include "drivers/studies/multibody/multibody_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/math/interpolation.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/report/figure_parts.hpp"
#include "io/report/markup.hpp"

namespace tread {

namespace {

Series curve(std::string label, const std::vector<MultibodySample>& samples, double MultibodySample::*value,
             double scale, Stroke stroke = Stroke::solid) {
  Series series{std::move(label), {}, {}, stroke};
  for (const MultibodySample& s : samples) {
    series.x.push_back(s.x);
    series.y.push_back(scale * s.*value);
  }
  return series;
}

Figure over_the_way(std::string name, std::string title, const MultibodyModel& model, const Range& range) {
  return over_the_rail(std::move(name), std::move(title), model.scene, model.corrugation, range);
}

Range whole_way(const MultibodyOutcome& o) {
  return {o.result.samples.front().x, o.result.samples.back().x};
}

Range in_sight(const MultibodyOutcome& o) {
  return stretch_in_sight(o.model.scene, o.model.corrugation, whole_way(o));
}

Marker at_rest(const MultibodyModel& model) {
  return {1e-3 * model.vehicle.load(), "static"};
}

/// F_N over the corrugation or the solution zone.
Figure passage_figure(const MultibodyOutcome& o) {
  const MultibodyResult& r = o.result;
  const bool smooth = o.model.corrugation.smooth();
  Figure near = over_the_way(
      "forces", smooth ? "Vertical force over the solution zone" : "Vertical force over the corrugation",
      o.model, in_sight(o));
  near.panels.push_back(
      panel("F_N [kN]", {curve("F_N", r.samples, &MultibodySample::force, 1e-3)}, {at_rest(o.model)}, 280));
  if (!smooth)
    near.panels.push_back(panel(
        "Surface [mm]",
        {curve("surface that the wheel follows", r.samples, &MultibodySample::roughness, -1e3)}, {}, 90));
  return near;
}

/// F_N of the transient run and of both springs.
Figure calibration_figure(const MultibodyOutcome& o) {
  const Calibration& c = *o.calibration;
  Figure figure = over_the_way("calibration", "Vertical force: transient run and multi-body model", o.model,
                               {c.first, c.last});
  figure.panels.push_back(
      panel("F_N [kN]",
            {{"transient run", c.x, scaled(c.run.values, 1e-3), Stroke::solid},
             {"multi-body, Hertz spring", c.x, scaled(c.before.values, 1e-3), Stroke::dashed},
             {"multi-body, fitted spring", c.x, scaled(c.after.values, 1e-3), Stroke::solid}},
            {at_rest(o.model)}, 300));
  return figure;
}

/// The map's speeds [km/h] and wavelengths [mm].
std::vector<double> shown_speeds(const ResponseMap& map) {
  return scaled(map.axes.speed.values, 3.6);
}
std::vector<double> shown_wavelengths(const ResponseMap& map) {
  return scaled(map.axes.wavelength.values, 1e3);
}

/// Point of the cell that holds a dot; nullptr outside the map. A single value has a cell of two percent.
const MapPoint* point_there(const ResponseMap& map, const MapDot& dot) {
  const auto cell = [](const std::vector<double>& values, double value) {
    const std::vector<double> borders = cell_borders(values);
    const bool inside = values.size() == 1 ? std::abs(value - values.front()) <= 0.01 * values.front()
                                           : value >= borders.front() && value <= borders.back();
    return inside ? std::optional(nearest(values, value)) : std::nullopt;
  };
  const auto speed = cell(shown_speeds(map), 3.6 * dot.speed);
  const auto wavelength = cell(shown_wavelengths(map), 1e3 * dot.wavelength);
  return speed && wavelength ? &map.at(*speed, *wavelength) : nullptr;
}

/// Largest F_N over static against speed and wavelength.
Heatmap response_heatmap(const MultibodyOutcome& o) {
  const ResponseMap& map = *o.map;
  Heatmap heat;
  heat.name = "map";
  heat.title = "Largest F_N over static, depth " + readable(1e3 * o.model.scene.corrugation->depth) + " mm";
  heat.x_label = "Speed [km/h]";
  heat.y_label = "Wavelength [mm]";
  heat.value_label = "max F_N / static";
  heat.x = shown_speeds(map);
  heat.y = shown_wavelengths(map);
  for (std::size_t j = 0; j < heat.y.size(); ++j)
    for (std::size_t i = 0; i < heat.x.size(); ++i) {
      heat.values.push_back(map.at(i, j).max);
      heat.marked.push_back(map.at(i, j).loss_of_contact > 0);
    }
  const bool lost = std::find(heat.marked.begin(), heat.marked.end(), true) != heat.marked.end();
  if (lost) heat.marked_label = "border of contact loss";
  constexpr int kPoints = 200;
  const std::vector<double> borders = cell_borders(heat.x);
  for (const double frequency : {400.0, 600.0, 800.0, 1000.0, 1200.0, 1600.0, 2000.0, 3000.0}) {
    HeatLine line{{}, {}, fmt::format("{:.0f} Hz", frequency)};
    for (int i = 0; i <= kPoints; ++i) {
      const double speed = borders.front() + (borders.back() - borders.front()) * i / kPoints;
      line.x.push_back(speed);
      line.y.push_back(1e3 * speed / 3.6 / frequency);
    }
    heat.lines.push_back(std::move(line));
  }
  for (const MapDot& dot : o.dots)
    if (point_there(map, dot))
      heat.dots.push_back({3.6 * dot.speed, 1e3 * dot.wavelength, dot.max, readable(dot.max, 3)});
  heat.caption = fmt::format(
      "{} passages over the waves that {} mm hold, less half a wave at each end where there are several; {} "
      "beam. Dashed: one passing frequency v / L.{}{}",
      map.points.size(), readable(1e3 * o.model.scene.corrugation->length), name_of(o.model.theory),
      lost ? "" : " Contact is lost nowhere.",
      heat.dots.empty() ? ""
                        : " Dots: transient runs, in the colour of their own value, which stands beside.");
  return heat;
}

Chapter passage_chapter(const MultibodyOutcome& o) {
  const MultibodyResult& r = o.result;
  Chapter chapter{"Forces", {passage_figure(o)}};
  Figure motion = over_the_way("deflections", "Deflections", o.model, in_sight(o));
  motion.panels.push_back(
      panel("Downwards [mm]",
            {curve("wheel", r.samples, &MultibodySample::wheel, 1e3),
             curve("rail under the wheel", r.samples, &MultibodySample::rail, 1e3, Stroke::dashed)},
            {}, 200));
  chapter.blocks.emplace_back(std::move(motion));
  Figure far = over_the_way("way", "Vertical force over the whole way", o.model, whole_way(o));
  far.panels.push_back(
      panel("F_N [kN]", {curve("F_N", r.samples, &MultibodySample::force, 1e-3)}, {at_rest(o.model)}, 180));
  chapter.blocks.emplace_back(std::move(far));
  if (!r.peaks.empty()) {
    Table table{"F_N about the crests",
                {{"Crest at x [m]", Align::right},
                 {"Peak at x [m]", Align::right},
                 {"Peak [kN]", Align::right},
                 {"Before the crest [pi]", Align::right}},
                {}};
    for (const CrestPeak& p : r.peaks)
      table.rows.push_back({fmt::format("{:.4f}", p.crest), fmt::format("{:.4f}", p.peak),
                            readable(1e-3 * p.force), fmt::format("{:.3f}", p.shift / std::numbers::pi)});
    chapter.blocks.emplace_back(std::move(table));
  }
  return chapter;
}

Chapter calibration_chapter(const MultibodyOutcome& o) {
  const Calibration& c = *o.calibration;
  Chapter chapter{"Calibration", {}};
  std::string text = fmt::format(
      "The contact spring whose F_N differs least from the transient run's over x = {:.3f} ... {:.3f} m: {} "
      "of "
      "the "
      "Hertz spring's C, {} GN/m under the static load instead of {}.",
      c.first, c.last, readable(c.contact / o.model.vehicle.contact, 3),
      readable(1.5e-9 * c.contact * std::cbrt(o.model.vehicle.load() / c.contact), 3),
      readable(1e-9 * o.model.contact_stiffness(), 3));
  if (c.at_bound) text += " It is the end of the range searched: no spring fits this run.";
  chapter.blocks.emplace_back(Text{text});
  chapter.blocks.emplace_back(calibration_table(c, o.model));
  chapter.blocks.emplace_back(calibration_figure(o));
  Figure search;
  search.name = "calibration-search";
  search.title = "Difference from the run against the spring";
  search.x_label = "C / Hertz";
  search.panels.push_back(panel(
      "Root mean square [kN]", {{"difference", c.factors, scaled(c.misfits, 1e-3), Stroke::solid}}, {}, 150));
  chapter.blocks.emplace_back(std::move(search));
  return chapter;
}

Chapter map_chapter(const MultibodyOutcome& o) {
  Chapter chapter{"Map", {response_heatmap(o)}};
  if (o.dots.empty()) return chapter;
  Table table{"Transient runs",
              {{.title = "Run", .plain = true},
               {"Speed [km/h]", Align::right},
               {"Wavelength [mm]", Align::right},
               {"max F_N / static", Align::right},
               {"Map there", Align::right},
               {"Remark"}},
              {}};
  for (const MapDot& dot : o.dots) {
    const MapPoint* point = point_there(*o.map, dot);
    std::string remark = point ? dot.remark : "outside the map";
    if (!point && !dot.remark.empty()) remark += "; " + dot.remark;
    table.rows.push_back({dot.label, readable(3.6 * dot.speed), readable(1e3 * dot.wavelength),
                          readable(dot.max, 3), point ? readable(point->max, 3) : "-", std::move(remark)});
  }
  chapter.blocks.emplace_back(std::move(table));
  return chapter;
}

Chapter model_chapter(const MultibodyOutcome& o) {
  const MultibodyModel& m = o.model;
  const MultibodyResult& r = o.result;
  Table table{"", {{"Part"}, {"Value", Align::right}, {"Unit"}, {"Remark"}}, {}};
  const auto add = [&](std::string name, std::string value, std::string unit, std::string remark = "") {
    table.rows.push_back({std::move(name), std::move(value), std::move(unit), std::move(remark)});
  };
  add("Rail", name_of(m.theory), "", fmt::format("{} modes, ends that do not turn", r.modes));
  add("E I", readable(1e-6 * m.rail.bending_stiffness), "MN m²", "the scene's section");
  if (m.rail.shear_stiffness > 0) add("kappa G A", readable(1e-6 * m.rail.shear_stiffness), "MN");
  add("Mass of the rail", readable(m.rail.mass), "kg/m");
  if (m.sleepers.empty())
    add("Supports", std::to_string(m.supports.size()), "",
        fmt::format("columns of {} fastenings on rigid ground", m.scene.fastenings->count));
  else
    add("Supports", std::to_string(m.sleepers.size()), "", "fastenings on rigid sleepers on their beds");
  add("Wheel", readable(m.vehicle.unsprung_mass), "kg",
      m.wheel.modes.empty() ? "half wheelset and M_a, one mass"
                            : fmt::format("half wheelset and M_a, {} modes", m.wheel.modes.size()));
  add("Sprung mass", readable(m.vehicle.sprung_mass), "kg", "on the primary suspension");
  add("Lateral radius of the gap", readable(1e3 * m.radius_y), "mm",
      fmt::format("touching at y = {:.2f} mm", 1e3 * m.contact_y));
  add("Hertz approach at rest", readable(1e6 * m.patch.approach, 3), "µm");
  add("C of F = C approach^1.5", readable(m.vehicle.contact), "N/m^1.5");
  add("Step", readable(1e6 * r.dt, 3), "µs", fmt::format("{} steps", r.steps));
  add("Start", readable(m.start), "m", "at rest in equilibrium");
  add("Computing time", duration_text(o.seconds), "");
  Chapter chapter{"Model", {table}};
  std::string lacks = "The multi-body approach knows no longitudinal force and no slab";
  if (m.wheel.modes.empty()) lacks += ", no wheel that bends or vibrates";
  if (m.sine.empty() && !o.filter_gain) lacks += ", no contact patch";
  if (!m.solid) lacks += ", no deformation of the rail's section";
  chapter.blocks.emplace_back(Text{lacks + "."});
  return chapter;
}

}  // namespace

Report multibody_report(const MultibodyOutcome& o, const std::string& scene, const Provenance& provenance) {
  const MultibodyResult& r = o.result;
  Report report;
  report.title = o.model.scene.title;
  report.subtitle =
      fmt::format("Multi-body approach · {:.4g} km/h · {} rail{}{}{}", 3.6 * o.model.speed,
                  name_of(o.model.theory), o.model.wheel.modes.empty() ? "" : " · modal wheel",
                  o.model.sine.empty() ? "" : " · half-spaces", o.filter_gain ? " · contact filter" : "");
  Chapter result{"Result", {}};
  result.blocks.emplace_back(KeyFigures{{"Largest F_N", readable(1e-3 * r.force.max), "kN"},
                                        {"Smallest F_N", readable(1e-3 * r.force.min), "kN"},
                                        {"Static F_N", readable(1e-3 * o.model.vehicle.load()), "kN"},
                                        {"Way without contact", readable(100 * r.loss_of_contact, 3), "%"},
                                        {"Computing time", duration_text(o.seconds), ""}});
  result.blocks.emplace_back(multibody_table(o));
  if (const std::vector<std::string> warnings = warnings_of(o); !warnings.empty()) {
    report.chapters.push_back({"Warnings", {}});
    for (const std::string& warning : warnings) report.chapters.back().blocks.emplace_back(Text{warning});
  }
  report.chapters.push_back(std::move(result));
  report.chapters.push_back(passage_chapter(o));
  if (o.calibration) report.chapters.push_back(calibration_chapter(o));
  if (o.map) report.chapters.push_back(map_chapter(o));
  report.chapters.push_back(model_chapter(o));
  state_provenance(report, scene, provenance);
  return report;
}

}  // namespace tread
