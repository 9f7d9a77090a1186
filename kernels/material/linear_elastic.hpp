#pragma once
// Linear isotropic elasticity. [theory.md, eq. 2]

#include "core/inline.hpp"
#include "core/material.hpp"

namespace tread {

/// Hooke's law. Constants may be those times the volume; stresses then are forces times lengths.
template <class Real>
struct LinearElastic {
  static constexpr const char* kName = "elastic";
  static constexpr bool kLinear = true;

  Real lambda, mu;  ///< Lame's constants [Pa]

  static const char* refusal(const Material& /*material*/) { return nullptr; }
  static LinearElastic of(const Material& material) {
    return {static_cast<Real>(material.lame_lambda()), static_cast<Real>(material.shear_modulus())};
  }

  /// Nothing: the strain determines the stress.
  template <class V>
  struct State {};

  /// Stress (xx, yy, zz, yz, zx, xy) [Pa] of a strain (xx, yy, zz, 2yz, 2zx, 2xy).
  template <class V>
  TREAD_INLINE void stress(const V (&e)[6], V (&s)[6]) const {
    const V pressure = lambda * (e[0] + e[1] + e[2]);
    for (int i = 0; i < 3; ++i) {
      s[i] = pressure + (mu + mu) * e[i];
      s[3 + i] = mu * e[3 + i];
    }
  }
  template <class V>
  TREAD_INLINE void stress(const V (&e)[6], State<V>& /*state*/, V (&s)[6]) const {
    stress(e, s);
  }

  /// Strain energy density [J/m3].
  template <class V>
  TREAD_INLINE V energy(const V (&e)[6], const State<V>& /*state*/) const {
    V s[6];
    stress(e, s);
    V work = e[0] * s[0];
    for (int i = 1; i < 6; ++i) work += e[i] * s[i];
    return Real(0.5) * work;
  }

  /// Dissipated so far [J/m3].
  template <class V>
  TREAD_INLINE V dissipated(const State<V>& /*state*/) const {
    return V{};
  }
};

}  // namespace tread
