#pragma once
// Duration of a call: warm-up, then the median and the spread of several runs.

#include <functional>
#include <vector>

namespace tread {

struct Measurement {
  double seconds = 0;          ///< time of a call, median of the runs [s]
  double fastest = 0;          ///< time of a call in the fastest run [s]
  double spread = 0;           ///< slowest less fastest run, over the median [-]
  int repetitions = 0;         ///< number of runs
  double processor_share = 0;  ///< processor time of the runs over wall clock and threads [-]
};

struct MeasurementPlan {
  int repetitions = 7;        ///< number of runs, at least 5 for a spread worth recording
  double run_seconds = 0.05;  ///< shortest duration of a run, which makes as many calls as that needs [s]
};

/// The timed call and an untimed reset that restores the state before it.
struct TimedCall {
  std::function<void()> call;
  std::function<void()> reset{};  ///< may be empty
};

Measurement measure(const TimedCall& timed, const MeasurementPlan& plan);

/// Warms up. Returns the number of calls that a run of the plan's duration needs.
int warm_up(const TimedCall& timed, const MeasurementPlan& plan);

/// Time of so many calls without their resets [s]. Without a reset the clock is read only twice.
double time_calls(const TimedCall& timed, int calls);

/// Median and spread of the seconds of single runs.
Measurement summarise(const std::vector<double>& seconds, double processor_share);

}  // namespace tread
