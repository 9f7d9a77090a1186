#pragma once
// Motion at t = 0, by MotionSpec::start. [theory.md, Start]

#include <optional>

#include "core/aligned.hpp"
#include "core/body_frame.hpp"
#include "drivers/engine/features/feature.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/engine/start/moving_deflection.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/run_in.hpp"

namespace tread {

/// Brings rail and wheel to where rolling has brought them, if there is a run-in; before contact is found.
void place_run_in(const Model& model, const std::optional<RunIn>& run_in, const StartFields& fields);

/// Velocities of rail, wheel and its frame, and the pulse of a bar; after contact has been found.
void start_velocities(const Model& model, const Preload& preload, const StartFields& fields);

/// Motion of the sprung mass at t = 0 against its place at rest.
SprungStart sprung_start(const std::optional<RunIn>& run_in);

}  // namespace tread
