#pragma once
// Where the time of steps goes, phase by phase.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

#include "core/parallel/parallel.hpp"

namespace tread {

/// Parts of Simulation::step in the order in which they run.
enum class StepPhase {
  contact_search,
  deform,    ///< internal force, and the motion of nodes on which nothing else acts
  measured,  ///< energies and samples, in some steps only
  tied_forces,
  connectors,
  loads,
  update,  ///< motion of the other nodes
  contact,
  tied_motion,
  surface_fields,
  anchor,
};
inline constexpr std::size_t kStepPhases = 11;

/// "internal force".
const char* name_of(StepPhase phase);

/// Values that the processor counts while a phase runs.
struct CounterValues {
  std::int64_t cycles = 0, instructions = 0, cache_misses = 0;
};

struct PhaseTimes {
  double seconds = 0;
  ParallelTimes parallel;
  CounterValues counters;
};

/// Between start() and stop() all time belongs to the phase entered last.
class PhaseClock {
 public:
  /// `counters` reads the processor's counters; empty: there are none.
  explicit PhaseClock(std::function<CounterValues()> counters = {}) : counters_(std::move(counters)) {}
  ~PhaseClock() { stop(); }
  PhaseClock(const PhaseClock&) = delete;
  PhaseClock& operator=(const PhaseClock&) = delete;

  void enter(StepPhase phase);
  void stop();

  const PhaseTimes& times(StepPhase phase) const { return times_[static_cast<std::size_t>(phase)]; }

 private:
  void close();

  std::function<CounterValues()> counters_;
  std::array<PhaseTimes, kStepPhases> times_;
  PhaseTimes* current_ = nullptr;
  std::chrono::steady_clock::time_point entered_;
  CounterValues counted_;
};

}  // namespace tread
