#pragma once
// The part of the way over which a passage is judged.

#include "core/corrugation.hpp"
#include "core/scene.hpp"
#include "drivers/engine/model/station_plan.hpp"

namespace tread {

/// A corrugation, less half a wave at each end where more than one wave is left by that; the solution zone of
/// a smooth rail.
Span evaluated_stretch(const Scene& scene, const Corrugation& corrugation);

/// Time from which the torque of a scene with [motion] counts as settled: half a ramp beyond its last change
/// [s].
double settled_torque_time(const Scene& scene);

/// Foremost place of the wheel at that time, by travel_of() [m].
double settled_torque_x(const Scene& scene);

}  // namespace tread
