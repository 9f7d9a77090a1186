#pragma once
// Elastic stick under a limit of the shear stress, the same for every friction law. [theory.md, Friction]

#include "core/elementary.hpp"
#include "core/inline.hpp"

namespace tread {

/// Shear traction [Pa], slip [m] or slip speed [m/s] in the surface's frame, of a point or of a lane each.
template <class V>
struct TractionOf {
  V along{};
  V across{};
};
using Traction = TractionOf<double>;

/// Share of the limit from which on a point counts as slipping: a vibrating point sticks for single steps.
inline constexpr double kSlipping = 0.98;

/// Tangential spring of a point, which slides at the limit.
struct ElasticStick {
  double tangential_penalty;  ///< k_t [Pa/m]

  /// Traction at the end of a step [theory.md, eq. 10]. `slip` is the movement of the wheel's surface against
  /// the rail's in the step if the traction at its end were zero [m]; that traction takes `compliance` times
  /// itself from the slip [m/Pa]. `limit` is f p at the end of the step [Pa]; zero releases the traction.
  template <class V>
  TREAD_INLINE TractionOf<V> traction(const TractionOf<V>& before, const TractionOf<V>& slip, const V& limit,
                                      const V& compliance) const {
    const TractionOf<V> stuck = stick(before, slip, compliance);
    return shorten(stuck, length(stuck), limit);
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

 private:
  template <class V>
  TREAD_INLINE TractionOf<V> stick(const TractionOf<V>& before, const TractionOf<V>& slip,
                                   const V& compliance) const {
    const V scale = 1 / (1 + tangential_penalty * compliance);
    return {scale * (before.along + tangential_penalty * slip.along),
            scale * (before.across + tangential_penalty * slip.across)};
  }
  template <class V>
  TREAD_INLINE static V length(const TractionOf<V>& traction) {
    return square_root<V>(traction.along * traction.along + traction.across * traction.across);
  }
  /// Without a branch, so that lanes take it together.
  template <class V>
  TREAD_INLINE static TractionOf<V> shorten(const TractionOf<V>& traction, const V& size, const V& limit) {
    constexpr double kNothing = 1e-300;  // beside any stress but zero [Pa]
    const V all = V{} + 1;
    const V share = limit / (size + kNothing);
    const V kept = share < all ? share : all;
    return {kept * traction.along, kept * traction.across};
  }
};

}  // namespace tread
