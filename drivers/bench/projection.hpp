#pragma once
// Time of a step on more cores than the machine has, from the work and span of its phases.
// [performance.md, More cores]

#include <string>
#include <vector>

#include "io/report/plain_text.hpp"

namespace tread {

/// A phase of a step, measured on some threads.
struct PhaseWork {
  const char* name;
  double serial;   ///< wall clock outside of parallel calls [s]
  double busy;     ///< core-time in the bodies of parallel calls [s]
  double longest;  ///< longest items of the calls, one after the other [s]
  double waiting;  ///< wall clock of the calls less busy time over the threads [s]
  double calls;    ///< parallel calls
  double bytes;    ///< that it moves, where they are counted [B]
};

/// Wall clock that a parallel call waits besides the work of its bodies.
struct WaitModel {
  double call = 0;   ///< on two cores; grows with the logarithm of the cores [s]
  double share = 0;  ///< of the busy time over the cores: the last ranges end at different times [-]

  double of(const PhaseWork& phase, int cores) const;
};

/// Fit to the phases, each call of like weight; neither part is negative.
WaitModel fit_waits(const std::vector<PhaseWork>& phases, int threads);

/// A step on some cores.
struct ProjectedStep {
  int cores = 0;
  double seconds = 0;
  double efficiency = 0;                       ///< work over core-time, an upper estimate [-]
  double serial = 0, uneven = 0, waiting = 0;  ///< shares of the core-time that are lost [-]
  double bandwidth = 0;                        ///< of the memory, to move the counted bytes [B/s]
  std::string limit;                           ///< phase and cause of the largest loss
};

/// Each phase takes its serial time, the longer of its work over the cores and its longest items, and waits.
/// Work is the busy time on the threads that were measured: more threads slow one another's bodies, which is
/// not in the model.
ProjectedStep project(const std::vector<PhaseWork>& phases, const WaitModel& waits, int cores);

Table projection_table(const std::vector<ProjectedStep>& steps, double elements);

}  // namespace tread
