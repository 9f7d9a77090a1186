#pragma once
// Central difference: velocities and displacements from forces. [theory.md, Time step]

#include <cstdint>
#include <span>
#include <vector>

#include "core/aligned.hpp"
#include "core/body_frame.hpp"
#include "core/mesh/swept_block.hpp"
#include "kernels/lanes/tile_force.hpp"

namespace tread {

/// Vector fields of 3 * mesh.slots values; precisions as in kernels/lanes/tile_force.hpp.
template <class Real, class U = Real>
struct BasicUpdateFields {
  U* displacement;    ///< [m]
  Real* velocity;     ///< at the half step [m/s]
  const Real* force;  ///< internal minus external [N]
};

/// Loads on all nodes besides their forces.
struct StepLoads {
  double dt = 0;       ///< length of the step [s]
  double gravity = 0;  ///< downwards [m/s2]
  BodyFrame frame;     ///< of revolved blocks

  bool operator==(const StepLoads&) const = default;
};

/// The step of the nodes of a body that is fixed (extruded) or spins (revolved).
template <class Real>
StepConstants<Real> step_constants(Sweep sweep, const StepLoads& loads);

/// Gravity at a station of a revolved block.
GravityInSweep gravity_at(const SweptBlock& block, int station, const StepLoads& loads);

/// Moves the nodes of all blocks: v -= dt (f / m + g e_z), u += dt v in extruded blocks, the same in the
/// spinning frame in revolved ones. Nodes whose force nothing but elements make may move with the elements of
/// their tile (BasicInternalForce::move); deferred ones move here, once their force is complete. Which way a
/// node takes does not show in its bits.
template <class Real, class U = Real>
class BasicTimeUpdate {
 public:
  /// Keeps references; `inverse_mass`: mesh.slots values, 0 where nothing moves (unused lanes, secondary
  /// nodes) [1/kg].
  BasicTimeUpdate(const Mesh& mesh, const Real* inverse_mass);

  /// These nodes get forces besides those of the elements.
  void defer(const std::vector<std::int64_t>& slots);
  /// Those of marked groups do, and no others. `groups`: by slot / kLanes. `apart`: groups among them that
  /// move_apart() moves, and nothing else, ascending. Allocates nothing where no more are marked than before.
  void defer_only(std::span<const unsigned char> groups, std::span<const std::int64_t> apart);

  /// Motion of the nodes of a tile.
  TileMotion<Real, U> motion(int block, int tile, const StepLoads& loads, U* u, Real* v) const;

  /// Moves all nodes.
  void move_all(const StepLoads& loads, const BasicUpdateFields<Real, U>& fields) const {
    move(loads, fields, nullptr);
  }
  /// Moves the deferred nodes, and all of the tiles marked in `whole` (in the order of blocks and tiles).
  void move_rest(const StepLoads& loads, const BasicUpdateFields<Real, U>& fields,
                 const std::vector<unsigned char>& whole) const {
    move(loads, fields, whole.data());
  }
  /// Moves the nodes of a tile that are not deferred. `item`: in the order of blocks and tiles.
  void move_undeferred(std::size_t item, const StepLoads& loads,
                       const BasicUpdateFields<Real, U>& fields) const;
  /// Moves the nodes that were set apart.
  void move_apart(const StepLoads& loads, const BasicUpdateFields<Real, U>& fields) const;
  /// Moves the deferred nodes alone, by one thread where they are few.
  void move_deferred(const StepLoads& loads, const BasicUpdateFields<Real, U>& fields) const;

 private:
  enum Mark : unsigned char { kMoves, kDeferred, kApart };
  struct Item {
    int block = 0;
    int tile = 0;
  };
  void move(const StepLoads& loads, const BasicUpdateFields<Real, U>& fields,
            const unsigned char* whole) const;
  void list_deferred();
  /// Moves the nodes of a tile whose mark is chosen.
  template <class Chosen>
  void move_marked(std::size_t item, const Chosen& chosen, const StepLoads& loads,
                   const BasicUpdateFields<Real, U>& fields) const;
  void move_nodes(std::size_t item, std::span<const int> nodes, const StepLoads& loads,
                  const BasicUpdateFields<Real, U>& fields) const;
  std::span<const int> deferred_nodes(std::size_t item) const;

  const Mesh& mesh_;
  const Real* inverse_mass_;
  std::vector<AlignedVector<Real>> radius_;  ///< by block and section node (revolved) [m]
  std::vector<Item> items_;                  ///< all tiles
  std::vector<unsigned char> deferred_;      ///< Mark by tile and section node: by slot / kLanes
  std::vector<int> deferred_nodes_;          ///< section nodes, tile by tile
  std::vector<std::size_t> first_deferred_;  ///< by item, into deferred_nodes_
  std::vector<std::size_t> with_deferred_;   ///< items that have any
  std::vector<std::size_t> with_apart_;      ///< items that have nodes set apart
  std::vector<int> all_nodes_;               ///< 0, 1, 2 ...
};

extern template StepConstants<double> step_constants(Sweep, const StepLoads&);
extern template StepConstants<float> step_constants(Sweep, const StepLoads&);

using TimeUpdate = BasicTimeUpdate<double>;
extern template class BasicTimeUpdate<double>;
extern template class BasicTimeUpdate<float, double>;
extern template class BasicTimeUpdate<float>;

}  // namespace tread
