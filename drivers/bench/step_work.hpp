#pragma once
// Arithmetic and memory traffic of a step's phases.

#include "drivers/bench/limits.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/engine/phase_clock.hpp"

namespace tread {

/// Load of a phase. Zeros for uncounted phases: contact, connectors, loads, the few nodes that move apart,
/// samples.
Load phase_load(const Model& model, StepPhase phase);

}  // namespace tread
