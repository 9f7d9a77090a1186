#pragma once
// Time that a rank works in a step.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#include "core/index.hpp"
#include "core/math/statistics.hpp"
#include "core/parallel/parallel.hpp"
#include "core/parallel/ranks.hpp"

namespace tread {

class RankClock {
 public:
  /// Times a step, without the rank's waits for others. Where one thread waits beside the others of its rank,
  /// the rest of the rank works on.
  template <class Step>
  void time(const Ranks& ranks, const Step& step) {
    const double idle = idle_seconds(ranks.traffic);
    const Clock::time_point begun = Clock::now();
    step();
    worked_[index(steps_++ % kKept)] = seconds_since(begun) - (idle_seconds(ranks.traffic) - idle);
  }

  std::int64_t steps() const { return steps_; }              ///< since the start
  double passed() const { return seconds_since(started_); }  ///< since the start [s]

  /// Each rank's median of its last steps [s], in which looks at the energies and breaks for other programs
  /// do not count; starts all clocks anew. All ranks call it.
  std::vector<double> take(Ranks& ranks) {
    std::vector<std::int64_t> first;
    for (std::int64_t rank = 0; rank <= ranks.count(); ++rank) first.push_back(rank);
    std::vector<double> medians(index(ranks.count()));
    medians[index(ranks.rank())] = steps_ > 0 ? median(last_steps()) : 0;
    ranks.gather(medians.data(), first);
    *this = {};
    return medians;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::int64_t kKept = 4096;

  static double seconds_since(Clock::time_point begun) {
    return std::chrono::duration<double>(Clock::now() - begun).count();
  }
  static double idle_seconds(const RankTraffic& traffic) {
    return traffic.seconds - traffic.beside + traffic.beside / threads();
  }
  std::vector<double> last_steps() const {
    return {worked_.begin(), worked_.begin() + std::min(steps_, kKept)};
  }

  Clock::time_point started_ = Clock::now();
  std::array<double, kKept> worked_{};  ///< in the last steps [s]
  std::int64_t steps_ = 0;
};

}  // namespace tread
