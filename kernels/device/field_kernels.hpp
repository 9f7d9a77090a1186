#pragma once
// Kernels of a device over the fields of a run, in one precision. [docs/records/device.md]

#include <cstdint>

#include "kernels/device/march_layout.hpp"
#include "kernels/lanes/tie_sum.hpp"
#include "kernels/lanes/tile_force.hpp"

namespace tread {

/// Groups of kLanes slots whose values come from the host, packed: [group][component][lane].
template <class Real, class U>
struct GroupValues {
  const std::int64_t* groups = nullptr;
  std::int64_t count = 0;
  U* u = nullptr;     ///< [m]
  Real* v = nullptr;  ///< [m/s]
};

/// Nodes of a running surface on a stretch of tiles, which may pass the end of a full turn.
struct SurfaceWindow {
  const int* node = nullptr;  ///< section nodes
  int nodes = 0;
  std::int64_t first_group = 0;  ///< of the block's kLanes slots among all
  int section_nodes = 0;
  int all_tiles = 0;  ///< of the block
  int first_tile = 0, tiles = 0;

  std::int64_t groups() const { return std::int64_t{nodes} * tiles; }
  /// Number among all of the window's i-th group; `of_node`: as `node`, there or a copy of it.
  TREAD_INLINE std::int64_t group(std::int64_t i, const int* of_node) const {
    const std::int64_t tile = (first_tile + i / nodes) % all_tiles;
    return first_group + tile * section_nodes + of_node[i % nodes];
  }
};

/// The running surfaces of rail and wheel about the patch.
struct SurfaceWindows {
  SurfaceWindow of[2];

  std::int64_t groups() const { return of[0].groups() + of[1].groups(); }
};

/// A section node of a tile that takes values by a tie.
struct TiedNode {
  std::int64_t own;  ///< place of lane 0, component 0, in a vector field
  int station;       ///< of lane 0
  int stations;      ///< of the tile; further lanes are unused
  int section_node;
  int first_link, last_link;    ///< into TiedNodes::links
  int first_share, last_share;  ///< into TiedNodes::shares
};

/// Nodes of a block that take sums over nodes of others. [TieSum]
struct TiedNodes {
  const TiedNode* node = nullptr;
  std::int64_t count = 0;
  const NodeLink* links = nullptr;  ///< NodeLink::other: a section node of the other block
  const StationLink* shares = nullptr;
};

template <class Real, class U>
class FieldKernels {
 public:
  FieldKernels() = default;
  FieldKernels(const FieldKernels&) = delete;
  FieldKernels& operator=(const FieldKernels&) = delete;

  /// Forces of a block, and motion of its nodes. `variant.damped` does not matter: fields.added says it.
  virtual void march(TileVariant variant, const MarchBlock<Real>& block,
                     const MarchFields<Real, U>& fields) = 0;
  /// Adds the forces of the secondary nodes to those of a block's primary nodes, and moves these. All lie in
  /// fields.force.
  virtual void move_primary(TileVariant variant, const TiedNodes& primary, const MarchBlock<Real>& block,
                            const MarchFields<Real, U>& fields) = 0;
  /// Sets these values of both fields to zero.
  virtual void hold(std::int64_t count, const std::int64_t* unknowns, U* u, Real* v) = 0;
  /// Sets the values of the secondary nodes from those of the primary ones.
  virtual void follow(const TiedNodes& secondary, U* u, Real* v) = 0;
  /// Copies a surface's values about the patch: [group][component][lane].
  virtual void collect(const SurfaceWindows& windows, const U* u, const Real* v, U* to_u, Real* to_v) = 0;
  /// Writes the host's groups to the fields u and v.
  virtual void place(const GroupValues<Real, U>& values, U* u, Real* v) = 0;
  /// q = kept q + gained v of n values. [BranchLag::advance]
  virtual void advance_lag(std::int64_t n, Real kept, Real gained, const Real* v, Real* q) = 0;

 protected:
  ~FieldKernels() = default;
};

}  // namespace tread
