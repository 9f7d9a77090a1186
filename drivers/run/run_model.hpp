#pragma once
// The model of a run, as a process that goes on with the run makes it.

#include "drivers/engine/model.hpp"
#include "drivers/run/run_checkpoint.hpp"

namespace tread {

/// Scene of the order with the values that later processes asked for.
ResolvedScene resolve_with_later(const RunOrder& order);

/// Takes over output, limits and duration from the scene of resolve_with_later(). Throws InputError where the
/// rail is too short for the duration.
void adopt_later_values(Model& model, const Scene& later);

}  // namespace tread
