#include "drivers/studies/dial/dial_measures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/math/interpolation.hpp"
#include "core/math/statistics.hpp"
#include "drivers/engine/model/evaluated_stretch.hpp"
#include "drivers/results/run_results.hpp"

namespace tread {

namespace {

constexpr int kPlaces = 1024;     ///< on the stretch
constexpr int kShifts = 80;       ///< that are tried to either side
constexpr double kPattern = 0.5;  ///< smallest correlation of a pattern that has a phase

double quadratic_mean(const Statistics& s) {
  return std::hypot(s.mean, s.deviation);
}

/// Values at even places of the stretch, the curve taken back by `shift`.
std::vector<double> values_on(const CurvePoints& curve, const Span& stretch, double shift) {
  std::vector<double> values(kPlaces);
  const double step = (stretch.last - stretch.first) / (kPlaces - 1);
  for (int i = 0; i < kPlaces; ++i) {
    // The last place may lie a rounding beyond the curve's end.
    const double x = std::clamp(stretch.first + i * step + shift, curve.x.front(), curve.x.back());
    values[static_cast<std::size_t>(i)] = value_at(curve.x, curve.y, x);
  }
  return values;
}

/// The part of the stretch that the curve has with room on either side.
Span with_room(const Span& stretch, const CurvePoints& curve, double room) {
  if (curve.x.size() < 2) return {};
  return {std::max(stretch.first, curve.x.front() + room), std::min(stretch.last, curve.x.back() - room)};
}

/// Where the correlation is largest; the peak of the parabola through the best shift and its neighbours.
std::optional<double> pattern_shift(const CurvePoints& curve, const std::vector<double>& reference,
                                    const Span& stretch, double longest) {
  const double step = longest / kShifts;
  std::vector<double> correlations;
  for (int i = -kShifts; i <= kShifts; ++i)
    correlations.push_back(correlation(values_on(curve, stretch, i * step), reference).value_or(0));
  const auto best = std::max_element(correlations.begin(), correlations.end());
  if (*best < kPattern || best == correlations.begin() || best + 1 == correlations.end()) return std::nullopt;
  const double before = *(best - 1);
  const double behind = *(best + 1);
  const double bend = before - 2 * *best + behind;
  const double part = bend < 0 ? 0.5 * (before - behind) / bend : 0;
  return (static_cast<double>(best - correlations.begin()) - kShifts + part) * step;
}

/// The stretch on which the reference is judged, of curves on the rail's surface as far as both wheels have
/// left it.
Span stretch_of(const FinishedRun& run, const FinishedRun& reference, const DialQuantity& quantity) {
  Span stretch = evaluated_stretch(reference.scene, reference.corrugation());
  if (quantity.curve.file == "histories.csv") return stretch;
  for (const FinishedRun* one : {&run, &reference}) {
    stretch.first = std::max(stretch.first, one->number("surface.stretch_x_m.0").value_or(stretch.first));
    stretch.last = std::min(stretch.last, one->number("surface.stretch_x_m.1").value_or(stretch.last));
  }
  return stretch;
}

RunCurve along_axis(const char* name, const char* unit) {
  return {.file = "surface_axis.csv", .x = {"x", "m"}, .y = {name, unit}};
}

RunCurve longitudinal_force() {
  return {.y = {"longitudinal_force", "N"}};
}

/// Returns true if F_L over the evaluated stretch is small against the static F_N. [theory.md, eq. 13a]
bool rolls_freely(const FinishedRun& run) {
  const CurvePoints force = first_passage(read_curve(run, longitudinal_force()));
  const Span known = with_room(evaluated_stretch(run.scene, run.corrugation()), force, 0);
  if (known.empty()) return false;
  const double level = quadratic_mean(statistics(values_on(force, known, 0)));
  return level < kSmallTraction * run.number("static_wheel_load_N").value_or(0);
}

}  // namespace

const std::vector<DialQuantity>& dial_quantities() {
  static const std::vector<DialQuantity> quantities = {
      {"F_N", "F_N", {.y = {"vertical_force", "N"}}, false, true},
      {"F_L", "F_L", longitudinal_force(), true, true},
      {"creepage", "creepage", {.y = {"creepage_mean", "-"}}, true},
      {"pressure", "pressure", {.y = {"max_pressure", "Pa"}}},
      {"shear", "shear", {.y = {"max_shear", "Pa"}}},
      {"von_mises", "Von Mises", along_axis("max_von_mises", "Pa")},
      {"work", "work", along_axis("frictional_work", "J/m2")},
  };
  return quantities;
}

std::optional<CurveDifference> curve_difference(const CurvePoints& curve, const CurvePoints& reference,
                                                const Span& stretch, double longest_shift) {
  const Span known = with_room(stretch, reference, 0);
  const Span common = with_room(known, curve, longest_shift);
  if (known.empty() || common.last - common.first < 0.5 * (known.last - known.first)) return std::nullopt;
  const std::vector<double> wanted = values_on(reference, common, 0);
  const Statistics of_wanted = statistics(wanted);
  const Statistics of_curve = statistics(values_on(curve, common, 0));
  const double level = quadratic_mean(of_wanted);
  if (level == 0) return std::nullopt;
  CurveDifference difference;
  difference.mean = (of_curve.mean - of_wanted.mean) / level;
  if (of_wanted.range() > 0) difference.range = of_curve.range() / of_wanted.range() - 1;
  difference.shift = pattern_shift(curve, wanted, common, longest_shift);
  std::vector<double> apart = values_on(curve, common, difference.shift.value_or(0));
  for (std::size_t i = 0; i < apart.size(); ++i) apart[i] -= wanted[i];
  difference.error = quadratic_mean(statistics(apart)) / level;
  if (of_wanted.deviation > 0) difference.fluctuation = difference.error * level / of_wanted.deviation;
  return difference;
}

std::optional<CurveDifference> run_difference(const FinishedRun& run, const FinishedRun& reference,
                                              const DialQuantity& quantity) {
  if (quantity.of_traction && rolls_freely(reference)) return std::nullopt;
  const Scene& scene = reference.scene;
  const bool sine = scene.corrugation && scene.corrugation->kind == "sine";
  const CurvePoints wanted = first_passage(read_curve(reference, quantity.curve));
  const Span stretch = stretch_of(run, reference, quantity);
  const Span known = with_room(stretch, wanted, 0);
  constexpr double kLongest = 20e-3;  // [m]
  const double longest =
      sine ? 0.25 * scene.corrugation->wavelength : std::min(kLongest, 0.1 * (known.last - known.first));
  std::optional<CurveDifference> difference =
      curve_difference(first_passage(read_curve(run, quantity.curve)), wanted, stretch, longest);
  const bool excited = scene.corrugation || !scene.surfaces.empty();
  if (difference && !(quantity.prescribed && excited)) difference->fluctuation.reset();
  return difference;
}

}  // namespace tread
