#pragma once
// What a rank works in steps, by the clock.

#include <chrono>
#include <utility>
#include <vector>

#include "core/index.hpp"
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
    worked_ += seconds_since(begun) - (idle_seconds(ranks.traffic) - idle);
  }

  double passed() const { return seconds_since(started_); }  ///< since the start [s]

  /// What each rank has worked since its clock started [s]; starts all of them anew. All ranks call it.
  std::vector<double> take(Ranks& ranks) {
    std::vector<std::int64_t> first;
    for (std::int64_t rank = 0; rank <= ranks.count(); ++rank) first.push_back(rank);
    std::vector<double> worked(index(ranks.count()));
    worked[index(ranks.rank())] = worked_;
    ranks.gather(worked.data(), first);
    *this = {};
    return worked;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds_since(Clock::time_point begun) {
    return std::chrono::duration<double>(Clock::now() - begun).count();
  }
  static double idle_seconds(const RankTraffic& traffic) {
    return traffic.seconds - traffic.beside + traffic.beside / threads();
  }

  Clock::time_point started_ = Clock::now();
  double worked_ = 0;
};

}  // namespace tread
