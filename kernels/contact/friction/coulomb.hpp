#pragma once
// One coefficient of friction for all places and speeds.

#include "kernels/contact/friction/sliding.hpp"

namespace tread {

/// Coulomb's law.
struct CoulombFriction {
  double friction_coefficient = 0;  ///< f [-]

  struct State {};

  template <class Keep>
  void keep_arrays(const Keep& /*keep*/) {}
  constexpr double advance(State&, const Sliding&) const { return friction_coefficient; }
};

}  // namespace tread
