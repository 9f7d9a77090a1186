#pragma once
// The element's arithmetic, once: on scalars (tests, one index) and on vectors of lanes. V is a
// floating-point type or a vector of them; everything is inlined into its caller and so takes that caller's
// instruction set.
//
// A quad's eight nodal values enter as s_j = left + right and d_j = right - left at its four corners j, which
// is the first stage on the way to the amplitudes of KernelMode.

#include "core/inline.hpp"
#include "kernels/element/element.hpp"
#include "kernels/material/linear_elastic.hpp"

namespace tread {

/// Displacement gradient g[i][j] and hourglass amplitudes q[i][alpha] of an element, or the generalised
/// forces conjugate to them.
template <class V>
struct Strain {
  V g[3][3];
  V q[3][kHourglassModes];
};

/// Amplitudes that the differences of both ends have, by KernelMode.
template <class V>
TREAD_INLINE void to_modes_along(const V (&d)[4], V (&a)[kModes]) {
  a[kernel_d02] = d[2] - d[0];
  a[kernel_d13] = d[3] - d[1];
  const V d02 = d[0] + d[2];
  const V d13 = d[1] + d[3];
  a[kernel_xi] = d02 + d13;
  a[kernel_h4] = d02 - d13;
}

/// Amplitudes of one component, by KernelMode.
template <class V>
TREAD_INLINE void to_modes(const V (&s)[4], const V (&d)[4], V (&a)[kModes]) {
  a[kernel_s02] = s[2] - s[0];
  a[kernel_s13] = s[3] - s[1];
  a[kernel_h1] = (s[0] - s[1]) + (s[2] - s[3]);
  to_modes_along(d, a);
}

/// Transpose of to_modes_along.
template <class V>
TREAD_INLINE void from_modes_along(const V (&a)[kModes], V (&d)[4]) {
  const V d02 = a[kernel_xi] + a[kernel_h4];
  const V d13 = a[kernel_xi] - a[kernel_h4];
  d[0] = d02 - a[kernel_d02];
  d[1] = d13 - a[kernel_d13];
  d[2] = d02 + a[kernel_d02];
  d[3] = d13 + a[kernel_d13];
}

/// Transpose of to_modes.
template <class V>
TREAD_INLINE void from_modes(const V (&a)[kModes], V (&s)[4], V (&d)[4]) {
  s[0] = a[kernel_h1] - a[kernel_s02];
  s[1] = -(a[kernel_h1] + a[kernel_s13]);
  s[2] = a[kernel_h1] + a[kernel_s02];
  s[3] = a[kernel_s13] - a[kernel_h1];
  from_modes_along(a, d);
}

/// Strains of the elements of one (quad, pitch class): the shape is symmetric about xi = 0. In extruded
/// elements the distortion stays in the section.
template <Sweep sweep, class Real>
struct SweptElement {
  const SweptConstants<Real>& c;

  /// Strain by component i of a field with the sums s and the differences d.
  template <class V>
  TREAD_INLINE void strain(int i, const V (&s)[4], const V (&d)[4], Strain<V>& e) const {
    V a[kModes];
    to_modes_along(d, a);
    const V s02 = s[2] - s[0];
    const V s13 = s[3] - s[1];
    const V gap = (s[0] - s[1]) + c.crossing[0] * s02 - c.crossing[1] * s13;
    const V x =
        c.gradient_x[0] * a[kernel_xi] + c.gradient_x[1] * a[kernel_d02] + c.gradient_x[2] * a[kernel_d13];
    V y = c.gradient_y[0] * s02 + c.gradient_y[1] * s13;
    V z = c.gradient_z[0] * s02 + c.gradient_z[1] * s13;
    if constexpr (sweep == Sweep::revolved) {
      y += c.gradient_y[2] * gap;
      z += c.gradient_z[2] * gap;
    }
    e.g[i][0] = x;
    e.g[i][1] = y;
    e.g[i][2] = z;
    e.q[i][0] = gap;
    for (int m = 1; m < kHourglassModes; ++m) {
      e.q[i][m] = a[kernel_h1 + m];
      if constexpr (sweep == Sweep::revolved) e.q[i][m] -= c.position_x[m] * x;
    }
  }

  /// Transpose of `strain`.
  template <class V>
  TREAD_INLINE void forces(int i, const Strain<V>& f, V (&s)[4], V (&d)[4]) const {
    V x = f.g[i][0];
    const V y = f.g[i][1];
    const V z = f.g[i][2];
    V gap = f.q[i][0];
    if constexpr (sweep == Sweep::revolved) {
      x -= c.position_x[1] * f.q[i][1] + c.position_x[2] * f.q[i][2] + c.position_x[3] * f.q[i][3];
      gap += c.gradient_y[2] * y + c.gradient_z[2] * z;
    }
    s[2] = c.gradient_y[0] * y + c.gradient_z[0] * z + c.crossing[0] * gap;
    s[3] = c.gradient_y[1] * y + c.gradient_z[1] * z - c.crossing[1] * gap;
    s[0] = gap - s[2];
    s[1] = -(gap + s[3]);
    V a[kModes];
    a[kernel_xi] = c.gradient_x[0] * x;
    a[kernel_d02] = f.q[i][1] + c.gradient_x[1] * x;
    a[kernel_d13] = f.q[i][2] + c.gradient_x[2] * x;
    a[kernel_h4] = f.q[i][3];
    from_modes_along(a, d);
  }

  template <int first>
  TREAD_INLINE void scale_by_volume(auto& /*f*/) const {}

  /// Energy in the element's volume from that in the swept volume.
  template <class V>
  TREAD_INLINE V energy_in_volume(const V& work) const {
    return work;
  }
};

/// a x b + c x d of rows of vectors.
template <class V>
TREAD_INLINE void add_products(const V (&a)[3], const V (&b)[3], const V (&c)[3], const V (&d)[3],
                               V (&sum)[3]) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    sum[i] = a[j] * b[k] - a[k] * b[j] + c[j] * d[k] - c[k] * d[j];
  }
}

/// Strains of elements that touch moved nodes, each lane with positions of its own: those of the swept shape
/// and what the shifts of its nodes add, shift[component][mode]. [m]
/// Gradients are formed here, as in element_geometry: reading them would cost more time than these products.
/// The hourglass matrix and the material are those of the swept shape.
template <class V, class Real>
struct PerturbedElement {
  V position[kModes][3];
  V gradient[kGradientModes][3];
  V volume_ratio;  ///< by the volume of the swept shape
  Real gap_by_h1;

  TREAD_INLINE PerturbedElement(const SweptConstants<Real>& swept, const V (&shift)[3][kModes])
      : gap_by_h1(swept.gap_by_h1) {
    for (int m = 0; m < kModes; ++m)
      for (int j = 0; j < 3; ++j) position[m][j] = shift[j][m];
    constexpr int kAcross[3] = {kernel_s02, kernel_s13, kernel_h1};
    for (int m = 0; m < 3; ++m) {
      position[kAcross[m]][1] += swept.position_y[m];
      position[kAcross[m]][2] += swept.position_z[m];
    }
    constexpr int kAlong[4] = {kernel_xi, kernel_d02, kernel_d13, kernel_h4};
    for (int m = 0; m < 4; ++m) position[kAlong[m]][0] += swept.position_x[m];
    // In these modes the triple products of element_geometry are half as large.
    V thirds[3][3];
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j) thirds[k][j] = Real(1) / 3 * position[kernel_h1 + k][j];
    const auto &xi = position[kernel_xi], &s02 = position[kernel_s02], &s13 = position[kernel_s13];
    const auto &d02 = position[kernel_d02], &d13 = position[kernel_d13];
    const auto &h1_3 = thirds[0], &d02_3 = thirds[1], &d13_3 = thirds[2];
    add_products(s02, s13, d02, d13_3, gradient[kernel_xi]);
    add_products(s13, xi, d13, h1_3, gradient[kernel_s02]);
    add_products(xi, s02, d02, h1_3, gradient[kernel_s13]);
    add_products(s13, d02_3, s02, d13_3, gradient[kernel_h1]);
    add_products(d13_3, xi, h1_3, s13, gradient[kernel_d02]);
    add_products(xi, d02_3, h1_3, s02, gradient[kernel_d13]);
    V triple = xi[0] * gradient[kernel_xi][0] + position[kernel_h1][0] * gradient[kernel_h1][0];
    for (int j = 1; j < 3; ++j)
      triple += xi[j] * gradient[kernel_xi][j] + position[kernel_h1][j] * gradient[kernel_h1][j];
    volume_ratio = triple * (swept.inverse_volume / 32);
    const V inverse = 1 / triple;
    for (auto& mode : gradient)
      for (V& value : mode) value *= inverse;
  }

  TREAD_INLINE void strain(int i, const V (&s)[4], const V (&d)[4], Strain<V>& e) const {
    V a[kModes];
    to_modes(s, d, a);
    for (int j = 0; j < 3; ++j) {
      V sum = gradient[0][j] * a[0];
      for (int m = 1; m < kGradientModes; ++m) sum += gradient[m][j] * a[m];
      e.g[i][j] = sum;
    }
    for (int m = 0; m < kHourglassModes; ++m) {
      const V(&x)[3] = position[kernel_h1 + m];
      e.q[i][m] = a[kernel_h1 + m] - x[0] * e.g[i][0] - x[1] * e.g[i][1] - x[2] * e.g[i][2];
    }
    e.q[i][0] *= gap_by_h1;
  }

  TREAD_INLINE void forces(int i, const Strain<V>& f, V (&s)[4], V (&d)[4]) const {
    const V q[kHourglassModes] = {gap_by_h1 * f.q[i][0], f.q[i][1], f.q[i][2], f.q[i][3]};
    V t[3];
    for (int j = 0; j < 3; ++j) {
      t[j] = f.g[i][j];
      for (int m = 0; m < kHourglassModes; ++m) t[j] -= position[kernel_h1 + m][j] * q[m];
    }
    V a[kModes];
    for (int m = 0; m < kModes; ++m) {
      a[m] = m < kernel_h1 ? V{} : q[m < kernel_h1 ? 0 : m - kernel_h1];
      if (m < kGradientModes) a[m] += gradient[m][0] * t[0] + gradient[m][1] * t[1] + gradient[m][2] * t[2];
    }
    from_modes(a, s, d);
  }

  /// The material constants hold the swept volume; the hourglass stiffness stays that of the swept shape.
  /// Components from `first` on.
  template <int first>
  TREAD_INLINE void scale_by_volume(Strain<V>& f) const {
    for (int i = first; i < 3; ++i)
      for (int j = 0; j < 3; ++j) f.g[i][j] *= volume_ratio;
  }

  TREAD_INLINE V energy_in_volume(const V& work) const { return work * volume_ratio; }
};

/// Strain (xx, yy, zz, 2yz, 2zx, 2xy) of a displacement gradient: its symmetric part, or Green-Lagrange's.
template <bool finite_rotation, class Real, class V>
TREAD_INLINE void point_strain(const V (&g)[3][3], V (&e)[6]) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    e[i] = g[i][i];
    e[3 + i] = g[j][k] + g[k][j];
    if constexpr (finite_rotation) {
      e[i] += Real(0.5) * (g[0][i] * g[0][i] + g[1][i] * g[1][i] + g[2][i] * g[2][i]);
      e[3 + i] += g[0][j] * g[0][k] + g[1][j] * g[1][k] + g[2][j] * g[2][k];
    }
  }
}

/// Forces conjugate to the displacement gradient: the stress s, or (1 + g) s.
template <bool finite_rotation, class V>
TREAD_INLINE void gradient_forces(const V (&g)[3][3], const V (&s)[6], V (&p)[3][3]) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    p[i][i] = s[i];
    p[j][k] = p[k][j] = s[3 + i];
  }
  if constexpr (finite_rotation)
    for (int i = 0; i < 3; ++i) {
      p[i][0] += g[i][0] * s[0] + g[i][1] * s[5] + g[i][2] * s[4];
      p[i][1] += g[i][0] * s[5] + g[i][1] * s[1] + g[i][2] * s[3];
      p[i][2] += g[i][0] * s[4] + g[i][1] * s[3] + g[i][2] * s[2];
    }
}

/// Forces of the linear law's one-point stress in a swept element's volume. [theory.md, eqs. 2 and 5]
template <bool finite_rotation, class V, class Real>
TREAD_INLINE void stress_forces(const SweptConstants<Real>& c, const Strain<V>& e, Strain<V>& f) {
  V strain[6];
  V stress[6];
  point_strain<finite_rotation, Real>(e.g, strain);
  LinearElastic<Real>{c.lambda, c.mu}.stress(strain, stress);
  gradient_forces<finite_rotation>(e.g, stress, f.g);
}

template <class V, class Real>
TREAD_INLINE void hourglass_forces(const HourglassConstants<Real>& c, const Strain<V>& e, Strain<V>& f) {
  const V &x2 = e.q[0][1], &x3 = e.q[0][2], &y1 = e.q[1][0], &z1 = e.q[2][0];
  f.q[0][1] = c.even_diagonal[0] * x2 + c.x2_x3 * x3 + c.x2_y1 * y1 + c.x2_z1 * z1;
  f.q[0][2] = c.even_diagonal[1] * x3 + c.x2_x3 * x2 + c.x3_y1 * y1 + c.x3_z1 * z1;
  f.q[1][0] = c.even_diagonal[2] * y1 + c.x2_y1 * x2 + c.x3_y1 * x3 + c.y1_z1 * z1;
  f.q[2][0] = c.even_diagonal[3] * z1 + c.x2_z1 * x2 + c.x3_z1 * x3 + c.y1_z1 * y1;
  f.q[0][3] = c.x4 * e.q[0][3];
  f.q[1][3] = c.y4 * e.q[1][3] + c.y4_z4 * e.q[2][3];
  f.q[2][3] = c.z4 * e.q[2][3] + c.y4_z4 * e.q[1][3];

  const V &x1 = e.q[0][0], &y2 = e.q[1][1], &z2 = e.q[2][1], &y3 = e.q[1][2], &z3 = e.q[2][2];
  const Real* d = c.odd_diagonal;
  const Real* u = c.odd_upper;
  f.q[0][0] = d[0] * x1 + u[0] * y2 + u[1] * z2 + u[2] * y3 + u[3] * z3;
  f.q[1][1] = d[1] * y2 + u[0] * x1 + u[4] * z2 + u[5] * y3 + u[6] * z3;
  f.q[2][1] = d[2] * z2 + u[1] * x1 + u[4] * y2 + u[7] * y3 + u[8] * z3;
  f.q[1][2] = d[3] * y3 + u[2] * x1 + u[5] * y2 + u[7] * z2 + u[9] * z3;
  f.q[2][2] = d[4] * z3 + u[3] * x1 + u[6] * y2 + u[8] * z2 + u[9] * y3;
}

/// Calls take(work) with twice the energies of the hourglass stiffness, by amplitude.
template <class V, class Real, class Take>
TREAD_INLINE void hourglass_works(const HourglassConstants<Real>& c, const Strain<V>& e, const Take& take) {
  Strain<V> force;
  hourglass_forces(c, e, force);
  for (int i = 0; i < 3; ++i)
    for (int m = 0; m < kHourglassModes; ++m) take(e.q[i][m] * force.q[i][m]);
}

/// Energy of the linear law's one-point stress.
template <bool finite_rotation, class Element, class V, class Real>
TREAD_INLINE V linear_energy(const SweptConstants<Real>& c, const Element& element, const Strain<V>& e) {
  V strain[6];
  point_strain<finite_rotation, Real>(e.g, strain);
  return element.energy_in_volume(LinearElastic<Real>{c.lambda, c.mu}.energy(strain, {}));
}

/// stress_forces and hourglass_forces where component 2 alone moves and linearly: rows 0 and 1 are neither
/// read nor written.
template <class V, class Real>
TREAD_INLINE void vertical_forces(const SweptConstants<Real>& c, const Strain<V>& e, Strain<V>& f) {
  f.g[2][0] = c.mu * e.g[2][0];
  f.g[2][1] = c.mu * e.g[2][1];
  f.g[2][2] = c.lambda * e.g[2][2] + (c.mu + c.mu) * e.g[2][2];
  const HourglassConstants<Real>& h = c.hourglass;
  const V &z1 = e.q[2][0], &z2 = e.q[2][1], &z3 = e.q[2][2];
  f.q[2][0] = h.even_diagonal[3] * z1;
  f.q[2][1] = h.odd_upper[8] * z3 + h.odd_diagonal[2] * z2;
  f.q[2][2] = h.odd_upper[8] * z2 + h.odd_diagonal[4] * z3;
  f.q[2][3] = h.z4 * e.q[2][3];
}

/// Forces of an element of the linear law, conjugate to its strain. Components before `first`, 0 or 2, do not
/// move.
template <bool finite_rotation, int first = 0, class Element, class V, class Real>
TREAD_INLINE void strain_forces(const SweptConstants<Real>& c, const Element& element, const Strain<V>& e,
                                Strain<V>& f) {
  if constexpr (first == 2) {
    vertical_forces(c, e, f);
  } else {
    stress_forces<finite_rotation>(c, e, f);
    hourglass_forces(c.hourglass, e, f);
  }
  element.template scale_by_volume<first>(f);
}

/// Rotation between the sum and difference a, b of a node's values at the two ends of an element, in the
/// nodes' own bases, and the same (s, d) in the basis of the middle angle; c, w: cosine and sine of half the
/// pitch. Component 0 is t, 2 is r; y does not turn.
template <class V, class Real>
TREAD_INLINE void turn_to_middle(Real c, Real w, V (&s)[3], V (&d)[3]) {
  const V s_t = c * s[0] + w * d[2];
  const V s_r = c * s[2] - w * d[0];
  const V d_t = c * d[0] + w * s[2];
  const V d_r = c * d[2] - w * s[0];
  s[0] = s_t;
  s[2] = s_r;
  d[0] = d_t;
  d[2] = d_r;
}

/// Takes a vector from the basis at an element's near end into that at its far end.
template <class V>
TREAD_INLINE void turn_to_far_end(V c, V w, V (&v)[3]) {
  for (int half = 0; half < 2; ++half) {
    const V t = c * v[0] - w * v[2];
    v[2] = c * v[2] + w * v[0];
    v[0] = t;
  }
}

/// Transpose of turn_to_middle.
template <class V, class Real>
TREAD_INLINE void turn_to_nodes(Real c, Real w, V (&s)[3], V (&d)[3]) {
  const V s_t = c * s[0] - w * d[2];
  const V s_r = c * s[2] + w * d[0];
  const V d_t = c * d[0] - w * s[2];
  const V d_r = c * d[2] + w * s[0];
  s[0] = s_t;
  s[2] = s_r;
  d[0] = d_t;
  d[2] = d_r;
}

}  // namespace tread
