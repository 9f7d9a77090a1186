#pragma once
// An element whose law is not linear: its stress is the law's, damping and hourglass stiffness are those of
// the linear law. [theory.md, Material laws]

#include "kernels/element/element_body.hpp"

namespace tread {

/// A law and the volume of the elements that have it.
template <class Law, class Real>
struct ElementLaw {
  Law law;
  Real volume;  ///< of the swept shape [m3]
};

/// Rate of point_strain at the displacement gradient g, by the rate r of the gradient.
template <bool finite_rotation, class V>
TREAD_INLINE void point_strain_rate(const V (&g)[3][3], const V (&r)[3][3], V (&e)[6]) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    e[i] = r[i][i];
    e[3 + i] = r[j][k] + r[k][j];
    if constexpr (finite_rotation)
      for (int m = 0; m < 3; ++m) {
        e[i] += g[m][i] * r[m][i];
        e[3 + i] += g[m][j] * r[m][k] + r[m][j] * g[m][k];
      }
  }
}

/// Forces of an element conjugate to its strain; `rate`: what adds to the strain for damping, beta times the
/// rate or strength times the lag; null: nothing. Advances the state.
template <bool finite_rotation, class Law, class Element, class V, class Real>
TREAD_INLINE void law_forces(const SweptConstants<Real>& c, const ElementLaw<Law, Real>& at,
                             const Element& element, const Strain<V>& e, const Strain<V>* rate,
                             typename Law::template State<V>& state, Strain<V>& f) {
  V strain[6];
  V stress[6];
  point_strain<finite_rotation, Real>(e.g, strain);
  at.law.stress(strain, state, stress);
  for (V& value : stress) value *= at.volume;
  Strain<V> shape = e;
  if (rate != nullptr) {
    V added[6];
    point_strain_rate<finite_rotation>(e.g, rate->g, strain);
    LinearElastic<Real>{c.lambda, c.mu}.stress(strain, added);
    for (int i = 0; i < 6; ++i) stress[i] += added[i];
    for (int i = 0; i < 3; ++i)
      for (int m = 0; m < kHourglassModes; ++m) shape.q[i][m] += rate->q[i][m];
  }
  gradient_forces<finite_rotation>(e.g, stress, f.g);
  hourglass_forces(c.hourglass, shape, f);
  element.template scale_by_volume<0>(f);
}

/// Energies by a law.
template <class V>
struct LawEnergy {
  V stored, dissipated;
};

/// Energies of an element in the state that the strain leads to from `state`.
template <bool finite_rotation, class Law, class Element, class V, class Real>
TREAD_INLINE LawEnergy<V> law_energy(const ElementLaw<Law, Real>& at, const Element& element,
                                     const Strain<V>& e, typename Law::template State<V> state) {
  V strain[6];
  V stress[6];
  point_strain<finite_rotation, Real>(e.g, strain);
  at.law.stress(strain, state, stress);
  return {element.energy_in_volume(at.volume * at.law.energy(strain, state)),
          element.energy_in_volume(at.volume * at.law.dissipated(state))};
}

}  // namespace tread
