#pragma once
// The motion of the nodes of a body without a section. Its source is compiled once per instruction set.

#include <cstdint>

#include "core/mesh/swept_block.hpp"
#include "kernels/update/node_motion_body.hpp"

namespace tread {

/// Groups of kLanes nodes, [component][lane] in vector fields. Real: velocities, forces; U: displacements.
template <class Real, class U>
struct BodyGroups {
  std::int64_t first = 0, last = 0;  ///< groups that move
  StepConstants<Real> step;
  Real gravity[2] = {};  ///< along x and z in the body's axes; of bodies that spin [m/s2]
  const Real* x = nullptr;
  const Real* z = nullptr;             ///< places by node; of bodies that spin [m]
  const Real* inverse_mass = nullptr;  ///< by node [1/kg]
  U* u = nullptr;                      ///< [m]
  Real* v = nullptr;                   ///< [m/s]
  const Real* f = nullptr;             ///< [N]
};

/// By whether the body spins.
template <class Real, class U>
struct BodyMoves {
  void (*move[2])(const BodyGroups<Real, U>& groups);
};

}  // namespace tread
