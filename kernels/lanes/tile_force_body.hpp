#pragma once
// Included by one source per instruction set; internal linkage keeps the versions apart.

#include <cstddef>

#include "kernels/lanes/patch_loop_body.hpp"
#include "kernels/lanes/tie_sum_body.hpp"
#include "kernels/lanes/tile_force.hpp"
#include "kernels/lanes/tile_loop.hpp"

namespace tread {
namespace {

template <class Real, class U, Sweep sweep, bool damped, bool finite_rotation, int first = 0>
void tile_force(const TileElements<Real>& elements, const TileView<Real, U>& view, Real* front) {
  TileLoop<Real, U, sweep, damped, finite_rotation, first>(elements, view, front).run();
}

template <class Real, class U, Sweep sweep, int first>
void move_nodes(const TileMotion<Real, U>& motion, std::span<const int> nodes, const Real* f) {
  using Lanes = NodeLanes<Real, U>;
  using Register = typename Lanes::Register;
  for (const int node : nodes)
    for (int lane = 0; lane < kLanes; lane += Lanes::kWidth) {
      const Real* at = f + static_cast<std::ptrdiff_t>(node) * 3 * kLanes + lane;
      const Register force[3] = {load<Register>(at), load<Register>(at + kLanes),
                                 load<Register>(at + 2 * kLanes)};
      move_node<sweep, first, Real, U>(motion, node, lane, force);
    }
}

template <class Real, class U>
TileMove<Real, U> select_move(TileVariant v) {
  if (v.sweep == Sweep::revolved) return move_nodes<Real, U, Sweep::revolved, 0>;
  return v.vertical_only ? move_nodes<Real, U, Sweep::extruded, 2> : move_nodes<Real, U, Sweep::extruded, 0>;
}

template <class Real, class U, Sweep sweep, bool finite_rotation>
DeformationEnergy tile_energy(const TileElements<Real>& elements, const TileView<Real, U>& view,
                              Real* front) {
  return TileLoop<Real, U, sweep, false, finite_rotation>(elements, view, front).energy();
}

/// Loops of a law that is not linear.
template <template <class> class Law, class Real, class U, Sweep sweep>
void law_force(const TileElements<Real>& elements, const TileView<Real, U>& view, Real* front) {
  TileLoop<Real, U, sweep, false, sweep == Sweep::revolved, 0, Law>(elements, view, front).run();
}

template <template <class> class Law, class Real, class U, Sweep sweep>
DeformationEnergy law_energy(const TileElements<Real>& elements, const TileView<Real, U>& view, Real* front) {
  return TileLoop<Real, U, sweep, false, sweep == Sweep::revolved, 0, Law>(elements, view, front).energy();
}

template <class Real, class U>
TileForce<Real, U> select_law_force(TileVariant v) {
  return Laws::with(v.law, [&]<template <class> class Law>() -> TileForce<Real, U> {
    if constexpr (Law<Real>::kLinear)
      return nullptr;
    else
      return v.sweep == Sweep::revolved ? law_force<Law, Real, U, Sweep::revolved>
                                        : law_force<Law, Real, U, Sweep::extruded>;
  });
}

template <class Real, class U>
TileEnergy<Real, U> select_law_energy(TileVariant v) {
  return Laws::with(v.law, [&]<template <class> class Law>() -> TileEnergy<Real, U> {
    if constexpr (Law<Real>::kLinear)
      return nullptr;
    else
      return v.sweep == Sweep::revolved ? law_energy<Law, Real, U, Sweep::revolved>
                                        : law_energy<Law, Real, U, Sweep::extruded>;
  });
}

template <class Real, class U>
TileEnergy<Real, U> select_energy(TileVariant v) {
  if (!is_linear(v.law)) return select_law_energy<Real, U>(v);
  if (v.sweep == Sweep::revolved)
    return v.finite_rotation ? tile_energy<Real, U, Sweep::revolved, true>
                             : tile_energy<Real, U, Sweep::revolved, false>;
  return v.finite_rotation ? tile_energy<Real, U, Sweep::extruded, true>
                           : tile_energy<Real, U, Sweep::extruded, false>;
}

template <class Real, class U, Sweep sweep>
TileForce<Real, U> select_options(TileVariant v) {
  if (v.damped)
    return v.finite_rotation ? tile_force<Real, U, sweep, true, true>
                             : tile_force<Real, U, sweep, true, false>;
  return v.finite_rotation ? tile_force<Real, U, sweep, false, true>
                           : tile_force<Real, U, sweep, false, false>;
}

template <class Real, class U>
TileForce<Real, U> select_variant(TileVariant v) {
  if (!is_linear(v.law)) return select_law_force<Real, U>(v);
  if (v.vertical_only)
    return v.damped ? tile_force<Real, U, Sweep::extruded, true, false, 2>
                    : tile_force<Real, U, Sweep::extruded, false, false, 2>;
  return v.sweep == Sweep::revolved ? select_options<Real, U, Sweep::revolved>(v)
                                    : select_options<Real, U, Sweep::extruded>(v);
}

template <class Real, class U>
constexpr TileLoops<Real, U> tile_loops = {select_variant<Real, U>, select_energy<Real, U>,
                                           select_move<Real, U>, kFitting<Real> > kLanes ? kTilesAbreast : 1};

}  // namespace
}  // namespace tread
