#pragma once
// Operations and bytes of the phases of a model's step, as far as they are counted.

#include "drivers/bench/limits.hpp"
#include "drivers/engine/model.hpp"
#include "drivers/engine/phase_clock.hpp"

namespace tread {

/// Load of a phase. Zeros for uncounted phases: contact, connectors, loads, the few nodes that move apart,
/// samples.
Load phase_load(const Model& model, StepPhase phase);

}  // namespace tread
