#pragma once
// Runs that begin with the state of another one, over another corrugation. [long-runs.md, Fork]

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/corrugation.hpp"
#include "core/travel.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/run/run_checkpoint.hpp"

namespace tread {

inline constexpr const char* kForkFolder = "forks";  ///< of a run's folder: states that stay

/// A run that begins with another one's state.
struct Fork {
  RunOrder order;                              ///< of the run that begins
  SealedContent content;                       ///< the state, as a checkpoint of that run
  std::optional<CorrugationSpec> corrugation;  ///< of the other run
};

/// From "DIR@TIME", such as "out@10 ms": the last state that the run in DIR has kept up to that time; from
/// "DIR": its last. `wanted`: the run that begins, its scene's source, overrides and command. Probes that
/// differ have no values before the state. InputError where there is no such state, or where the scenes
/// differ in what the state depends on.
Fork fork_from(const std::string& from, const RunOrder& wanted, const Progress& progress);

/// Depth of a corrugation that forks of the run in "DIR" or "DIR@TIME" have room for [m]. InputError.
double fork_room(const std::string& from);

/// InputError where the rail that the wheel has met so far is not that of the other run. `model`: of the run
/// that begins, corrugated. `samples`: of the state.
void require_same_past(const Fork& fork, const Model& model, const std::vector<Sample>& samples);

/// Values that tell when the wheel of a run with [forks] comes near a place.
struct Approach {
  double start = 0;   ///< x of the wheel at t = 0 [m]
  double before = 0;  ///< a state is kept so far before the place: the searched surface and a margin [m]
  DrivenWheel wheel;

  /// By which the wheel is surely not nearer, traction and creepage included; not positive where it begins
  /// nearer. [s]
  double time(const MotionSpec& motion, double x) const;
};

/// `reach`: Contact::reach() of the scene's model, before the corrugation is applied or with the deepest one
/// [m].
Approach approach_of(const Scene& scene, double reach);

/// Steps of length `dt` [s] after which the run keeps the state for its forks; nothing where the scene wants
/// none. InputError where the corrugation begins too near for ForkSpec::at to be left out.
std::optional<std::int64_t> fork_step(const Model& model, double dt);

/// InputError where the run ends before that step, or a stated ForkSpec::at lies before step `begun`, its
/// first.
void require_fork_step(const Model& model, double dt, std::int64_t begun = 0);

}  // namespace tread
