#pragma once
// Fields at the nodes of a run, in the scene's precision, and the operations of a step on all of them at
// once. Whoever touches few of them does so through views, in double. [theory.md, Precision]

#include <cstdint>
#include <span>

#include "core/aligned.hpp"
#include "core/mesh/node_field.hpp"
#include "core/state_list.hpp"
#include "drivers/engine/features/whole_fields.hpp"
#include "drivers/engine/model/model.hpp"
#include "kernels/blocks/time_update.hpp"

namespace tread {

/// Energy of all elements, Maxwell branches aside.
struct ElementEnergy {
  double stored = 0;      ///< by the laws and the hourglass stiffness [J]
  double dissipated = 0;  ///< by the laws so far [J]

  ElementEnergy& operator+=(const ElementEnergy& o) {
    stored += o.stored;
    dissipated += o.dissipated;
    return *this;
  }
};

/// Energy of all Maxwell branches.
struct BranchEnergy {
  double stored = 0;  ///< in their springs [J]
  double power = 0;   ///< dissipated in their dashpots [W]

  BranchEnergy& operator+=(const BranchEnergy& o) {
    stored += o.stored;
    power += o.power;
    return *this;
  }
};

class NodeFields : public WholeFields {
 public:
  NodeFields() = default;
  NodeFields(const NodeFields&) = delete;
  NodeFields& operator=(const NodeFields&) = delete;
  virtual ~NodeFields() = default;

  NodeField displacement() { return displacement_; }  ///< [m]
  ConstNodeField displacement() const { return displacement_; }
  NodeField velocity() { return velocity_; }  ///< at the half step [m/s]
  ConstNodeField velocity() const { return velocity_; }
  NodeField force() { return force_; }  ///< internal minus external [N]
  ConstNodeField force() const { return force_; }
  /// Lag of the Maxwell branches, where there are any [m].
  ConstNodeField lag() const { return lag_; }
  /// State of the laws that are not linear, where there are any.
  ConstLawState laws() const { return laws_; }

  /// Displacement [m] and velocity [m/s] of all nodes, rounded to the fields' precisions.
  virtual void set(const AlignedVector<double>& displacement, const AlignedVector<double>& velocity) = 0;

  /// Internal forces of all blocks; the laws' state advances to the displacement. Once a step. Nodes on which
  /// nothing else acts may move, unless the step is measured: energies want the forces of all nodes.
  virtual void internal_force_and_move(const StepLoads& loads, bool measured) = 0;
  /// A step of dt [s] begins. True if move_with_contact() can take the place of internal_force_and_move()
  /// where it is not measured.
  virtual bool follow_patch(const BodyFrame& /*wheel*/, double /*dt*/) { return false; }
  /// Does so, and solves the contact beside the elements away from the patch. The contact's search is aimed.
  /// `time`: at the start of the step [s].
  virtual void move_with_contact(const StepLoads& /*loads*/, double /*time*/) {}
  /// Moves those that have not moved, in the same step.
  virtual void move_rest(const StepLoads& loads, bool measured) = 0;
  /// Lets the unknowns, which have moved, stand still at zero.
  virtual void hold(std::span<const std::int64_t> unknowns) = 0;

  /// The tractions have moved the patch: gives other ranks its motion.
  virtual void spread_patch(bool /*measured*/) {}

  /// The lag follows the motion of a step of dt [s].
  virtual void advance_lag(double dt) = 0;

  /// Energy in the elements of a part of the mesh, Maxwell branches aside [J].
  virtual DeformationEnergy energy(int part) const = 0;
  /// The same in all blocks, in a measured step before nodes move; cheaper than element by element where the
  /// forces are precise enough for it [J].
  virtual ElementEnergy element_energy() = 0;
  virtual BranchEnergy branch_energy() = 0;

  /// Marks by slot / kLanes of the nodes whose masses steps read; empty: all.
  virtual std::span<const unsigned char> groups_with_mass() const { return {}; }

  /// Gives other ranks what they hold of rank 0's values.
  virtual void spread() {}

  virtual bool finite() const = 0;
  virtual void list_state(StateList& list) = 0;

 protected:
  NodeField displacement_, velocity_, force_;
  ConstNodeField lag_;
  ConstLawState laws_;
};

/// Size of one component of one node [B].
struct ValueBytes {
  int displacement, other;  ///< other: velocity, force and mass
};
ValueBytes value_bytes(const Scene& scene);

}  // namespace tread
