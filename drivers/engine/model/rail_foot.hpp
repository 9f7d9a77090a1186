#pragma once
// The underside of the rail's foot, on which the fastenings act.

#include <optional>
#include <string>
#include <vector>

#include "core/mesh/swept_block.hpp"
#include "core/scene.hpp"
#include "drivers/engine/model/block_index.hpp"
#include "kernels/connectors/connectors.hpp"
#include "kernels/ties/face_finder.hpp"

namespace tread {

/// A node of the foot and its place [m].
struct FootNode {
  std::int64_t slot = -1;
  double x = 0, y = 0;
};

class RailFoot {
 public:
  /// The line "foot" of a block's section; keeps a reference.
  explicit RailFoot(const SweptBlock& block);
  /// The outer faces on a set of a body's nodes. `key`: of the scene that names the set. InputError if there
  /// are none.
  RailFoot(const HexBody& body, const std::string& set, const std::string& key);

  double middle() const { return middle_; }  ///< y halfway across [m]
  std::vector<FootNode> nodes() const;

  /// InputError if (x, y) [m] lies beyond the foot.
  Attachment attach(double x, double y) const;
  /// The same on a node beside it where (x, y) lies beyond a body's set.
  Attachment attach_near(double x, double y) const;
  /// Nodes within half lengths of (x, y) [m]; where there are none, the nearest.
  std::vector<FootNode> within(double x, double y, double half_length, double half_width) const;

 private:
  /// On the set's faces of a body; empty beyond them.
  std::optional<Attachment> on_faces(double x, double y) const;

  const SweptBlock* block_ = nullptr;  ///< null: of a body
  std::string key_;
  double middle_ = 0;
  std::vector<FootNode> nodes_;                  ///< of a body
  std::optional<FaceFinder> faces_;              ///< of a body, seen from below
  std::vector<std::array<std::int64_t, 4>> at_;  ///< slots of the faces' corners
};

/// The foot of the rail's part that stands on fastenings or ground.
RailFoot foot_of_rail(const Scene& scene, const Mesh& mesh, const BlockIndex& index);

/// Spring-dampers of the scene's fastenings under the rail's foot, fastening by fastening: vertical ones on
/// the block `below` of each or, if that is null, on rigid ground; along and across where they are elastic,
/// to the ground.
std::vector<SpringDampers::Element> fastening_elements(const Scene& scene, const RailFoot& rail,
                                                       const std::vector<const SweptBlock*>& below);

/// Number of spring-dampers of a fastening.
std::size_t elements_of_fastening(const FasteningSpec& fastening);

/// Nodes of the rail's foot that the fastenings hold (FasteningSpec::held_at); of each fastening at least
/// one.
std::vector<FootNode> held_foot_nodes(const Scene& scene, const RailFoot& foot);

}  // namespace tread
