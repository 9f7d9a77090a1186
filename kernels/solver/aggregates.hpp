#pragma once
// Patches of nodes that move as rigid bodies: the coarse space of the two-level preconditioner.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/aligned.hpp"
#include "core/mesh/swept_block.hpp"
#include "kernels/solver/aggregate_parts.hpp"
#include "kernels/solver/rigid_motion.hpp"

namespace tread {

/// Number of aggregates of a mesh whose nodes are all free.
std::int64_t aggregate_count(const Mesh& mesh, const AggregateOptions& options = {});

/// Division of the free nodes into aggregates: connected parts of a block's section times a run of stations,
/// and boxes of a body's nodes.
/// Every free node belongs to one aggregate. An aggregate has up to six modes: its rigid motions on the free
/// unknowns, orthonormal in the plain product. Motions that these unknowns cannot tell apart (a line of
/// nodes, vertical motion only) are left out. Together the modes are the columns of Z, numbered aggregate
/// after aggregate. Shifts of single nodes are left out: they are small beside an aggregate. One object
/// serves one caller at a time: restricting uses a buffer of its own.
class Aggregates {
 public:
  /// Keeps a reference to the mesh. `free` has 3 * mesh.slots values: nonzero where the unknown is free, 0
  /// elsewhere and in unused lanes.
  Aggregates(const Mesh& mesh, const AlignedVector<double>& free, const AggregateOptions& options);

  int count() const { return static_cast<int>(patches_.size()); }
  int modes() const { return modes_; }  ///< number of columns of Z
  int first_mode(int aggregate) const { return patches_[static_cast<std::size_t>(aggregate)].first_mode; }
  int mode_count(int aggregate) const { return patches_[static_cast<std::size_t>(aggregate)].mode_count; }

  /// Aggregate of a node slot; -1 if the node has no free unknown.
  int of_slot(std::int64_t slot) const;

  /// Row of Z at an unknown of a free node: its values on the modes of the node's aggregate.
  std::array<double, 6> mode_row(std::int64_t unknown) const;

  /// Computes coarse = Z^T fine. `coarse` has modes() values, `fine` 3 * mesh.slots, read where it is free.
  void restrict_to_modes(const double* fine, double* coarse) const;

  /// Adds Z coarse to `fine` where it is free.
  void prolongate_add(const double* coarse, double* fine) const;

 private:
  /// A part of a block's section, along all stations of the block.
  struct Part {
    const SweptBlock* block;
    std::vector<int> nodes;
    std::size_t first_slice;
  };
  /// A part at a station.
  struct Slice {
    StationPlace place;
    int patch = -1;
  };
  struct Patch {
    int part = -1;  ///< -1: of a body
    int first_station = 0;
    int last_station = 0;
    std::size_t first_node = 0, last_node = 0;  ///< of a body, in body_nodes_
    int first_mode = 0;
    int mode_count = 0;
    Vec3 centre;
    std::array<RigidMotion, 6> basis = {};  ///< modes about the centre
  };
  /// A part's nodes in a tile.
  struct Item {
    int part;
    int tile;
  };

  void add_part(const SweptBlock& block, std::vector<int> nodes, const AggregateOptions& options);
  void add_stations(int part, int first_station, int last_station);
  void add_box(const HexBody& body, const std::vector<std::int32_t>& nodes);
  bool add_patch(Patch patch);
  void orthonormalise(Patch& patch) const;
  template <class Visit>
  void for_each_node(const Patch& patch, const Visit& visit) const;
  const Slice& slice(const Part& part, int station) const {
    return slices_[part.first_slice + static_cast<std::size_t>(station)];
  }
  /// A node of a body.
  struct BodyNode {
    std::int64_t slot = 0;
    Vec3 at;
  };
  bool is_of_body(std::int64_t slot) const { return slot >= first_body_slot_; }
  RigidMotion motion(const Patch& patch, const double* coarse) const;
  RigidMotion resultant(const Patch& patch, const double* fine) const;
  /// Calls visit(weight) for a group of slots; weight(component, lane) is 1 for a free and 0 for a held
  /// unknown.
  template <class Visit>
  void where_free(std::int64_t first_slot, const Visit& visit) const {
    const std::uint8_t* free = free_.data() + first_slot;
    if (std::all_of(free, free + kLanes, [](std::uint8_t bits) { return bits == kAllFree; }))
      visit([](int, int) { return 1.0; });  // most groups: no look at single lanes
    else
      visit([free](int c, int lane) { return free[lane] >> c & 1 ? 1.0 : 0.0; });
  }

  template <class Visit>
  void for_each_slot(const Item& item, const double* field, const Visit& visit) const;

  static constexpr std::uint8_t kAllFree = 0b111;

  const Mesh* mesh_;
  std::vector<std::uint8_t> free_;  ///< free components by slot; bit c: component c is free
  std::vector<Part> parts_;
  std::vector<std::vector<int>> part_of_node_;  ///< part by block and section node
  std::vector<Slice> slices_;
  std::vector<Patch> patches_;
  std::vector<Item> items_;
  std::int64_t first_body_slot_;             ///< slots from here on are of bodies
  std::vector<BodyNode> body_nodes_;         ///< by patch
  std::vector<std::int32_t> of_body_slots_;  ///< by slot of bodies, index in body_nodes_; -1: none
  std::vector<int> body_patches_;            ///< patches of bodies by index in body_nodes_
  int modes_ = 0;
  mutable std::vector<StationValues> sums_;  ///< buffer by slice
};

}  // namespace tread
