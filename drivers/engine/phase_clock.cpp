#include "drivers/engine/phase_clock.hpp"

#include <algorithm>

namespace tread {

void PhaseClock::enter(StepPhase phase) {
  close();
  list(phase);
  current_ = &times_[static_cast<std::size_t>(phase)];
  links_before_ = current_->parallel.links;
  measure_parallel(&current_->parallel);
  if (counters_) counted_ = counters_();
  entered_ = std::chrono::steady_clock::now();
}

void PhaseClock::list(StepPhase phase) {
  if (std::find(entered_phases_.begin(), entered_phases_.end(), phase) == entered_phases_.end())
    entered_phases_.push_back(phase);
}

void PhaseClock::had_beside(StepPhase phase, std::size_t link) {
  list(phase);
  PhaseTimes& times = times_[static_cast<std::size_t>(phase)];
  const double seconds = current_->parallel.links[link] - links_before_[link];
  times.seconds += seconds;
  times.beside += seconds;
}

void PhaseClock::stop() {
  if (!current_) return;
  close();
  current_ = nullptr;
  measure_parallel(nullptr);
}

void PhaseClock::close() {
  if (!current_) return;
  current_->seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - entered_).count();
  if (!counters_) return;
  const CounterValues now = counters_();
  current_->counters.cycles += now.cycles - counted_.cycles;
  current_->counters.instructions += now.instructions - counted_.instructions;
  current_->counters.cache_misses += now.cache_misses - counted_.cache_misses;
}

}  // namespace tread
