#include "drivers/studies/compare/curve_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "core/math/interpolation.hpp"
#include "drivers/engine/model/sections.hpp"
#include "io/scene/table_reader.hpp"
#include "io/text/text.hpp"
#include "io/text/units.hpp"

namespace tread {

ForceCurve read_force_curve(const std::filesystem::path& path, const std::string& force,
                            const std::string& offset) {
  TableRules rules{.needs_units = true, .increasing = true};
  rules.first = {kLength, kTime};
  rules.second = {kForce};
  const std::string other = force == "F_N" ? "F_L" : "F_N";
  rules.names = {{"x", "s", "t", "time"}, {force, lower_case(force), lower_case(other), "f", "force"}};
  rules.example = "x [m]  " + force + " [kN]";
  TwoColumns columns = read_two_columns(path, rules);
  if (lower_case(columns.names[1]) == lower_case(other))
    throw ProblemsError(
        {{path.string(), 0, 0, "",
          fmt::format("the file holds {0}, the run's {1} is compared; state --force {0}", other, force)}});
  ForceCurve curve{path.string(), columns.dimension == kTime.dimension, std::move(columns.first),
                   std::move(columns.second)};
  if (offset.empty()) return curve;
  try {
    const double moved = parse_quantity(offset, curve.over_time ? kTime : kLength);
    for (double& at : curve.at) at += moved;
  } catch (const InputError& error) {
    throw InputError(fmt::format("--offset \"{}\": {}", offset, error.what()));
  }
  return curve;
}

double mean_about(const std::vector<double>& x, const std::vector<double>& y, double place, double width) {
  if (width <= 0) return value_at(x, y, place);
  const double first = place - 0.5 * width;
  const double last = place + 0.5 * width;
  double before = value_at(x, y, first);
  const double end = value_at(x, y, last);
  if (std::isnan(before) || std::isnan(end)) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  double at = first;
  const auto add = [&](double to, double value) {
    sum += 0.5 * (before + value) * (to - at);
    at = to;
    before = value;
  };
  for (auto i = std::upper_bound(x.begin(), x.end(), first); i != x.end() && *i < last; ++i)
    add(*i, y[static_cast<std::size_t>(i - x.begin())]);
  add(last, end);
  return sum / width;
}

namespace {

struct OverTheWay {
  std::vector<double> x;      ///< [m]
  std::vector<double> force;  ///< [N]
};

/// The curve over the way; times become the places where the wheel then was.
OverTheWay over_the_way(const ForceCurve& curve, const TransientRun& run) {
  if (!curve.over_time) return {curve.at, curve.force};
  OverTheWay over;
  for (std::size_t i = 0; i < curve.at.size(); ++i) {
    const double x = value_at(run.time, run.x, curve.at[i]);
    if (std::isnan(x) || (!over.x.empty() && x <= over.x.back())) continue;
    over.x.push_back(x);
    over.force.push_back(curve.force[i]);
  }
  return over;
}

/// "--from 5 m, --mean 10 m", the stated limits of the compared stretch.
std::string stated_limits(const ComparisonOptions& options) {
  std::vector<std::string> texts;
  if (options.first) texts.push_back(fmt::format("--from {:.6g} m", *options.first));
  if (options.last) texts.push_back(fmt::format("--to {:.6g} m", *options.last));
  if (options.mean > 0) texts.push_back(fmt::format("--mean {:.6g} m", options.mean));
  return fmt::format("{}", fmt::join(texts, ", "));
}

[[noreturn]] void too_little_in_common(const TransientRun& run, const ForceCurve& curve,
                                       const ComparisonOptions& options) {
  const char* unit = curve.over_time ? "s" : "m";
  const auto rounded = [](double value) { return std::abs(value) < 1e-9 ? 0 : value; };
  const double first = rounded(curve.over_time ? run.time.front() : run.x.front());
  const double last = rounded(curve.over_time ? run.time.back() : run.x.back());
  const std::string limits = stated_limits(options);
  const std::string cure = limits.empty() ? "move the curve by --offset"
                                          : fmt::format(
                                                "{} leaves too little: state others, or move the "
                                                "curve by --offset; the wheel is at {:.6g} to {:.6g} m",
                                                limits, rounded(run.x.front()), rounded(run.x.back()));
  throw InputError(fmt::format(
      "{}: it covers {:.6g} to {:.6g} {unit}, the run {} covers {:.6g} to {:.6g} {unit}: fewer than "
      "two samples of the run lie in both; {}{}{}",
      curve.name, rounded(curve.at.front()), rounded(curve.at.back()), run.directory.string(), first, last,
      cure, run.unfinished.empty() ? "" : "; ", run.unfinished, fmt::arg("unit", unit)));
}

/// Lead of the peaks before the crests of the scene's sine [rad]. Peaks of a force that is negative in the
/// mean, as F_L of a wheel that brakes, are its least values.
std::optional<double> shift_of(const Scene& scene, const std::vector<double>& x, std::vector<double> force) {
  if (!scene.corrugation || scene.corrugation->kind != "sine") return std::nullopt;
  if (std::accumulate(force.begin(), force.end(), 0.0) < 0)
    for (double& value : force) value = -value;
  const Corrugation sine = corrugation_of(*scene.corrugation, scene.corrugation->centre.value_or(0));
  const std::vector<CrestPeak> peaks = crest_peaks(sine, scene.corrugation->wavelength, x, force);
  if (peaks.empty()) return std::nullopt;
  return mean_shift(peaks);
}

}  // namespace

CurveComparison compare(const TransientRun& run, const ForceCurve& curve, const ComparisonOptions& options) {
  const OverTheWay other = over_the_way(curve, run);
  CurveComparison c;
  double squares = 0;
  for (const double x : run.x) {
    if (x < options.first.value_or(x) || x > options.last.value_or(x)) continue;
    if (!c.x.empty() && x <= c.x.back()) continue;
    const double ours = mean_about(run.x, run.force, x, options.mean);
    const double theirs = mean_about(other.x, other.force, x, options.mean);
    if (std::isnan(ours) || std::isnan(theirs)) continue;
    c.x.push_back(x);
    c.run.push_back(ours);
    c.curve.push_back(theirs);
    squares += (ours - theirs) * (ours - theirs);
  }
  if (c.x.size() < 2) too_little_in_common(run, curve, options);
  c.of_run = statistics(c.run);
  c.of_curve = statistics(c.curve);
  c.misfit = std::sqrt(squares / static_cast<double>(c.x.size()));
  c.correlation = correlation(c.run, c.curve);
  c.run_shift = shift_of(run.scene, c.x, c.run);
  c.curve_shift = shift_of(run.scene, c.x, c.curve);
  return c;
}

}  // namespace tread
