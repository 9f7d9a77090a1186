#include "drivers/paper/paper_figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "drivers/evaluated_stretch.hpp"
#include "drivers/figure_parts.hpp"
#include "drivers/growing_files.hpp"
#include "drivers/instants.hpp"
#include "drivers/interpolation.hpp"
#include "drivers/multibody/multibody_run.hpp"
#include "drivers/paper/curve_measures.hpp"
#include "drivers/roughness/level_figure.hpp"
#include "drivers/surface_results.hpp"

namespace tread {

namespace {

constexpr std::array<double, 6> kSpeeds = {100, 180, 250, 300, 400, 500};  // [km/h]
constexpr std::array<double, 6> kMus = {0, 0.1, 0.2, 0.3, 0.4, 0.5};
constexpr std::array<double, 3> kWavelengths = {65, 80, 95};         // [mm]
constexpr std::array<double, 4> kDepths = {0.04, 0.08, 0.14, 0.18};  // [mm]

/// `base` with `member` set to each value.
template <class Values>
std::vector<Passage> varied(const Passage& base, double Passage::*member, const Values& values) {
  std::vector<Passage> passages;
  for (const double value : values) {
    passages.push_back(base);
    passages.back().*member = value;
  }
  return passages;
}

std::function<std::string(const Passage&)> labelled(double Passage::*member, const char* format) {
  return [member, format](const Passage& p) { return fmt::format(fmt::runtime(format), p.*member); };
}

std::function<double(const Passage&)> value_of(double Passage::*member) {
  return [member](const Passage& p) { return p.*member; };
}

CurvePanel history(std::string y_label, const char* column, const char* unit, double scale,
                   std::string prefix) {
  return {std::move(y_label), {.y = {column, unit}, .y_scale = scale}, std::move(prefix)};
}

CurvePanel vertical() {
  return history("F_N [kN]", "vertical_force", "N", 1e-3, "F_N, ");
}
CurvePanel longitudinal() {
  return history("F_L [kN]", "longitudinal_force", "N", 1e-3, "F_L, ");
}
CurvePanel longitudinal_with_limit() {
  CurvePanel panel = longitudinal();
  panel.y_label = "Force [kN]";
  panel.limit = true;
  return panel;
}
CurvePanel creepage() {
  return history("Creepage [%]", "creepage_mean", "-", 100, "mean of 28 nodes, ");
}

CurvePanel over_time(CurvePanel panel) {
  panel.curve.x = {"time", "s"};
  panel.curve.x_scale = 1e3;
  return panel;
}

std::vector<CurvePanel> surface_displacement() {
  const auto state = [](const char* column, std::string prefix) {
    const RunCurve curve{
        .file = "deflection.csv", .x = {"x_from_wheel", "m"}, .y = {column, "m"}, .y_scale = 1e3};
    return CurvePanel{"Upwards [mm]", curve, std::move(prefix)};
  };
  return {state("static", "static, "), state("rolling", "rolling, ")};
}

std::vector<CurvePanel> along_the_axis() {
  const auto axis = [](std::string y_label, const char* column, const char* unit, double scale,
                       std::string prefix) {
    const RunCurve curve{.file = "surface_axis.csv", .x = {"x", "m"}, .y = {column, unit}, .y_scale = scale};
    return CurvePanel{std::move(y_label), curve, std::move(prefix), 140};
  };
  return {axis("Pressure [MPa]", "max_pressure", "Pa", 1e-6, "largest pressure, "),
          axis("Shear [MPa]", "max_shear", "Pa", 1e-6, "largest surface shear stress, "),
          axis("Von Mises [MPa]", "max_von_mises", "Pa", 1e-6, "largest Von Mises stress, "),
          axis("Work [mJ]", "frictional_work_in_1.1_mm_cell", "J", 1e3, "frictional work, ")};
}

std::vector<TrendPanel> forces_of() {
  const std::vector<TrendPanel> all = fluctuation_panels();
  return {all.begin(), all.begin() + 2};
}
/// Von Mises stress and frictional work.
std::vector<TrendPanel> responses() {
  const std::vector<TrendPanel> all = fluctuation_panels();
  return {all.begin() + 2, all.end()};
}

std::vector<TrendPanel> stresses_and_work() {
  std::vector<TrendPanel> panels = {
      {"Shear [MPa]", {{"largest surface shear stress, mean of the samples", "max_shear_Pa"}}, 1e-6}};
  for (TrendPanel& panel : responses()) panels.push_back(std::move(panel));
  return panels;
}

SurfaceView largest_pressure() {
  return {"max_pressure", "Largest pressure", "[MPa]", 1e-6};
}

std::vector<SurfaceView> surface_views() {
  return {largest_pressure(),
          {"max_shear", "Largest surface shear stress", "[MPa]", 1e-6},
          {"max_von_mises", "Largest Von Mises stress", "[MPa]", 1e-6},
          {"frictional_work", "Frictional work in a cell of 1.1 mm x 1.1 mm", "[mJ]", 1e3 * kPaperCell}};
}

std::vector<PaperFigure> smooth_figures() {
  const Passage smooth = smooth_rail();
  const auto by_speed = labelled(&Passage::speed, "{:g} km/h");
  const auto by_mu = labelled(&Passage::mu, "mu {:g}");
  const auto by_ramp = labelled(&Passage::ramp, "T1 = {:g} ms");
  const std::string way = "Position of the wheel [m]";
  return {
      {.id = "07",
       .title = "Vertical displacement of the rail's surface about the wheel, smooth rail, 300 km/h",
       .section = "3.1",
       .passages = {smooth},
       .label = by_speed,
       .curves = {"", "From the wheel, ahead positive [m]", surface_displacement(), true, false},
       .one_panel = true},
      {"08",
       "Vertical force at different speeds, smooth rail",
       "3.1",
       varied(smooth, &Passage::speed, kSpeeds),
       by_speed,
       {"", way, {vertical()}, true}},
      {"09",
       "Forces for different T1, smooth rail, mu 0.3, 300 km/h",
       "3.2",
       varied(smooth, &Passage::ramp, std::array{0.1, 5.0, 10.0}),
       by_ramp,
       {"", "Time [ms]", {over_time(longitudinal_with_limit())}, true}},
      {"10",
       "Longitudinal force at different speeds, smooth rail, mu 0.3",
       "3.2",
       varied(smooth, &Passage::speed, kSpeeds),
       by_speed,
       {"", way, {longitudinal()}, true}},
      {"11",
       "Forces at different traction coefficients, smooth rail, 300 km/h",
       "3.2",
       varied(smooth, &Passage::mu, kMus),
       by_mu,
       {"", way, {vertical(), longitudinal()}, true}},
      {"12",
       "Largest stresses and frictional work along the axis, smooth rail, mu 0.3, 300 km/h",
       "3.3",
       {smooth},
       by_speed,
       {"", "Position on the rail [m]", along_the_axis()}},
      {.id = "12b",
       .title = "Largest stresses and frictional work along and across, smooth rail, mu 0.3, 300 km/h",
       .section = "3.3",
       .passages = {smooth},
       .surface = surface_views()},
      {.id = "13",
       .title = "Stresses and frictional work against mu, smooth rail, 300 km/h",
       .section = "3.3",
       .passages = varied(smooth, &Passage::mu, kMus),
       .label = by_mu,
       .x_label = "mu",
       .x = value_of(&Passage::mu),
       .trends = stresses_and_work()},
  };
}

std::vector<PaperFigure> corrugation_d_figures() {
  const Passage d = corrugated();
  const auto name = [](const Passage&) { return std::string("corrugation D"); };
  const std::string way = "Position of the wheel [m]";
  return {
      {.id = "14",
       .title = "Roughness levels of waves 0.14 mm deep, 65, 80 and 95 mm long",
       .section = "4.1",
       .levels = true},
      {"15",
       "Forces over corrugation D, mu 0.3, 300 km/h",
       "4.2",
       {d},
       name,
       {"", way, {longitudinal_with_limit(), vertical()}}},
      {.id = "16",
       .title = "The patch's longitudinal axis at ten instants, corrugation D, mu 0.3, 300 km/h",
       .section = "4.2",
       .passages = {d},
       .instants = true},
      {.id = "17a",
       .title = "Largest pressure, corrugation D, mu 0.3, 300 km/h",
       .section = "4.2",
       .passages = {d},
       .surface = {largest_pressure()}},
      {.id = "17b",
       .title = "Largest pressure, smooth rail, mu 0.3, 300 km/h",
       .section = "4.2",
       .passages = {smooth_rail()},
       .surface = {largest_pressure()}},
      {"18",
       "Creepage over corrugation D, mu 0.3, 300 km/h",
       "4.2",
       {d},
       name,
       {"", way, {history("Creepage [%]", "creepage_node", "-", 100, "at N_cr, "), creepage()}}},
      {"19",
       "Largest stresses and frictional work along the axis, corrugation D, mu 0.3, 300 km/h",
       "4.2",
       {d},
       name,
       {"", "Position on the rail [m]", along_the_axis()}},
      {.id = "19b",
       .title = "Largest stresses and frictional work along and across, corrugation D, mu 0.3, 300 km/h",
       .section = "4.2",
       .passages = {d},
       .surface = surface_views()},
  };
}

/// Of Figs. 20 to 22.
std::vector<Passage> wave_passages() {
  return varied(corrugated(), &Passage::wavelength, kWavelengths);
}

std::vector<PaperFigure> geometry_figures() {
  const Passage d = corrugated();
  const std::vector<Passage> waves = wave_passages();
  const auto by_wave = labelled(&Passage::wavelength, "{:g} mm");
  const auto by_depth = labelled(&Passage::depth, "{:g} mm");
  const std::string way = "Position of the wheel [m]";
  std::vector<TrendPanel> all = forces_of();
  for (TrendPanel& panel : responses()) all.push_back(std::move(panel));
  return {
      {"20",
       "Forces for different wavelengths, depth 0.14 mm, mu 0.3, 300 km/h",
       "4.3",
       waves,
       by_wave,
       {"", way, {vertical(), longitudinal()}}},
      {.id = "21",
       .title = "Von Mises stress and frictional work against the wavelength",
       .section = "4.3",
       .passages = waves,
       .label = by_wave,
       .x_label = "Wavelength [mm]",
       .x = value_of(&Passage::wavelength),
       .trends = responses()},
      {"22", "Creepage for different wavelengths", "4.3", waves, by_wave, {"", way, {creepage()}}},
      {.id = "23",
       .title = "Forces, Von Mises stress and frictional work against the depth, 80 mm",
       .section = "4.3",
       .passages = varied(d, &Passage::depth, kDepths),
       .label = by_depth,
       .x_label = "Depth [mm]",
       .x = value_of(&Passage::depth),
       .trends = all},
  };
}

std::vector<PaperFigure> operation_figures() {
  const Passage d = corrugated();
  const std::vector<Passage> mus = varied(d, &Passage::mu, kMus);
  const std::vector<Passage> speeds = varied(d, &Passage::speed, kSpeeds);
  const auto by_mu = labelled(&Passage::mu, "mu {:g}");
  const auto by_speed = labelled(&Passage::speed, "{:g} km/h");
  const std::string way = "Position of the wheel [m]";
  Passage worst = corrugated(80, 0.18);
  worst.speed = 500;
  return {
      {"24",
       "Forces at different traction coefficients over corrugation D, 300 km/h",
       "4.4",
       mus,
       by_mu,
       {"", way, {vertical(), longitudinal()}}},
      {"24b",
       "Braking beside traction over corrugation D, 300 km/h",
       "5",
       varied(d, &Passage::mu, std::array{0.3, -0.3}),
       by_mu,
       {"", way, {longitudinal(), creepage()}}},
      {.id = "25",
       .title = "Von Mises stress and frictional work against mu, corrugation D, 300 km/h",
       .section = "4.4",
       .passages = mus,
       .label = by_mu,
       .x_label = "mu",
       .x = value_of(&Passage::mu),
       .trends = responses()},
      {"26",
       "Forces at different speeds over corrugation D, mu 0.3",
       "4.5",
       speeds,
       by_speed,
       {"", way, {vertical(), longitudinal()}}},
      {.id = "27",
       .title = "Von Mises stress and frictional work against the speed, corrugation D",
       .section = "4.5",
       .passages = speeds,
       .label = by_speed,
       .x_label = "Speed [km/h]",
       .x = value_of(&Passage::speed),
       .trends = responses()},
      {.id = "28",
       .title = "Vertical force beside the multi-body approach, 500 km/h, 80 mm, 0.18 mm",
       .section = "4.6",
       .passages = {worst},
       .label = [](const Passage&) { return std::string("transient"); },
       .curves = {"", way, {vertical()}},
       .multibody = true},
  };
}

Series multibody_force(const FinishedRun& run) {
  const MultibodyResult result = run_multibody(multibody_model(run.scene, BeamTheory::euler), {});
  Series series{"F_N, multi-body approach", {}, {}, Stroke::dashed};
  for (const MultibodySample& s : result.samples) {
    series.x.push_back(s.x);
    series.y.push_back(1e-3 * s.force);
  }
  return series;
}

/// Puts the curves of all panels into the first; the later ones are dashed.
void overlay(Figure& figure) {
  for (std::size_t i = 1; i < figure.panels.size(); ++i)
    for (Series& series : figure.panels[i].series) {
      series.stroke = Stroke::dashed;
      figure.panels.front().series.push_back(std::move(series));
    }
  figure.panels.resize(1);
}

/// The corrugated surface below the curves, where they all have the same.
void add_surface(const std::vector<FinishedRun>& runs, Figure& figure) {
  const Corrugation first = runs.front().corrugation();
  if (first.smooth() || !figure.x_range || figure.x_label.find("[m]") == std::string::npos) return;
  for (const FinishedRun& run : runs)
    if (run.corrugation().last() != first.last() || run.corrugation().deepest() != first.deepest()) return;
  figure.panels.push_back(panel("Rail surface [mm]", {running_surface(first, *figure.x_range)}, {}, 70));
}

/// Runs of a figure and where they stand on the abscissa of its trends.
struct FoundRuns {
  std::vector<FinishedRun> runs;
  std::vector<double> places;
};

FoundRuns find_runs(const PaperFigure& wanted, const PassageRuns& runs) {
  FoundRuns found;
  for (const Passage& passage : wanted.passages)
    if (const FinishedRun* run = runs.find(passage)) {
      found.runs.push_back(*run);
      found.runs.back().label = wanted.label(passage);
      found.places.push_back(wanted.x ? wanted.x(passage) : 0);
    }
  return found;
}

Figure drawn_trend(const std::string& title, const PaperFigure& wanted, const PassageRuns& runs) {
  const FoundRuns found = find_runs(wanted, runs);
  std::vector<TrendRun> trend;
  for (std::size_t i = 0; i < found.runs.size(); ++i) trend.push_back({&found.runs[i], found.places[i], ""});
  return trend_figure(title, wanted.x_label, wanted.trends, trend);
}

Figure drawn_curves(const std::string& title, const PaperFigure& wanted, const PassageRuns& runs) {
  const std::vector<FinishedRun> found = find_runs(wanted, runs).runs;
  CurvesSpec spec = wanted.curves;
  spec.title = title;
  Figure figure = curves_figure(spec, found);
  if (found.empty()) return figure;
  if (wanted.one_panel) overlay(figure);
  if (wanted.multibody) figure.panels.front().series.push_back(multibody_force(found.front()));
  add_surface(found, figure);
  return figure;
}

/// Levels of 40 m of each wave of Fig. 20: the paper's are measured, and it does not list them.
DrawnFigure drawn_levels(const std::string& title) {
  constexpr double kSpacing = 1e-3, kLength = 40, kSegment = 2;  // [m]
  std::vector<NamedLevels> rails;
  for (const Passage& wave : wave_passages()) {
    RoughnessProfile profile{kSpacing, {}, false};
    const double angle = 2 * std::numbers::pi * kSpacing / (1e-3 * wave.wavelength);
    for (int i = 0; i < std::lround(kLength / kSpacing); ++i)
      profile.height.push_back(0.5e-3 * wave.depth * std::cos(angle * i));
    rails.push_back({fmt::format("{:g} mm", wave.wavelength), roughness_levels(profile, kSegment)});
  }
  Figure figure = level_figure(rails);
  figure.title = title;
  figure.panels.front().y_range = Range{-20, 40};  // what lies below leaks out of the window
  return {figure, figure_csv(figure), figure_svg(figure)};
}

/// Of the run's instants; the last 0.12 m of a smooth rail, as many as the paper shows.
std::vector<double> places_of(const FinishedRun& run) {
  const CurvePoints pressure = history_over_way(run, "max_pressure", "Pa");
  return typical_places(run.scene, evaluated_stretch(run.scene, run.corrugation()), 0.12, pressure.x,
                        pressure.y);
}

DrawnFigure drawn_instants(const std::string& title, const FinishedRun& run) {
  const std::filesystem::path path = run.folder / kPatchFile;
  const PatchAxes axes = read_patch_axes(path);
  const std::size_t axis = nearest(axes.y, run.number("surface.axis_y_m").value_or(0));
  const Instants instants{axes, static_cast<int>(axis), run.scene.contact->friction, run.corrugation(),
                          read_patch(path, places_of(run))};
  if (instants.samples.empty()) throw InputError(path.string() + " holds no sample: run the scene again");
  Figure figure = instants_figure(instants);
  figure.title = title;
  return {figure, instants_csv(instants), figure_svg(figure)};
}

DrawnFigure drawn_surface(const std::string& title, const PaperFigure& wanted, const FinishedRun& run) {
  const std::vector<double> places = places_of(run);
  std::vector<SurfaceMap> maps;
  Reliefs reliefs{title, {}, {}};
  for (const SurfaceView& view : wanted.surface) {
    maps.push_back(read_surface_map(run.folder / "surface.h5", view.field, {places.front(), places.back()}));
    reliefs.reliefs.push_back(relief(maps.back(), view));
  }
  return {reliefs, surface_maps_csv(maps), reliefs_svg(reliefs)};
}

}  // namespace

const std::vector<PaperFigure>& paper_figures() {
  static const std::vector<PaperFigure> figures = [] {
    std::vector<PaperFigure> all = smooth_figures();
    for (const auto& more : {corrugation_d_figures(), geometry_figures(), operation_figures()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return figures;
}

std::string shown_id(const std::string& id) {
  return id.substr(std::min(id.find_first_not_of('0'), id.size()));
}

DrawnFigure draw(const PaperFigure& wanted, const PassageRuns& runs) {
  const std::string title = fmt::format("Fig. {}: {}", shown_id(wanted.id), wanted.title);
  if (wanted.levels) return drawn_levels(title);
  if (wanted.instants || !wanted.surface.empty()) {
    const FinishedRun* run = runs.find(wanted.passages.front());
    if (!run) return {Text{title + "."}, "", ""};
    return wanted.instants ? drawn_instants(title, *run) : drawn_surface(title, wanted, *run);
  }
  const Figure figure =
      wanted.trends.empty() ? drawn_curves(title, wanted, runs) : drawn_trend(title, wanted, runs);
  return {figure, figure_csv(figure), figure_svg(figure)};
}

}  // namespace tread
