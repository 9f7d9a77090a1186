#pragma once
// The motion of nodes over a step, written once: in the element loop when a node's force is complete, and
// afterwards for the remaining nodes. V is a floating-point type or a vector of lanes; U is one of as many
// values, at least as precise. Nothing here is contracted to fused multiply-adds, so that all instruction
// sets move a node by the same bits. [theory.md, Time step]

#include <cmath>
#include <type_traits>

#include "core/inline.hpp"

namespace tread {

/// The step and the actions on the nodes of a tile besides forces; TileMotion has them for all lanes.
template <class Real>
struct StepConstants {
  Real dt = 0;                  ///< time step [s]
  Real gravity = 0;             ///< gravity downwards, for extruded blocks [m/s2]
  Real turn_s = 0, turn_t = 0;  ///< sine, and tangent of half, of the Coriolis term's turn of the velocity
  Real spin2 = 0;               ///< square of the frame's spin [1/s2]
};

/// Product a b, rounded before anything is added to it. Compilers that contract across expressions need the
/// barrier: an empty instruction where one register holds the product, because GCC's own barrier takes
/// vectors of single precision apart.
template <class A, class B>
TREAD_INLINE auto product(const A& a, const B& b) {
#if defined(__CUDA_ARCH__)
  if constexpr (std::is_same_v<decltype(a * b), double>)
    return __dmul_rn(a, b);
  else
    return __fmul_rn(a, b);
#elif defined(__x86_64__) && !defined(__clang__) && !defined(__CUDACC__)
  auto value = a * b;
  asm("" : "+v"(value));
  return value;
#elif __has_builtin(__builtin_assoc_barrier) && !defined(__CUDACC__)
  return __builtin_assoc_barrier(a * b);
#else
  return a * b;
#endif
}

/// Value in another precision.
template <class To, class From>
TREAD_INLINE To converted(const From& value) {
  if constexpr (std::is_same_v<To, From>)
    return value;
  else if constexpr (std::is_arithmetic_v<To>)
    return static_cast<To>(value);
  else
    return __builtin_convertvector(value, To);
}

/// Computes v -= dt (f / m + g e_z) and u += dt v of the components from `first` on.
template <int first, class V, class U, class Real>
TREAD_INLINE void move_fixed(const StepConstants<Real>& step, const V& inverse_mass, const V (&f)[3],
                             U (&u)[3], V (&v)[3]) {
  for (int c = first; c < 3; ++c) {
    const V weight = V{} + (c == 2 ? step.gravity : Real{0});
    v[c] -= product(step.dt, product(inverse_mass, f[c]) + (inverse_mass > 0 ? weight : V{}));
    u[c] += converted<U>(product(step.dt, v[c]));
  }
}

/// Gravity at a station of a revolved block [m/s2].
struct GravityInSweep {
  double along;     ///< the tangent t
  double outwards;  ///< along r
};

/// `angle`: of the station in space [rad].
template <class Real>
TREAD_INLINE GravityInSweep gravity_in_sweep(Real gravity, Real angle) {
  return {-gravity * std::sin(angle), gravity * std::cos(angle)};
}

/// Computes the motion in a spinning frame: forces, gravity and centrifugal term act half before and half
/// after the turn of the relative velocity by the Coriolis term, which does no work: three shears, because a
/// rounded cosine next to 1 would let every velocity grow. `weight`: gravity along t and r, and the
/// centrifugal term of a place along t [m/s2]; `radius`: place along r, a number or one by lane [m].
template <class V, class U, class Real, class Radius>
TREAD_INLINE void move_spinning(const StepConstants<Real>& step, const V (&weight)[2], const Radius& radius,
                                const V& inverse_mass, const V (&f)[3], U (&u)[3], V (&w)[3]) {
  const V one = V{} + Real{1};
  const V moves = inverse_mass > 0 ? one : V{};
  const Real half = Real(0.5) * step.dt;
  const V u_t = converted<V>(u[0]);
  const V u_r = converted<V>(u[2]);
  const V a_t = product(moves, weight[0] + product(step.spin2, u_t)) - product(inverse_mass, f[0]);
  const V a_r = product(moves, weight[1] + product(step.spin2, radius + u_r)) - product(inverse_mass, f[2]);
  const V kick_t = product(half, a_t);
  const V kick_r = product(half, a_r);
  const V w_r = w[2] + kick_r;
  const V w_t = w[0] + kick_t - product(step.turn_t, w_r);
  const V turned_r = w_r + product(step.turn_s, w_t);
  w[0] = w_t - product(step.turn_t, turned_r) + kick_t;
  w[2] = turned_r + kick_r;
  w[1] -= product(product(step.dt, inverse_mass), f[1]);
  for (int c = 0; c < 3; ++c) u[c] += converted<U>(product(step.dt, w[c]));
}

}  // namespace tread
