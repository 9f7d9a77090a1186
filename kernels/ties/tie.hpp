#pragma once
// Tied surfaces between blocks of different pitch. The fine side's nodes lie on the chords of the coarse side
// and follow its faces by Cartesian bilinear interpolation. Their forces and masses go to the primary nodes.
// [theory.md, Ties]

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/function_ref.hpp"
#include "core/mesh/node_field.hpp"
#include "core/mesh/swept_block.hpp"
#include "kernels/lanes/tie_sum.hpp"
#include "kernels/solver/linear_operator.hpp"
#include "kernels/ties/node_links.hpp"

namespace tread {

/// The tied lines of two blocks' sections. Both blocks sweep in one way, extruded or revolved.
struct TieSpec {
  int secondary = -1;          ///< fine block
  std::string secondary_path;  ///< nodes ordered by increasing p
  int primary = -1;            ///< coarse block
  std::string primary_path;    ///< nodes ordered by increasing p
};

/// Moves the secondary nodes onto the chords of the primary faces (node_shift). Call it before coefficients
/// are made. Throws InputError if a secondary node lies off the primary line in the section or has no primary
/// station.
void place_on_chords(Mesh& mesh, const TieSpec& spec);

/// One direction of all ties: links from nodes to the nodes of the other block whose values they take.
struct TieSums {
  /// A tile with links.
  struct Item {
    std::int64_t own = 0;           ///< place as TieTile::own
    std::size_t first_station = 0;  ///< index in `stations`
    int station_count = 0;
    std::size_t first_other = 0;  ///< index in `others`
    int other_count = 0;
    std::size_t first_node = 0;  ///< index in `nodes`
    int node_count = 0;
  };
  std::vector<Item> items;
  std::vector<StationLink> stations;
  std::vector<int> others;  ///< section nodes of the other block
  std::vector<LinkedNode> nodes;
  std::vector<NodeLink> links;
};

/// Some of the items of both directions, by index.
struct TieItems {
  std::vector<std::size_t> to_secondary, to_primary;
};

class Ties {
 public:
  /// `tied`: nodes of and on bodies without a section.
  Ties(const Mesh& mesh, const std::vector<TieSpec>& specs, const std::vector<FollowingNode>& tied = {});

  bool empty() const { return secondary_.empty(); }
  std::int64_t secondary_count() const { return static_cast<std::int64_t>(secondary_.size()); }
  const std::vector<std::int64_t>& secondary_slots() const { return secondary_; }
  const std::vector<std::int64_t>& primary_slots() const { return primary_; }

  const TieSums& to_secondary() const { return to_secondary_; }
  const TieSums& to_primary() const { return to_primary_; }

  /// Bytes of the links.
  std::int64_t bytes() const;

  /// Calls visit(secondary slot, primary slot) for all pairs.
  void for_each_pair(FunctionRef<void(std::int64_t, std::int64_t)> visit) const;
  /// The pairs by secondary node, for the solver's coarse level.
  std::vector<TiedSlot> tied_slots() const;

  /// Items whose own nodes lie in marked groups. `groups`: by slot / kLanes.
  TieItems items_in(const std::vector<unsigned char>& groups) const;

  /// Sets the secondary values from the primary ones; vector fields of 3 * slots values. `some`: of the ties
  /// between blocks, null for all ties.
  void follow(std::initializer_list<NodeField> fields, const TieItems* some = nullptr) const;

  /// Adds the secondary values to the primary ones: transpose of follow.
  void hand_over(NodeField force, const TieItems* some = nullptr) const;
  /// Calls hand_over and sets the secondary values to zero.
  void gather(double* force) const;
  /// Sets the secondary values to zero.
  void clear(double* field) const;

  /// Diagonal of T^T D T for a diagonal D given as a vector field (its turn between the bases left out).
  void gather_diagonal(double* diagonal) const;

  /// Diagonal of T^T M T for lumped masses M, a scalar field of `slots` values [kg].
  void gather_mass(double* mass) const;

 private:
  void join(const Mesh& mesh, const TieSpec& spec);
  void list_slots(std::int64_t slots);

  std::vector<std::int64_t> secondary_, primary_;  ///< slots, ascending
  TieSums to_secondary_, to_primary_;
  NodeLinks nodes_;
};

}  // namespace tread
