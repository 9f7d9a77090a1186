#include "drivers/studies/paper/drawn_figure.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/math/interpolation.hpp"
#include "drivers/engine/model/evaluated_stretch.hpp"
#include "drivers/engine/model/surfaces.hpp"
#include "drivers/report/figure_parts.hpp"
#include "drivers/report/patch_snapshots.hpp"
#include "drivers/results/growing_files.hpp"
#include "drivers/studies/multibody/multibody_run.hpp"
#include "drivers/studies/paper/curve_measures.hpp"
#include "drivers/studies/roughness/level_figure.hpp"

namespace tread {

namespace {

Series multibody_force(const FinishedRun& run) {
  const MultibodyResult result = run_multibody(multibody_model(run.scene, BeamTheory::euler), {});
  CurvePoints force = force_over_way(result);
  for (double& value : force.y) value *= 1e-3;
  return {"F_N, multi-body approach", std::move(force.x), std::move(force.y), Stroke::dashed};
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

bool along_the_rail(const Figure& figure) {
  return figure.x_range && figure.x_label.find("[m]") != std::string::npos;
}

/// Surfaces on the corrugation's middle line.
ShownSurfaces surfaces_of(const FinishedRun& run) {
  return {run.corrugation(), rail_surface(run.scene), wheel_surface(run.scene), 0};
}

/// Adds the surfaces below the curves if they are common to all runs.
void add_surfaces(const std::vector<FinishedRun>& runs, Figure& figure) {
  if (!along_the_rail(figure)) return;
  const auto heights = [&](const FinishedRun& run) {
    std::vector<std::vector<double>> list;
    for (const Series& series : running_surfaces(surfaces_of(run), *figure.x_range)) list.push_back(series.y);
    return list;
  };
  const auto first = heights(runs.front());
  for (const FinishedRun& run : runs)
    if (heights(run) != first) return;
  add_surface_panel(surfaces_of(runs.front()), 70, figure);
}

/// Ends the abscissa as the paper does: traction carries slow wheels farther than fast ones.
void end_with_solution_zone(const Scene& scene, Figure& figure) {
  if (!along_the_rail(figure)) return;
  double& last = (*figure.x_range)[1];
  last = std::min(last, scene.zone_start + scene.zone_length);
}

/// Runs of a figure and their places on the abscissa of its trends.
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
  end_with_solution_zone(found.front().scene, figure);
  if (wanted.one_panel) overlay(figure);
  if (wanted.multibody) figure.panels.front().series.push_back(multibody_force(found.front()));
  add_surfaces(found, figure);
  return figure;
}

/// Roughness levels of 40 m of each wave.
DrawnFigure drawn_levels(const std::string& title, const std::vector<Passage>& waves) {
  constexpr double kSpacing = 1e-3, kLength = 40, kSegment = 2;  // [m]
  std::vector<NamedLevels> rails;
  for (const Passage& wave : waves) {
    RoughnessProfile profile{kSpacing, {}, false};
    const double angle = 2 * std::numbers::pi * kSpacing / (1e-3 * wave.wavelength);
    for (int i = 0; i < std::lround(kLength / kSpacing); ++i)
      profile.height.push_back(0.5e-3 * wave.depth * std::cos(angle * i));
    rails.push_back({fmt::format("{:g} mm", wave.wavelength), roughness_levels(profile, kSegment)});
  }
  Figure figure = level_figure(rails);
  figure.title = title;
  figure.panels.front().y_range = Range{-20, 40};  // levels below are leakage of the window
  return {figure, figure_csv(figure), figure_svg(figure)};
}

/// Places of the run's instants. On a smooth rail: as many as the paper shows, over the last 0.12 m.
std::vector<double> places_of(const FinishedRun& run) {
  const CurvePoints pressure = history_over_way(run, "max_pressure", "Pa");
  return typical_places(run.scene, evaluated_stretch(run.scene, run.corrugation()), 0.12, pressure.x,
                        pressure.y);
}

/// Returns true if the wheel has come so far that places_of() are those of the whole passage: three waves, or
/// half of the last 0.12 m.
bool has_come_to_places(const FinishedRun& run) {
  const CurvePoints way = history_over_way(run, "max_pressure", "Pa");
  const Span stretch = evaluated_stretch(run.scene, run.corrugation());
  const auto& waves = run.scene.corrugation;
  const double needed = waves && waves->kind == "sine"
                            ? std::min(stretch.last, stretch.first + 3 * waves->wavelength)
                            : stretch.last - 0.06;
  return !way.x.empty() && way.x.back() >= needed;
}

DrawnFigure drawn_snapshots(const std::string& title, const FinishedRun& run) {
  const std::filesystem::path path = run.folder / kPatchFile;
  const PatchAxes axes = read_patch_axes(path);
  const std::size_t axis = nearest(axes.y, run.number("surface.axis_y_m").value_or(0));
  const PatchSnapshots snapshots{axes, static_cast<int>(axis), *run.scene.contact, surfaces_of(run),
                                 read_patch(path, places_of(run))};
  if (snapshots.samples.empty()) throw InputError(path.string() + " holds no sample: run the scene again");
  Figure figure = snapshots_figure(snapshots);
  figure.title = title;
  return {figure, snapshots_csv(snapshots), figure_svg(figure)};
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

DrawnFigure draw(const PaperFigure& wanted, const PassageRuns& runs) {
  const std::string title = fmt::format("Fig. {}: {}", shown_id(wanted.id), wanted.title);
  if (!wanted.waves.empty()) return drawn_levels(title, wanted.waves);
  if (wanted.instants || !wanted.surface.empty()) {
    const FinishedRun* run = runs.find(wanted.passages.front());
    if (!run) return {Text{title + "."}, "", ""};
    if (!has_come_to_places(*run)) return {Text{title + ": the wheel has not rolled that far."}, "", ""};
    return wanted.instants ? drawn_snapshots(title, *run) : drawn_surface(title, wanted, *run);
  }
  const Figure figure =
      wanted.trends.empty() ? drawn_curves(title, wanted, runs) : drawn_trend(title, wanted, runs);
  return {figure, figure_csv(figure), figure_svg(figure)};
}

}  // namespace tread
