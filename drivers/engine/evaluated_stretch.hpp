#pragma once
// The part of the way over which a passage is judged.

#include "core/corrugation.hpp"
#include "core/scene.hpp"
#include "drivers/engine/station_plan.hpp"

namespace tread {

/// A corrugation, less half a wave at each end where more than one wave is left by that; the solution zone of
/// a smooth rail.
Span evaluated_stretch(const Scene& scene, const Corrugation& corrugation);

}  // namespace tread
