#pragma once
// Sums over a spinning body and the re-anchoring of its frame. [theory.md, Body frames]

#include <vector>

#include "core/body_frame.hpp"
#include "core/mesh/node_field.hpp"
#include "core/mesh/swept_block.hpp"
#include "core/mesh/tile_sums.hpp"
#include "kernels/update/mean_motion.hpp"

namespace tread {

/// Balances a wheel as a workshop does: scales the masses by 1 + a x + b z, so that their centre comes to lie
/// on the axis. Fine and coarse arcs of a mesh are polygons, whose unequal chords leave it some g m beside
/// it. A body that is not round, or so far out of balance that a mass would change by a hundredth, is left as
/// it is. `mass`: lumped nodal masses of the blocks and of all of the mesh's bodies that spin [kg].
void balance(const Mesh& mesh, const std::vector<int>& blocks, double* mass);

class SpinningBody {
 public:
  SpinningBody() = default;
  /// Blocks and all of the mesh's bodies that spin. `mass`: lumped nodal masses, scalar node field [kg].
  SpinningBody(const Mesh& mesh, std::vector<int> blocks, const double* mass);

  double mass() const { return mass_; }
  double inertia() const { return inertia_; }  ///< moment of inertia about the axis [kg m2]
  double transverse_inertia() const {
    return transverse_;
  }                                              ///< about a diameter through the mass centre [kg m2]
  double centre_y() const { return centre_y_; }  ///< of the centre of mass [m]
  /// Height of the centre of mass above the axis, of the undeformed body at the frame's angle [m]: 0 where
  /// balance() has balanced it.
  double eccentric_height(double angle) const;
  const std::vector<int>& blocks() const { return blocks_; }

  /// Mean motion for the displacement field u [m] and the relative velocity field w [m/s]. `share`: the tiles
  /// whose values this process has; null: all.
  MeanMotion mean_motion(ConstNodeField u, ConstNodeField w, const BodyFrame& frame,
                         const TileShare* share = nullptr) const;

  /// Kinetic energy in inertial axes [J].
  double kinetic_energy(ConstNodeField u, ConstNodeField w, const BodyFrame& frame,
                        const TileShare* share = nullptr) const;
  Vec3 momentum(ConstNodeField u, ConstNodeField w, const BodyFrame& frame) const;

  /// Moves the frame onto a motion relative to it, for example the body's mean_motion(). [Anchoring]
  void anchor(NodeField u, NodeField w, BodyFrame& frame, double dt) const {
    anchor(mean_motion(u, w, frame), u, w, frame, dt);
  }
  /// `groups`: null, or marks by slot / kLanes of the groups whose nodes move.
  void anchor(const MeanMotion& mean, NodeField u, NodeField w, BodyFrame& frame, double dt,
              const unsigned char* groups = nullptr) const;

 private:
  const Mesh* mesh_ = nullptr;
  std::vector<int> blocks_;
  const double* nodal_mass_ = nullptr;
  double mass_ = 0, inertia_ = 0, transverse_ = 0, centre_y_ = 0;
  Vec3 eccentricity_;  ///< of the centre of mass, from the axis at the angle 0 [m]
};

}  // namespace tread
