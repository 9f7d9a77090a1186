#pragma once
// Coefficient of friction that falls with the slip speed and follows it over a sliding length.

#include "kernels/contact/friction/sliding.hpp"

namespace tread {

/// Steady friction f(v) = f_inf + (f_0 - f_inf) exp(-v / v_c) [Polach 2005, with v_c = 1 / B], approached
/// over the memory length L: df/ds = (f(v) - f) / L along the slid way s. [theory.md, eqs. 10b and 10c]
struct FallingFriction {
  double friction_coefficient = 0;  ///< f_0 without slip [-]
  double fast_coefficient = 0;      ///< f_inf of fast slip [-]
  double decay_speed = 1;           ///< v_c, above zero [m/s]
  double memory_length = 1;         ///< L, above zero [m]

  struct State {
    double fall = 0;  ///< f_0 - f [-]
  };

  template <class Keep>
  void keep_arrays(const Keep& /*keep*/) {}

  /// f of steady slip at this speed [m/s].
  constexpr double steady(double speed) const { return friction_coefficient - fall(speed); }

  /// Exact for a slip speed that is constant over the step, so that f stays between its limits for any step.
  constexpr double advance(State& state, const Sliding& sliding) const {
    const double speed = sliding.speed();
    const double forgotten = 1 - exponential(-speed * sliding.dt / memory_length);
    state.fall += forgotten * (fall(speed) - state.fall);
    return friction_coefficient - state.fall;
  }

 private:
  constexpr double fall(double speed) const {
    return (friction_coefficient - fast_coefficient) * (1 - exponential(-speed / decay_speed));
  }
};

}  // namespace tread
