#pragma once
// Time of steps by phase.

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "core/parallel/parallel.hpp"
#include "drivers/engine/features/step_phase.hpp"

namespace tread {

/// Values that the processor counts while a phase runs.
struct CounterValues {
  std::int64_t cycles = 0, instructions = 0, cache_misses = 0;
};

struct PhaseTimes {
  double seconds = 0;
  double beside = 0;  ///< of these, beside another phase [s]
  ParallelTimes parallel;
  CounterValues counters;
};

/// Between start() and stop() all time belongs to the phase entered last.
class PhaseClock {
 public:
  /// `counters` reads the processor's counters; empty: there are none.
  explicit PhaseClock(std::function<CounterValues()> counters = {}) : counters_(std::move(counters)) {
    entered_phases_.reserve(kStepPhases);
  }
  ~PhaseClock() { stop(); }
  PhaseClock(const PhaseClock&) = delete;
  PhaseClock& operator=(const PhaseClock&) = delete;

  void enter(StepPhase phase);
  /// This phase was a link of the chain beside the one entered last; its own time is the core-time of the
  /// link.
  void had_beside(StepPhase phase, std::size_t link);
  void stop();

  /// Phases that were entered, in the order of their first time.
  const std::vector<StepPhase>& phases() const { return entered_phases_; }
  const PhaseTimes& times(StepPhase phase) const { return times_[static_cast<std::size_t>(phase)]; }

 private:
  void close();
  void list(StepPhase phase);

  std::function<CounterValues()> counters_;
  std::vector<StepPhase> entered_phases_;
  std::array<PhaseTimes, kStepPhases> times_;
  PhaseTimes* current_ = nullptr;
  std::array<double, kMostLinks> links_before_{};  ///< ParallelTimes::links when the phase was entered [s]
  std::chrono::steady_clock::time_point entered_;
  CounterValues counted_;
};

}  // namespace tread
