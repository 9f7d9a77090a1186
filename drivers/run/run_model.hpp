#pragma once
// The model of a run, as a process that goes on with the run makes it.

#include <string>

#include "drivers/engine/model/model.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/results/run_results.hpp"
#include "drivers/run/run_checkpoint.hpp"

namespace tread {

/// Scene of the order with the values that later processes asked for.
ResolvedScene resolve_with_later(const RunOrder& order);

/// Takes over output, limits and duration from the scene of resolve_with_later(). Throws InputError where the
/// rail is too short for the duration.
void adopt_later_values(Model& model, const Scene& later);

/// InputError where a run whose model is of the scene `made` cannot end when `later` says: the rail is too
/// short, or the run's `state` is beyond that. [nullptr: no state yet]
void require_later_end(const Scene& made, const Scene& later, const SealedContent* state);

/// The model of the scene `made`. With a `state` the run's results come out of it, and the model has its
/// corrugation. [nullptr: no state yet]
Model run_model(const ResolvedScene& made, const SealedContent* state, RunResults& results);

/// Time step of a run of the model in `results`; nothing without [motion]. Throws InputError where the
/// materials' damping leaves too little of it.
void find_step(const Model& model, RunResults& results);

/// InputError where the scene's bodies from files exclude the chosen device or ranks. With the option "auto"
/// the processor takes the steps then, and `progress` says why.
void settle_device(const Scene& scene, const std::string& option, const Progress& progress);

/// The same with ResourceError where the device lacks memory for the steps of the model, by its estimate.
void settle_device(const Model& model, const std::string& option, const Progress& progress);

}  // namespace tread
