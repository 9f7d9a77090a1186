#pragma once
// A scene run as a user would, kept in memory.

#include <string>
#include <utility>

#include "drivers/engine/model.hpp"
#include "drivers/results/run_results.hpp"
#include "drivers/verify/verify_case.hpp"
#include "io/report/report.hpp"

namespace tread {

/// Preload and rolling of the model's scene to the end of its duration with about `samples` samples; figures
/// as in summary.json. Stops with NumericalError as a run would.
RunResults ride(Model& model, int samples, const ProgressText& progress);

/// Rolling whose last step ends at the scene's duration.
struct WholeRun {
  std::int64_t steps;
  Simulation simulation;

  /// To the end; `see` looks at the simulation after every sampled step.
  template <class See>
  void roll(const See& see) {
    while (simulation.steps() < steps) {
      simulation.step();
      if (simulation.sampled()) see();
    }
  }
};

/// The fewest steps of one size that the scene's step_safety allows, or `least`; about `samples` samples.
WholeRun whole_run(Model& model, const Preload& preload, int samples, std::int64_t least = 1);

/// Mean over the samples from `first` on [s].
template <class Value>
Statistics since(const RunResults& results, double first, const Value& value) {
  return statistics(
      results.samples, [first](const Sample& s) { return s.time >= first; }, value);
}

/// Samples in which a value is not finite.
int count_not_finite(const Model& model, const RunResults& results);

/// I times the change of spin against the angular impulse of torque and F_L about the axle, over the impulse
/// of F_N times the radius: from the samples, with the nominal radius as F_L's arm.
double angular_momentum_error(const Model& model, const RunResults& results);

/// Adds what every ride is judged by: errors of energy and momentum, samples that are not finite.
void judge_ride(const std::string& at, const Model& model, const RunResults& results,
                std::vector<Finding>& findings);

/// A value of the samples over time, scaled for the figure.
template <class Value>
Series history(std::string name, const RunResults& results, const Value& value) {
  Series series{std::move(name), {}, {}, Stroke::solid};
  for (const Sample& sample : results.samples) {
    series.x.push_back(1e3 * sample.time);
    series.y.push_back(value(sample));
  }
  return series;
}

}  // namespace tread
