#pragma once
// Coulomb's law with an elastic stick of tangential penalty stiffness. [theory.md, Friction]

#include <cmath>

namespace tread {

/// Shear traction on the rail surface in the two directions of the surface's frame [Pa].
struct Traction {
  double along = 0;
  double across = 0;
};

/// Share of the limit from which on a point counts as slipping: what vibrates there sticks for single steps.
inline constexpr double kSlipping = 0.98;

struct CoulombFriction {
  double friction_coefficient;  ///< f [-]
  double tangential_penalty;    ///< k_t [Pa/m]

  struct Result {
    Traction traction;  ///< at the end of the step [Pa]
    bool slips;
  };

  /// Traction at the end of a step: `slip` is the movement of the wheel surface relative to the rail in this
  /// step if the traction at its end were zero, which that traction reduces by `compliance` times itself [m,
  /// m/Pa]; `pressure` is that at the end of the step; zero pressure releases the traction.
  Result advance(const Traction& before, const Traction& slip, double pressure, double compliance) const {
    const double scale = 1 / (1 + tangential_penalty * compliance);
    Traction after{scale * (before.along + tangential_penalty * slip.along),
                   scale * (before.across + tangential_penalty * slip.across)};
    const double limit = friction_coefficient * pressure;
    const double size = std::sqrt(after.along * after.along + after.across * after.across);
    if (size > limit) {
      const double share = limit / size;
      after.along *= share;
      after.across *= share;
    }
    return {after, size > 0 && size >= kSlipping * limit};
  }

  /// Work of the mid-step traction on the slip of a step less the change of what the elastic stick stores:
  /// the frictional work of the step [J/m2].
  double dissipation(const Traction& before, const Traction& after, const Traction& slip) const {
    const double work =
        0.5 * ((before.along + after.along) * slip.along + (before.across + after.across) * slip.across);
    return work - stored(after) + stored(before);
  }

  /// Energy in the elastic stick [J/m2].
  double stored(const Traction& traction) const {
    return 0.5 * (traction.along * traction.along + traction.across * traction.across) / tangential_penalty;
  }
};

}  // namespace tread
