#include "drivers/bench/projection.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tread {

double WaitModel::of(const PhaseWork& phase, int cores) const {
  if (cores < 2) return 0;
  return call * phase.calls * std::log2(cores) + share * phase.busy / cores;
}

WaitModel fit_waits(const std::vector<PhaseWork>& phases, int threads) {
  if (threads < 2) return {};
  // Least squares of waiting = call log2(threads) + share busy / threads, both a call.
  const double growth = std::log2(threads);
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const PhaseWork& phase : phases) {
    if (phase.calls <= 0) continue;
    const double work = phase.busy / threads / phase.calls;
    const double wait = phase.waiting / phase.calls;
    n += phase.calls;
    x += phase.calls * work;
    y += phase.calls * wait;
    xx += phase.calls * work * work;
    xy += phase.calls * work * wait;
  }
  if (n <= 0) return {};
  const double spread = n * xx - x * x;
  double share = spread > 0 ? std::max((n * xy - x * y) / spread, 0.0) : 0;
  double call = (y - share * x) / n;
  if (call < 0) {
    call = 0;
    share = xx > 0 ? std::max(xy / xx, 0.0) : 0;
  }
  return {call / growth, share};
}

ProjectedStep project(const std::vector<PhaseWork>& phases, const WaitModel& waits, int cores) {
  ProjectedStep step;
  step.cores = cores;
  double work = 0, bytes = 0, largest = 0;
  for (const PhaseWork& phase : phases) {
    const double even = phase.busy / cores;
    const double uneven = std::max(phase.longest - even, 0.0);
    const double waiting = waits.of(phase, cores);
    work += phase.serial + phase.busy;
    bytes += phase.bytes;
    step.seconds += phase.serial + even + uneven + waiting;
    const std::array<std::pair<double, const char*>, 3> losses = {
        {{phase.serial * (cores - 1), "serial"}, {uneven * cores, "uneven"}, {waiting * cores, "waiting"}}};
    step.serial += losses[0].first;
    step.uneven += losses[1].first;
    step.waiting += losses[2].first;
    for (const auto& [loss, cause] : losses) {
      if (loss <= largest) continue;
      largest = loss;
      step.limit = fmt::format("{}: {}", phase.name, cause);
    }
  }
  const double core_time = cores * step.seconds;
  if (core_time <= 0) return step;
  step.efficiency = work / core_time;
  for (double* lost : {&step.serial, &step.uneven, &step.waiting}) *lost /= core_time;
  step.bandwidth = bytes / step.seconds;
  return step;
}

Table projection_table(const std::vector<ProjectedStep>& steps, double elements) {
  Table table{"",
              {{"Cores", Align::right},
               {"us/step", Align::right},
               {"1e6/s", Align::right},
               {"Efficiency", Align::right},
               {"Lost: serial", Align::right},
               {"uneven", Align::right},
               {"waiting", Align::right},
               {"Memory, GB/s", Align::right},
               {"Largest loss"}},
              {}};
  const auto percent = [](double share) { return fmt::format("{:.1f} %", 100 * share); };
  for (const ProjectedStep& step : steps)
    table.rows.push_back({std::to_string(step.cores), fmt::format("{:.1f}", 1e6 * step.seconds),
                          fmt::format("{:.0f}", 1e-6 * elements / step.seconds), percent(step.efficiency),
                          percent(step.serial), percent(step.uneven), percent(step.waiting),
                          fmt::format("{:.0f}", 1e-9 * step.bandwidth), step.limit});
  return table;
}

}  // namespace tread
