#pragma once
// The arguments of a friction law.

#include "kernels/contact/friction/elastic_stick.hpp"

namespace tread {

/// Motion and place of a point over a step.
struct Sliding {
  Traction velocity;  ///< slip speed of the wheel against the rail [m/s]
  double x = 0;       ///< along the rail [m]
  double y = 0;       ///< across the rail [m]
  double dt = 0;      ///< length of the step [s]

  constexpr double speed() const {
    return square_root(velocity.along * velocity.along + velocity.across * velocity.across);
  }
};

}  // namespace tread
