#pragma once
// Coulomb's law with an elastic stick of tangential penalty stiffness. [theory.md, Friction]

#include <cmath>

namespace tread {

/// Shear traction on the rail surface in the two directions of the surface's frame [Pa].
struct Traction {
  double along = 0;
  double across = 0;
};

struct CoulombFriction {
  double friction_coefficient;  ///< f [-]
  double tangential_penalty;    ///< k_t [Pa/m]

  struct Result {
    Traction traction;  ///< at the end of the step [Pa]
    bool slips;
    double work;         ///< of the mid-step traction on the slip of the step [J/m2]
    double dissipation;  ///< the part of it that is not stored in the elastic stick [J/m2]
  };

  /// One step: `slip` is the movement of the wheel surface relative to the rail in this step [m], `pressure`
  /// the contact pressure at its end [Pa]; zero pressure releases the traction.
  Result advance(const Traction& before, const Traction& slip, double pressure) const {
    Traction after{before.along + tangential_penalty * slip.along,
                   before.across + tangential_penalty * slip.across};
    const double limit = friction_coefficient * pressure;
    const double size = std::sqrt(after.along * after.along + after.across * after.across);
    const bool slips = size > limit;
    if (slips) {
      const double scale = size > 0 ? limit / size : 0.0;
      after.along *= scale;
      after.across *= scale;
    }
    const double work =
        0.5 * ((before.along + after.along) * slip.along + (before.across + after.across) * slip.across);
    const double stored = 0.5 *
                          (after.along * after.along + after.across * after.across -
                           before.along * before.along - before.across * before.across) /
                          tangential_penalty;
    return {after, slips, work, work - stored};
  }
};

}  // namespace tread
