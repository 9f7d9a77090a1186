#pragma once
// The half wheelset alone, free but for the symmetry plane of its axle.

#include "core/scene.hpp"

namespace tread {

/// The library's half wheelset with elements of this size at the tread [m], at rest, without gravity and
/// without damping; `duration`: simulated time, 0: none [s].
Scene free_wheelset(double element_size, double duration = 0);

}  // namespace tread
