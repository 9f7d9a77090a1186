#pragma once
// The bore of a wheel on a rigid carrier: it moves forward as it is told and is free to rise and to turn
// about the axle. [theory.md, Connectors]

#include <cstdint>
#include <vector>

#include "core/body_frame.hpp"
#include "core/mesh/node_field.hpp"
#include "core/mesh/swept_block.hpp"
#include "core/state_list.hpp"
#include "kernels/update/body_motion.hpp"

namespace tread {

/// Loads on the carrier.
struct CarrierLoad {
  double up = 0;      ///< vertical force [N]
  double torque = 0;  ///< about +y [N m]
};

/// Displacements and velocities of the bore's nodes, relative to the wheel's frame.
struct BoreFields {
  NodeField displacement;  ///< [m]
  NodeField velocity;      ///< [m/s]
};

class GuidedBore {
 public:
  /// Section nodes `path` of a revolved block, all its stations; `mass`: lumped, scalar node field [kg].
  /// The carrier balances the block about the axle by a counterweight without inertia.
  GuidedBore(const SweptBlock& block, const std::vector<int>& path, const double* mass);

  // Statics: the carrier only rises, and one unknown of the field stands for that.
  /// Fills the bore's nodes from the unknown.
  void expand(double* field) const;
  /// The forces on the bore become one on the unknown, the others zero.
  void reduce(double* force) const;
  std::int64_t unknown() const { return unknown_; }
  /// Unknowns of the bore in the plane of rolling, unknown() included.
  const std::vector<std::int64_t>& unknowns() const { return unknowns_; }
  /// Displacement that the unknown has when the carrier rises by one.
  double per_rise() const { return per_rise_; }
  /// Mass that moves with the unknown [kg].
  double static_mass() const { return mass_ / (per_rise_ * per_rise_); }

  /// Vertical force of the counterweight: against the block's centrifugal force about the axle [N].
  double counterweight(double spin, double angle) const;

  /// Takes over the carrier's place from the fields, which move rigidly: after statics.
  void settle(ConstNodeField displacement);
  /// The frame has been moved onto the carrier.
  void anchored() { rise_ = rotation_ = rise_speed_ = spin_ = 0; }

  /// Replaces the step of the free bore nodes (fields after it, frame before it) by the rigid motion of the
  /// same momentum under `load`; the forward motion stays that of the frame.
  void move(const BoreFields& fields, const BodyFrame& frame, double dt, const CarrierLoad& load);

  /// Relative to the frame, at the time of the displacements; velocities half a step before it.
  MeanMotion motion() const;
  /// Impulse with which the guide held the forward speed in the last step [N s].
  double guide_impulse() const { return guide_impulse_; }

  std::int64_t bytes() const { return static_cast<std::int64_t>(nodes_.size() * sizeof(Node)); }

  void list_state(StateList& list) {
    list.add("rise", rise_);
    list.add("rotation", rotation_);
    list.add("rise_speed", rise_speed_);
    list.add("spin", spin_);
  }

 private:
  struct Node {
    std::int64_t slot;
    double mass;          ///< [kg]
    double radius;        ///< [m]
    double cosine, sine;  ///< of the node's own angle
  };
  std::vector<Node> nodes_;
  std::vector<std::int64_t> unknowns_;
  std::int64_t unknown_ = -1;
  double per_rise_ = 0;
  double mass_ = 0;
  double imbalance_down_ = 0, imbalance_behind_ = 0;  ///< first moments of the block's mass at angle 0 [kg m]
  double rise_ = 0;                                   ///< of the carrier over the frame [m]
  double rotation_ = 0;                               ///< [rad]
  double rise_speed_ = 0;                             ///< [m/s]
  double spin_ = 0;                                   ///< [rad/s]
  double guide_impulse_ = 0;
};

}  // namespace tread
