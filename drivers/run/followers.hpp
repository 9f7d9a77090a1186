#pragma once
// The ranks beside rank 0: they take the steps of its run with it, and hold nothing else of the run.

#include <memory>
#include <optional>
#include <string>

#include "core/parallel/ranks.hpp"
#include "drivers/engine/ranks/rank_shares.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/run/rank_clock.hpp"
#include "drivers/run/run_options.hpp"
#include "io/files/sealed_file.hpp"

namespace tread {

/// Rank 0's word to the other ranks. Without other ranks every call is the simulation's alone.
class Followers {
 public:
  /// Those of the chosen ranks.
  Followers();

  bool absent() const { return !ranks_; }

  /// Hands the run over, at its beginning or anew: its content between two steps, as pack_run() packs it.
  void begin(SealedContent run, Simulation& simulation, const ThreadOptions& threads);
  /// A step on all ranks.
  void step(Simulation& simulation);
  /// Compares the times of the ranks now and then. Returns true where other shares of the work, which the
  /// next simulation gets, save more than begin() takes. `left`: time of the steps to come with those of now
  /// [s].
  bool find_better_shares(double left);
  /// Brings all values of the fields to rank 0.
  void fetch(const Simulation& simulation) const;
  /// The run is over: the others free its memory.
  void end() const;

  /// "3 ranks, threads of each: 2", with what a step exchanges once steps have been taken.
  std::string description(std::int64_t steps) const;
  /// "elements of rank 0: 42.1 %, of each other: 57.9 to 57.9 %".
  std::string shares() const;

 private:
  std::shared_ptr<Ranks> ranks_;
  RankClock clock_;
  RankTraffic traffic_;                ///< of rank 0's steps
  std::int64_t interval_ = 1000;       ///< steps until ranks compare their times
  std::optional<TimedShares> before_;  ///< that those of now are to better, by a step's time
  double begin_seconds_ = 0;           ///< that the last begin() took [s]
};

/// Does on another rank than 0 what rank 0 says, run by run, until dismiss(). Errors leave as those of
/// Simulation do, except those that all ranks meet in the same step: rank 0 reports them.
void follow(Ranks& ranks);

/// Gives each rank a device of this name, as choose_device() does; all have one where rank 0 finds one. A
/// rank whose card is another than rank 0's ends all, by a ResourceError of its follow().
void choose_devices(Ranks& ranks, const std::string& name);

/// Ends follow() on the other ranks.
void dismiss(Ranks& ranks);

}  // namespace tread
