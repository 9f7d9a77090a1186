#pragma once
// Kernels of a device over the fields of a run, in one precision. [docs/records/device.md]

#include <cstdint>

#include "kernels/device/march_layout.hpp"
#include "kernels/device/sum_layout.hpp"
#include "kernels/lanes/tie_sum.hpp"
#include "kernels/lanes/tile_force.hpp"
#include "kernels/update/anchoring.hpp"

namespace tread {

/// Groups of kLanes slots whose values come from the host or go there, packed: [group][component][lane].
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

/// A section node of a tile that takes values of primary nodes by a tie.
struct TiedNode {
  std::int64_t own;             ///< place of lane 0, component 0, in a vector field
  int first_link, last_link;    ///< into TiedNodes::links
  int first_share, last_share;  ///< into TiedNodes::shares
};

/// Secondary nodes, which take sums over nodes of other blocks. [TieSum]
struct TiedNodes {
  const TiedNode* node = nullptr;
  std::int64_t count = 0;
  const NodeLink* links = nullptr;  ///< NodeLink::other: a section node of the other block
  const StationLink* shares = nullptr;
};

/// Sums that the lanes of a tile take from a section node of another block, summed up over its stations.
/// Several primary nodes share it.
struct StationSum {
  std::int64_t other;           ///< place of the section node in a vector field, its station's left out
  int first_share, last_share;  ///< into StationSums::shares
};

struct StationSums {
  const StationSum* sum = nullptr;
  std::int64_t count = 0;
  const StationLink* shares = nullptr;
  double* value = nullptr;  ///< [sum][component][lane]
};

/// A section node of a tile that takes values of secondary nodes by a tie.
struct PrimaryNode {
  std::int64_t own;  ///< place of lane 0, component 0, in a vector field
  int station;       ///< of lane 0
  int stations;      ///< of the tile; further lanes are unused
  int section_node;
  int first_link, last_link;  ///< into PrimaryNodes::links
  int first_sum;              ///< of the tile, among all
};

/// Primary nodes of a block.
struct PrimaryNodes {
  const PrimaryNode* node = nullptr;
  std::int64_t count = 0;
  const NodeLink* links = nullptr;  ///< NodeLink::other: a sum of the tile
  const double* sums = nullptr;     ///< StationSums::value
};

/// Primary nodes of several blocks, and what moves them.
template <class Real>
struct PrimaryBlocks {
  static constexpr int kMost = 6;
  struct Of {
    PrimaryNodes nodes;
    MarchBlock<Real> block;
    bool revolved = false;
    bool vertical_only = false;
  };

  Of of[kMost];
  int blocks = 0;

  void add(const PrimaryNodes& nodes, const MarchBlock<Real>& block, const TileVariant& variant) {
    of[blocks++] = {nodes, block, variant.sweep == Sweep::revolved, variant.vertical_only};
  }
  std::int64_t count() const {
    std::int64_t sum = 0;
    for (int b = 0; b < blocks; ++b) sum += of[b].nodes.count;
    return sum;
  }
};

/// The nodes of a revolved block, whose frame is moved onto their motion.
template <class Real>
struct AnchoredNodes {
  MarchBlock<Real> block;
  const double* y = nullptr;       ///< by section node [m]
  const double* radius = nullptr;  ///< likewise [m]
  Anchoring anchoring;

  constexpr std::int64_t count() const { return std::int64_t{block.tiles} * block.section_nodes * kLanes; }
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
  /// Sums up the forces of secondary nodes.
  virtual void sum_stations(const StationSums& sums, const Real* force) = 0;
  /// Adds these sums to the forces of primary nodes, which lie in fields.force, and moves the nodes.
  /// `fields`: of any block.
  virtual void move_primary(const PrimaryBlocks<Real>& primary, const MarchFields<Real, U>& fields) = 0;
  /// Sets these values of both fields to zero.
  virtual void hold(std::int64_t count, const std::int64_t* unknowns, U* u, Real* v) = 0;
  /// Sets the values of the secondary nodes from those of the primary ones.
  virtual void follow(const TiedNodes& secondary, U* u, Real* v) = 0;
  /// Copies a surface's values about the patch: [group][component][lane].
  virtual void collect(const SurfaceWindows& windows, const U* u, const Real* v, U* to_u, Real* to_v) = 0;
  /// Writes the host's groups to the fields u and v.
  virtual void place(const GroupValues<Real, U>& values, U* u, Real* v) = 0;
  /// Takes groups for the host from the fields.
  virtual void take(const GroupValues<Real, U>& values, const U* u, const Real* v) = 0;
  /// q = kept q + gained v of n values. [BranchLag::advance]
  virtual void advance_lag(std::int64_t n, Real kept, Real gained, const Real* v, Real* q) = 0;
  virtual void anchor(const AnchoredNodes<Real>& nodes, U* u, Real* v) = 0;

  virtual void sum_nodes(const NodeSumTask<Real, U>& task) = 0;
  /// `variant.damped` does not matter.
  virtual void sum_elements(TileVariant variant, const ElementSumTask<Real, U>& task) = 0;
  virtual void fold(const FoldTask& task) = 0;

 protected:
  ~FieldKernels() = default;
};

}  // namespace tread
