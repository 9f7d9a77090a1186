#include "drivers/bench/measurement.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/math/statistics.hpp"
#include "drivers/process/core_watch.hpp"

namespace tread {

double time_calls(const TimedCall& timed, int calls) {
  using Clock = std::chrono::steady_clock;
  Clock::duration spent{};
  if (!timed.reset) {
    const auto start = Clock::now();
    for (int i = 0; i < calls; ++i) timed.call();
    spent = Clock::now() - start;
  } else {
    for (int i = 0; i < calls; ++i) {
      timed.reset();
      const auto start = Clock::now();
      timed.call();
      spent += Clock::now() - start;
    }
  }
  return std::chrono::duration<double>(spent).count();
}

int warm_up(const TimedCall& timed, const MeasurementPlan& plan) {
  int calls = 1;
  for (double seconds = time_calls(timed, 1); seconds < plan.run_seconds;) {
    const double wanted = 1.2 * plan.run_seconds / std::max(seconds / calls, 1e-9);
    calls = static_cast<int>(std::ceil(std::clamp(wanted, calls + 1.0, 10.0 * calls)));
    seconds = time_calls(timed, calls);
  }
  return calls;
}

Measurement measure(const TimedCall& timed, const MeasurementPlan& plan) {
  const int calls = warm_up(timed, plan);
  std::vector<double> seconds;
  seconds.reserve(static_cast<std::size_t>(plan.repetitions));
  const CoreWatch cores;
  for (int i = 0; i < plan.repetitions; ++i) seconds.push_back(time_calls(timed, calls) / calls);
  return summarise(seconds, cores.share());
}

Measurement summarise(const std::vector<double>& seconds, double processor_share) {
  const auto [fastest, slowest] = std::minmax_element(seconds.begin(), seconds.end());
  const double middle = median(seconds);
  return {middle, *fastest, (*slowest - *fastest) / middle, static_cast<int>(seconds.size()),
          processor_share};
}

}  // namespace tread
