#pragma once
// One coefficient of friction for all places and speeds.

#include "kernels/contact/friction/sliding.hpp"

namespace tread {

/// Coulomb's law.
struct CoulombFriction {
  double friction_coefficient = 0;  ///< f [-]

  struct State {};
  static constexpr bool kUniform = true;

  constexpr bool frictionless() const { return friction_coefficient == 0; }
  constexpr double advance(State&, const Sliding&) const { return friction_coefficient; }
};

}  // namespace tread
