#pragma once
// Patches of nodes that move as rigid bodies: the coarse space of the two-level preconditioner.

#include <array>
#include <cstdint>
#include <vector>

#include "core/aligned.hpp"
#include "core/mesh/swept_block.hpp"

namespace tread {

struct AggregateOptions {
  double size = 0.04;    ///< largest extent of an aggregate, roughly [m]
  int nodes_across = 8;  ///< most nodes along one direction, roughly
  int least_across = 3;  ///< nodes along one direction that `size` does not part
};

/// Every free node belongs to one aggregate: a connected part of a block's section times a run of stations.
/// An aggregate has up to six modes: its rigid motions on the free unknowns, orthonormal in the plain
/// product; motions that these unknowns cannot tell apart (a line of nodes, vertical motion only) are left
/// out. Together the modes are the columns of Z, numbered aggregate after aggregate.
class Aggregates {
 public:
  /// `free` has 3 * mesh.slots values: not 0 where the unknown is free, 0 elsewhere and in unused lanes.
  Aggregates(const Mesh& mesh, const AlignedVector<double>& free, const AggregateOptions& options);

  int count() const { return static_cast<int>(patches_.size()); }
  int modes() const { return modes_; }  ///< columns of Z
  int first_mode(int aggregate) const { return patches_[static_cast<std::size_t>(aggregate)].first_mode; }
  int mode_count(int aggregate) const { return patches_[static_cast<std::size_t>(aggregate)].mode_count; }

  /// Aggregate of a node slot; -1 if the node has no free unknown.
  int of_slot(std::int64_t slot) const { return of_slot_[static_cast<std::size_t>(slot)]; }

  /// Row of Z at an unknown of a free node: its values on the modes of the node's aggregate.
  std::array<double, 6> mode_row(std::int64_t unknown) const;

  /// coarse = Z^T fine; `coarse` has modes() values, `fine` 3 * mesh.slots.
  void restrict_to_modes(const double* fine, double* coarse) const;

  /// fine += Z coarse
  void prolongate_add(const double* coarse, double* fine) const;

 private:
  struct Node {
    double offset[3];  ///< from the aggregate's centre, Cartesian [m]
    double cosine;     ///< of the station's angle; 1 with sine 0 stands for an extruded block's basis
    double sine;
    std::int32_t slot;
    std::int16_t free;      ///< bit c: component c is free
    std::int16_t revolved;  ///< local basis (t, y, r) instead of (x, y, z)
  };
  struct Patch {
    std::int64_t first_node = 0;
    std::int64_t last_node = 0;
    int first_mode = 0;
    int mode_count = 0;
    /// Row k: the six rigid motions (translations [m], rotations about the centre [rad]) of mode k.
    std::array<std::array<double, 6>, 6> basis = {};
  };

  using Rigid = std::array<double, 6>;
  static std::array<Rigid, 3> rigid_rows(const Node& node);
  void add_patch(const SweptBlock& block, const std::vector<int>& part, int first_station, int last_station,
                 const AlignedVector<double>& free);
  void orthonormalise(Patch& patch);

  std::vector<Node> nodes_;
  std::vector<Patch> patches_;
  std::vector<std::int32_t> of_slot_;
  int modes_ = 0;
};

}  // namespace tread
