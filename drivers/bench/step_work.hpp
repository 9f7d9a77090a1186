#pragma once
// What the phases of a model's step compute and move, as far as it is counted.

#include "drivers/bench/limits.hpp"
#include "drivers/engine/model.hpp"
#include "drivers/engine/phase_clock.hpp"

namespace tread {

/// Zeros where nothing is counted: contact, connectors, loads, the few nodes that move apart, samples.
Load phase_load(const Model& model, StepPhase phase);

}  // namespace tread
