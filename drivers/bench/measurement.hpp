#pragma once
// How long a call takes: warm-up, then the median and the spread of several runs.

#include <functional>
#include <vector>

namespace tread {

struct Measurement {
  double seconds = 0;   ///< of a call, median of the runs [s]
  double fastest = 0;   ///< of a call in the fastest run [s]
  double spread = 0;    ///< slowest less fastest run, over the median [-]
  int repetitions = 0;  ///< runs
};

struct MeasurementPlan {
  int repetitions = 7;        ///< runs, at least 5 for a spread worth recording
  double run_seconds = 0.05;  ///< a run lasts at least so long, of as many calls as that needs [s]
};

/// What is timed, and what brings back the state before it, which is not.
struct TimedCall {
  std::function<void()> call;
  std::function<void()> reset{};  ///< may be empty
};

Measurement measure(const TimedCall& timed, const MeasurementPlan& plan);

/// Median and spread of the seconds of single runs.
Measurement summarise(std::vector<double> seconds);

}  // namespace tread
