#pragma once
// Elastic stick under a limit of the shear stress, the same for every friction law. [theory.md, Friction]

#include "core/elementary.hpp"

namespace tread {

/// Shear traction [Pa], slip [m] or slip speed [m/s] in the surface's frame.
struct Traction {
  double along = 0;
  double across = 0;
};

/// Share of the limit from which on a point counts as slipping: a vibrating point sticks for single steps.
inline constexpr double kSlipping = 0.98;

/// Tangential spring of a point, which slides at the limit.
struct ElasticStick {
  double tangential_penalty;  ///< k_t [Pa/m]

  struct Result {
    Traction traction;  ///< at the end of the step [Pa]
    bool slips;
  };

  /// Traction at the end of a step [theory.md, eq. 10]. `slip` is the movement of the wheel's surface against
  /// the rail's in the step if the traction at its end were zero [m]; that traction takes `compliance` times
  /// itself from the slip [m/Pa]. `limit` is f p at the end of the step [Pa]; zero releases the traction.
  constexpr Result advance(const Traction& before, const Traction& slip, double limit,
                           double compliance) const {
    const double scale = 1 / (1 + tangential_penalty * compliance);
    Traction after{scale * (before.along + tangential_penalty * slip.along),
                   scale * (before.across + tangential_penalty * slip.across)};
    const double size = square_root(after.along * after.along + after.across * after.across);
    if (size > limit) {
      const double share = limit / size;
      after.along *= share;
      after.across *= share;
    }
    return {after, size > 0 && size >= kSlipping * limit};
  }

  /// Frictional work of a step [J/m2]: work of the mid-step traction on the slip less the change of the
  /// stored energy.
  constexpr double dissipation(const Traction& before, const Traction& after, const Traction& slip) const {
    const double work =
        0.5 * ((before.along + after.along) * slip.along + (before.across + after.across) * slip.across);
    return work - stored(after) + stored(before);
  }

  /// Energy in the elastic stick [J/m2].
  constexpr double stored(const Traction& traction) const {
    return 0.5 * (traction.along * traction.along + traction.across * traction.across) / tangential_penalty;
  }
};

}  // namespace tread
