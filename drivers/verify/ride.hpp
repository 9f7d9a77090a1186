#pragma once
// A scene run as by a user, kept in memory.

#include <string>
#include <utility>

#include "drivers/engine/model/model.hpp"
#include "drivers/results/run_results.hpp"
#include "drivers/verify/verify_case.hpp"
#include "io/report/report.hpp"

namespace tread {

/// Preload and rolling of the model's scene to the end of its duration, with about `samples` samples and
/// summary values as in summary.json. Throws NumericalError as a run would.
RunResults ride(Model& model, int samples, const ProgressText& progress);

/// Rolling by a number of steps.
struct WholeRun {
  std::int64_t steps;
  Simulation simulation;

  /// Takes `count` steps of dt [s]; one in `every` is sampled.
  WholeRun(Model& model, const Preload& preload, double dt, std::int64_t count, std::int64_t every)
      : steps(count), simulation(model, preload, dt) {
    simulation.set_sampling_interval(every);
  }

  /// Steps to the end. `see` receives the simulation after every sampled step.
  template <class See>
  void roll(const See& see) {
    while (simulation.steps() < steps) {
      simulation.step();
      if (simulation.sampled()) see();
    }
  }
};

/// Rolling to the end of the scene's duration with the fewest steps of one size that its step_safety allows,
/// or `least` steps if these are more. About `samples` samples.
WholeRun whole_run(Model& model, const Preload& preload, int samples, std::int64_t least = 1);

/// Mean over the samples from `first` [s] on.
template <class Value>
Statistics since(const RunResults& results, double first, const Value& value) {
  return statistics(
      results.samples, [first](const Sample& s) { return s.time >= first; }, value);
}

/// Number of samples with a value that is not finite.
int count_not_finite(const Model& model, const RunResults& results);

/// Error of the balance of angular momentum [-], from the samples. I times the change of spin is compared
/// with the angular impulse of torque and F_L about the axle, with the nominal radius as F_L's arm. The
/// reference is the impulse of F_N times the radius.
double angular_momentum_error(const Model& model, const RunResults& results);

/// Adds the findings by which every ride is judged: errors of energy and momentum, samples that are not
/// finite.
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
