#pragma once
// Small-strain plasticity of von Mises with linear isotropic and linear kinematic hardening. [theory.md,
// Plasticity; Simo and Hughes 1998, box 3.1]

#include "core/elementary.hpp"
#include "core/inline.hpp"
#include "core/material.hpp"

namespace tread {

/// Radial return of the full tensor; plastic strain does not change the volume. Yield: the equivalent of the
/// deviator less the backstress exceeds yield_stress + isotropic_hardening times the equivalent plastic
/// strain. The backstress is 2/3 kinematic_hardening times the plastic strain (Prager).
template <class Real>
struct J2Plasticity {
  static constexpr const char* kName = "j2";
  static constexpr bool kLinear = false;

  Real bulk_modulus, shear_modulus;  ///< [Pa]
  Real yield_stress;                 ///< in uniaxial tension [Pa]
  Real isotropic_hardening;          ///< slope of the yield stress over the equivalent plastic strain [Pa]
  Real kinematic_hardening;          ///< slope of the uniaxial backstress over the plastic strain [Pa]

  static const char* refusal(const Material& material) {
    if (!(material.yield_stress > 0)) return "yield_stress must be above 0 Pa";
    const bool softens = material.isotropic_hardening < 0 || material.kinematic_hardening < 0;
    return softens ? "hardening must be at least 0 Pa; softening has no solution that a finer mesh keeps"
                   : nullptr;
  }
  static J2Plasticity of(const Material& material) {
    const auto real = [](double value) { return static_cast<Real>(value); };
    return {real(material.bulk_modulus()), real(material.shear_modulus()), real(material.yield_stress),
            real(material.isotropic_hardening), real(material.kinematic_hardening)};
  }

  template <class V>
  struct State {
    V plastic_strain[6];  ///< (xx, yy, zz, 2yz, 2zx, 2xy) [-]
    V equivalent;         ///< equivalent plastic strain, never decreases [-]
  };

  /// Deviator of the stress of a strain less the plastic one [Pa].
  template <class V>
  TREAD_INLINE void deviator(const V (&e)[6], const State<V>& state, V (&s)[6]) const {
    const V third = Real(1) / 3 * (e[0] + e[1] + e[2]);
    for (int i = 0; i < 3; ++i) {
      s[i] = (shear_modulus + shear_modulus) * (e[i] - third - state.plastic_strain[i]);
      s[3 + i] = shear_modulus * (e[3 + i] - state.plastic_strain[3 + i]);
    }
  }

  /// Stress [Pa] of a strain; advances the state.
  template <class V>
  TREAD_INLINE void stress(const V (&e)[6], State<V>& state, V (&s)[6]) const {
    deviator(e, state, s);
    const Real back = Real(2) / 3 * kinematic_hardening;
    V beyond[6];  // the backstress
    V square{};
    for (int i = 0; i < 3; ++i) {
      beyond[i] = s[i] - back * state.plastic_strain[i];
      beyond[3 + i] = s[3 + i] - Real(0.5) * back * state.plastic_strain[3 + i];
      square += Real(1.5) * (beyond[i] * beyond[i]) + Real(3) * (beyond[3 + i] * beyond[3 + i]);
    }
    const V equivalent = square_root(square);
    const V allowed = yield_stress + isotropic_hardening * state.equivalent;
    const V excess = equivalent > allowed ? equivalent - allowed : V{};
    const V increment =
        excess *
        (1 / (3 * shear_modulus + isotropic_hardening + kinematic_hardening));  // equivalent plastic strain
    const V direction = Real(1.5) * increment / (equivalent > allowed ? equivalent : allowed);
    const V pressure = bulk_modulus * (e[0] + e[1] + e[2]);
    for (int i = 0; i < 3; ++i) {
      const V normal = direction * beyond[i];
      const V shear = direction * beyond[3 + i];
      state.plastic_strain[i] += normal;
      state.plastic_strain[3 + i] += shear + shear;
      s[i] += pressure - (shear_modulus + shear_modulus) * normal;
      s[3 + i] -= (shear_modulus + shear_modulus) * shear;
    }
    state.equivalent += increment;
  }

  /// Elastic energy and what hardening stores [J/m3].
  template <class V>
  TREAD_INLINE V energy(const V (&e)[6], const State<V>& state) const {
    V s[6];
    deviator(e, state, s);
    const V volume = e[0] + e[1] + e[2];
    const V(&p)[6] = state.plastic_strain;
    V twice = bulk_modulus * volume * volume + isotropic_hardening * state.equivalent * state.equivalent;
    V back{};
    for (int i = 0; i < 3; ++i) {
      const V third = Real(1) / 3 * volume;
      twice += s[i] * (e[i] - third - p[i]) + s[3 + i] * (e[3 + i] - p[3 + i]);
      back += p[i] * p[i] + Real(0.5) * (p[3 + i] * p[3 + i]);
    }
    return Real(0.5) * (twice + Real(2) / 3 * kinematic_hardening * back);
  }

  /// Plastic work less what hardening stores: the initial yield stress times the equivalent plastic strain
  /// [J/m3].
  template <class V>
  TREAD_INLINE V dissipated(const State<V>& state) const {
    return yield_stress * state.equivalent;
  }
};

}  // namespace tread
