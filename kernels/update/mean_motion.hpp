#pragma once
// Mean motion of a spinning body. [theory.md, Body frames]

#include "core/math/vec.hpp"

namespace tread {

/// Mass-weighted mean motion of a body relative to its frame, Cartesian.
struct MeanMotion {
  Vec3 displacement;    ///< displacement of the mass centre [m]
  Vec3 velocity;        ///< velocity relative to the frame [m/s]
  double rotation = 0;  ///< rotation about +y [rad]
  double spin = 0;      ///< spin about +y, relative to the frame's [rad/s]
};

}  // namespace tread
