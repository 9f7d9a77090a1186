#pragma once

#include "core/inline.hpp"

namespace tread {

/// Acceleration by a unit of force, 0 where nothing moves by itself: unused lanes, tied nodes [1/kg].
TREAD_INLINE double inverse_mass(double mass) {
  return mass > 0 ? 1 / mass : 0;
}

}  // namespace tread
