#include "drivers/bench/measurement.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tread {

namespace {

/// Time of `calls` calls [s]. Without a reset between the calls the clock is read only twice.
double run(const TimedCall& timed, int calls) {
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

}  // namespace

Measurement measure(const TimedCall& timed, const MeasurementPlan& plan) {
  // Warms up and finds the number of calls that a run needs.
  int calls = 1;
  for (double seconds = run(timed, 1); seconds < plan.run_seconds;) {
    const double wanted = 1.2 * plan.run_seconds / std::max(seconds / calls, 1e-9);
    calls = static_cast<int>(std::ceil(std::clamp(wanted, calls + 1.0, 10.0 * calls)));
    seconds = run(timed, calls);
  }
  std::vector<double> seconds;
  seconds.reserve(static_cast<std::size_t>(plan.repetitions));
  for (int i = 0; i < plan.repetitions; ++i) seconds.push_back(run(timed, calls) / calls);
  return summarise(std::move(seconds));
}

Measurement summarise(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  const std::size_t n = seconds.size();
  const double median = 0.5 * (seconds[(n - 1) / 2] + seconds[n / 2]);
  return {median, seconds.front(), (seconds.back() - seconds.front()) / median, static_cast<int>(n)};
}

}  // namespace tread
