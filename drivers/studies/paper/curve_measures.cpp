#include "drivers/studies/paper/curve_measures.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/math/interpolation.hpp"
#include "core/math/statistics.hpp"
#include "drivers/engine/model/evaluated_stretch.hpp"

namespace tread {

namespace {

constexpr int kPlaces = 1024;

bool has_sine(const FinishedRun& run) {
  return run.rolled() && run.scene.corrugation && run.scene.corrugation->kind == "sine";
}

/// Values at even places of the evaluated stretch; empty if the curve does not cover it.
std::vector<double> evaluated(const FinishedRun& run, const CurvePoints& curve) {
  const Span stretch = evaluated_stretch(run.scene, run.corrugation());
  if (curve.x.size() < 2 || curve.x.front() > stretch.first || curve.x.back() < stretch.last) return {};
  std::vector<double> values(kPlaces);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = value_at(curve.x, curve.y,
                         stretch.first + (stretch.last - stretch.first) * static_cast<double>(i) / kPlaces);
  return values;
}

double static_load(const FinishedRun& run) {
  return run.number("static_wheel_load_N").value_or(0);
}

/// Largest creepage of the column at the places of the evaluated stretch that count, over the steady one [-].
template <class Counts>
std::optional<double> creepage_ratio(const FinishedRun& run, const char* column, const Counts& counts) {
  const CurvePoints curve = history_over_way(run, column, "-");
  const double first = run.number("evaluated_x_m.0").value_or(0);
  const double last = run.number("evaluated_x_m.1").value_or(0);
  const double steady = 1e-2 * steady_creepage(run).value_or(0);
  double most = 0;
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (curve.x[i] >= first && curve.x[i] <= last && counts(curve.x[i])) most = std::max(most, curve.y[i]);
  if (steady <= 0 || vertical_peaks(run).empty()) return std::nullopt;
  return most / steady;
}

}  // namespace

bool WavePattern::larger_at_crests() const {
  return std::cos(shift) > 0;
}

std::optional<WavePattern> wave_pattern(const FinishedRun& run, const CurvePoints& curve) {
  if (!has_sine(run)) return std::nullopt;
  const std::vector<double> values = evaluated(run, curve);
  const Statistics all = statistics(values);
  if (values.empty() || all.constant()) return std::nullopt;
  const Span stretch = evaluated_stretch(run.scene, run.corrugation());
  WavePattern pattern;
  for (const int order : {1, 2}) {
    std::complex<double> sum = 0;
    for (int i = 0; i < kPlaces; ++i) {
      const double x = stretch.first + (stretch.last - stretch.first) * i / kPlaces;
      const double phase =
          order * 2 * std::numbers::pi * (x - run.corrugation().first()) / run.scene.corrugation->wavelength;
      sum += values[static_cast<std::size_t>(i)] * std::polar(1.0, -phase);
    }
    sum /= kPlaces;
    pattern.share += 2 * std::norm(sum) / (all.deviation * all.deviation);
    if (order == 1) pattern.shift = std::arg(sum);
  }
  return pattern;
}

bool has_passed(const FinishedRun& run) {
  return wave_pattern(run, history_over_way(run, "vertical_force", "N")).has_value();
}

std::optional<double> correlation(const FinishedRun& run, const CurvePoints& a, const CurvePoints& b) {
  return correlation(evaluated(run, a), evaluated(run, b));
}

std::vector<CrestPeak> vertical_peaks(const FinishedRun& run) {
  if (!has_sine(run)) return {};
  const CurvePoints curve = history_over_way(run, "vertical_force", "N");
  return crest_peaks(run.corrugation(), run.scene.corrugation->wavelength, curve.x, curve.y);
}

std::optional<double> fastening_effect(const FinishedRun& run) {
  const Scene& scene = run.scene;
  if (!scene.fastenings || !scene.rail || static_load(run) <= 0) return std::nullopt;
  const double first = scene.fastenings->first - scene.rail->origin;
  double over = 0, between = 0;
  int count_over = 0, count_between = 0;
  for (const CrestPeak& peak : vertical_peaks(run)) {
    const double spans = (peak.peak - first) / scene.fastenings->spacing;
    constexpr double kQuarter = 0.25;
    const bool near = std::abs(spans - std::round(spans)) < kQuarter;
    (near ? over : between) += peak.force;
    ++(near ? count_over : count_between);
  }
  if (count_over == 0 || count_between == 0) return std::nullopt;
  return (over / count_over - between / count_between) / static_load(run);
}

std::optional<double> longitudinal_delay(const FinishedRun& run, double steady_from) {
  if (!run.rolled()) return std::nullopt;
  const CurvePoints force = history_over_time(run, "longitudinal_force", "N");
  constexpr double kWindow = 1e-3;  // [s]
  constexpr double kReached = 0.98;
  if (force.x.empty() || force.x.back() < steady_from + kWindow) return std::nullopt;
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < force.x.size(); ++i)
    if (force.x[i] >= steady_from) sum += force.y[i], ++count;
  const double wanted = kReached * sum / count;
  double window = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < force.x.size(); ++i) {
    window += force.y[i];
    while (force.x[i] - force.x[last] > kWindow) window -= force.y[last++];
    const bool full = force.x[i] - force.x.front() >= kWindow;
    if (full && window / static_cast<double>(i - last + 1) >= wanted)
      return force.x[i] - 0.5 * kWindow - run.scene.motion->ramp;
  }
  return std::nullopt;
}

std::optional<double> residual_oscillation(const FinishedRun& run, double x) {
  const CurvePoints force = history_over_way(run, "vertical_force", "N");
  const double load = static_load(run);
  if (load <= 0 || force.x.empty() || force.x.back() < x) return std::nullopt;
  double most = 0;
  for (std::size_t i = 0; i < force.x.size(); ++i)
    if (force.x[i] >= x) most = std::max(most, std::abs(force.y[i] - load));
  return most / load;
}

double way_without_contact(const FinishedRun& run, const CurvePoints& force) {
  const Corrugation corrugation = run.corrugation();
  double way = 0;
  for (std::size_t i = 1; i + 1 < force.x.size(); ++i)
    if (force.y[i] <= 0 && force.x[i] > corrugation.first() && force.x[i] < corrugation.last())
      way += 0.5 * (force.x[i + 1] - force.x[i - 1]);
  return way;
}

std::optional<double> vertical_difference(const FinishedRun& a, const FinishedRun& b, double time) {
  const CurvePoints one = history_over_time(a, "vertical_force", "N");
  const CurvePoints other = history_over_time(b, "vertical_force", "N");
  const double load = static_load(a);
  if (load <= 0 || one.x.size() < 2 || other.x.size() < 2) return std::nullopt;
  if (one.x.back() < time || other.x.back() < time) return std::nullopt;
  double most = 0;
  for (std::size_t i = 0; i < one.x.size(); ++i)
    if (one.x[i] >= time && one.x[i] <= other.x.back())
      most = std::max(most, std::abs(one.y[i] - value_at(other.x, other.y, one.x[i])));
  return most / load;
}

std::optional<double> steady_creepage(const FinishedRun& run) {
  const std::optional<double> first = run.number("steady_x_m.0");
  if (!first || *first < settled_torque_x(run.scene)) return std::nullopt;
  return run.number("creepage_percent");
}

std::optional<double> mean_creepage_ratio(const FinishedRun& run) {
  return creepage_ratio(run, "creepage_mean", [](double) { return true; });
}

std::optional<double> node_creepage_ratio(const FinishedRun& run) {
  const std::optional<double> steady = steady_creepage(run);
  if (!steady || vertical_peaks(run).empty()) return std::nullopt;
  const double reach = 2 * multibody_model(run.scene, BeamTheory::euler).patch.semi_axis_x;
  const double turn = std::numbers::pi * run.scene.wheel->diameter / (1 + 1e-2 * *steady);
  return creepage_ratio(run, "creepage_node", [&](double x) {
    return std::abs(std::remainder(x - run.scene.start_x(), turn)) > reach;
  });
}

CurvePoints force_over_way(const MultibodyResult& result) {
  CurvePoints force;
  for (const MultibodySample& sample : result.samples) {
    force.x.push_back(sample.x);
    force.y.push_back(sample.force);
  }
  return force;
}

CurvePoints history_over_way(const FinishedRun& run, const char* column, const char* unit) {
  return first_passage(read_curve(run, {.y = {column, unit}}));
}
CurvePoints history_over_time(const FinishedRun& run, const char* column, const char* unit) {
  return read_curve(run, {.x = {"time", "s"}, .y = {column, unit}});
}
CurvePoints along_axis(const FinishedRun& run, const char* column, const char* unit) {
  return read_curve(run, {.file = "surface_axis.csv", .x = {"x", "m"}, .y = {column, unit}});
}

}  // namespace tread
