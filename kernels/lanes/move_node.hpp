#pragma once
// The motion of a section node's lanes. Internal linkage keeps the versions of the instruction sets apart.

#include <cstddef>

#include "kernels/lanes/registers.hpp"
#include "kernels/lanes/tile_force.hpp"

namespace tread {
namespace {

/// Registers in which a tile's nodes move: as many lanes of both precisions as fit one of the wider.
template <class Real, class U>
struct NodeLanes {
  static constexpr int kWidth = Lanes<U>::kWidth;
  static constexpr int kParts = Lanes<U>::kParts;
  using Register = typename Vector<Real, kWidth>::type;
  using Displacement = typename Lanes<U>::Register;
};

/// Moves the lanes of a section node that begin at `lane` by their force, components from `first` on.
template <Sweep sweep, int first, class Real, class U>
TREAD_INLINE void move_node(const TileMotion<Real, U>& motion, int node, int lane,
                            const typename NodeLanes<Real, U>::Register (&f)[3]) {
  using V = typename NodeLanes<Real, U>::Register;
  using Displacement = typename NodeLanes<Real, U>::Displacement;
  const std::ptrdiff_t scalars = static_cast<std::ptrdiff_t>(node) * kLanes + lane;
  const std::ptrdiff_t vectors = static_cast<std::ptrdiff_t>(node) * 3 * kLanes + lane;
  const V inverse_mass = load<V>(motion.inverse_mass + scalars);
  Displacement u[3];
  V v[3];
  for (int c = first; c < 3; ++c) {
    u[c] = load<Displacement>(motion.u + vectors + c * kLanes);
    v[c] = load<V>(motion.v + vectors + c * kLanes);
  }
  if constexpr (sweep == Sweep::revolved) {
    const V weight[2] = {load<V>(motion.weight[0] + lane), load<V>(motion.weight[1] + lane)};
    move_spinning(motion.step, weight, motion.radius[node], inverse_mass, f, u, v);
  } else {
    move_fixed<first>(motion.step, inverse_mass, f, u, v);
  }
  for (int c = first; c < 3; ++c) {
    store(motion.u + vectors + c * kLanes, u[c]);
    store(motion.v + vectors + c * kLanes, v[c]);
  }
}

}  // namespace
}  // namespace tread
