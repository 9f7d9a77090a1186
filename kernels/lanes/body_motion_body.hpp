#pragma once
// Included by one source per instruction set; internal linkage keeps the versions apart.

#include "kernels/lanes/body_motion.hpp"
#include "kernels/lanes/move_node.hpp"

namespace tread {
namespace {

template <bool spins, class Real, class U>
void move_body_groups(const BodyGroups<Real, U>& groups) {
  using V = typename NodeLanes<Real, U>::Register;
  using Displacement = typename NodeLanes<Real, U>::Displacement;
  for (std::int64_t group = groups.first; group < groups.last; ++group)
    for (int lane = 0; lane < kLanes; lane += NodeLanes<Real, U>::kWidth) {
      const std::int64_t scalars = group * kLanes + lane;
      const std::int64_t vectors = group * 3 * kLanes + lane;
      const V inverse_mass = load<V>(groups.inverse_mass + scalars);
      Displacement u[3];
      V v[3], f[3];
      for (int c = 0; c < 3; ++c) {
        u[c] = load<Displacement>(groups.u + vectors + c * kLanes);
        v[c] = load<V>(groups.v + vectors + c * kLanes);
        f[c] = load<V>(groups.f + vectors + c * kLanes);
      }
      if constexpr (spins) {
        const V weight[2] = {
            groups.gravity[0] + product(groups.step.spin2 + V{}, load<V>(groups.x + scalars)),
            groups.gravity[1] + V{}};
        move_spinning(groups.step, weight, load<V>(groups.z + scalars), inverse_mass, f, u, v);
      } else {
        move_fixed<0>(groups.step, inverse_mass, f, u, v);
      }
      for (int c = 0; c < 3; ++c) {
        store(groups.u + vectors + c * kLanes, u[c]);
        store(groups.v + vectors + c * kLanes, v[c]);
      }
    }
}

template <class Real, class U>
constexpr BodyMoves<Real, U> kBodyMoves = {
    {move_body_groups<false, Real, U>, move_body_groups<true, Real, U>}};

}  // namespace
}  // namespace tread
