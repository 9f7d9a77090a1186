#pragma once
// Discrete elements between bodies: spring-dampers, the primary suspension, the unsprung mass, the axle's
// torque. [theory.md, Connectors]

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/body_frame.hpp"
#include "core/mesh/node_field.hpp"
#include "core/mesh/swept_block.hpp"
#include "core/state_list.hpp"
#include "kernels/solver/linear_operator.hpp"

namespace tread {

/// A point on a face of a block: a weighted mean of up to four nodes. Slot -1 marks unused entries; all
/// unused: ground.
struct Attachment {
  std::array<std::int64_t, 4> slot = {-1, -1, -1, -1};
  std::array<double, 4> weight = {0, 0, 0, 0};

  double value(ConstNodeField field, int component) const {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k)
      if (slot[k] >= 0) sum += weight[k] * field[dof(slot[k], component)];
    return sum;
  }
  void add(NodeField field, int component, double load) const {
    for (std::size_t k = 0; k < 4; ++k)
      if (slot[k] >= 0) field[dof(slot[k], component)] += weight[k] * load;
  }
  void add_slots(std::vector<std::int64_t>& slots) const {
    for (const std::int64_t at : slot)
      if (at >= 0) slots.push_back(at);
  }
};

/// Springs and dampers between points of extruded blocks, or to the ground (fastenings).
class SpringDampers {
 public:
  struct Element {
    Attachment upper, lower;
    double stiffness;   ///< [N/m]
    double damping;     ///< [N s/m]
    int component = 2;  ///< direction in which it acts: 0 along, 1 across, 2 vertical

    /// Stretch under a field of displacements; its rate under one of velocities.
    double stretch(ConstNodeField field) const {
      return upper.value(field, component) - lower.value(field, component);
    }
    /// Force with which it pulls its ends together at a stretch [m] that grows at a rate [m/s]: the law of
    /// fastenings [N].
    double load(double stretched, double rate) const { return stiffness * stretched + damping * rate; }
    /// Power that the damper takes at a rate [W].
    double loss(double rate) const { return damping * rate * rate; }
    /// Stored energy at a stretch [m]; its second derivative is the stiffness [J].
    double energy(double stretched) const { return 0.5 * stiffness * stretched * stretched; }
  };
  explicit SpringDampers(std::vector<Element> elements) : elements_(std::move(elements)) {}

  bool empty() const { return elements_.empty(); }
  const std::vector<Element>& elements() const { return elements_; }

  /// force += K u + C v; the dampers' loss over dt is added to dissipated().
  void apply(ConstNodeField u, ConstNodeField v, double dt, NodeField force);
  std::vector<Spring> springs() const;
  std::vector<std::int64_t> slots() const;           ///< of the nodes on which it acts
  double energy(ConstNodeField u) const;             ///< [J]
  double dissipated() const { return dissipated_; }  ///< [J]
  std::int64_t bytes() const { return static_cast<std::int64_t>(elements_.size() * sizeof(Element)); }

  void list_state(StateList& list) { list.add("dissipated", dissipated_); }

 private:
  std::vector<Element> elements_;
  double dissipated_ = 0;
};

/// A ring of nodes of a spinning block whose mass-weighted mean motion carries vehicle parts.
class Journal {
 public:
  Journal() = default;
  /// All stations of the section nodes `path` of a revolved block; weights by `mass` (scalar node field),
  /// centred on the axis.
  Journal(const SweptBlock& block, const std::vector<int>& path, const double* mass);

  /// Mean displacement from the axis and mean velocity, Cartesian [m], [m/s].
  Vec3 displacement(ConstNodeField u, const BodyFrame& frame) const;
  Vec3 velocity(ConstNodeField u, ConstNodeField w, const BodyFrame& frame) const;
  /// The mean velocity's rate under forces on the nodes, gravity aside, Cartesian [m/s2].
  Vec3 acceleration(ConstNodeField force, const BodyFrame& frame) const;

  /// Spreads a Cartesian force over the nodes: field += sign of the caller.
  void add(NodeField field, const BodyFrame& frame, const Vec3& load) const;
  /// A force that add() spreads, over the acceleration that it gives the mean motion; the nodes' mass where
  /// their weights are their masses [kg].
  double mass() const { return mass_; }
  bool empty() const { return nodes_.empty(); }
  std::vector<std::int64_t> slots() const;
  std::int64_t bytes() const { return static_cast<std::int64_t>(nodes_.size() * sizeof(Node)); }

 private:
  struct Node {
    std::int64_t slot;
    double weight;        ///< share of a load
    double per_mass;      ///< weight over the node's mass [1/kg]
    double cosine, sine;  ///< of the node's own angle
  };
  /// Sum of the nodes' vectors, Cartesian, times a factor of each.
  Vec3 vector_sum(ConstNodeField field, const BodyFrame& frame, double Node::*factor) const;

  std::vector<Node> nodes_;
  double mass_ = 0;
};

/// Sprung mass M_c on the primary suspension.
struct SprungMass {
  double mass = 0;                ///< M_c [kg]
  double stiffness = 0;           ///< K [N/m]
  double damping = 0;             ///< C [N s/m]
  double free_length_height = 0;  ///< height of M_c above the journal at which the spring is free [m]
  double height = 0;              ///< z of M_c [m]
  double speed = 0;               ///< vertical, at the half step [m/s]
  double speed_along = 0;         ///< along x, at the half step, where it is carried along [m/s]
  double dissipated = 0;          ///< in the damper [J]

  /// Upward force on M_c from the suspension [N].
  double force(double journal_height, double journal_speed) const {
    return -stiffness * (height - journal_height - free_length_height) - damping * (speed - journal_speed);
  }
  void advance(double upward_force, double gravity, double dt) {
    speed += dt * (upward_force / mass - gravity);
    height += dt * speed;
  }

  void list_state(StateList& list) {
    list.add("height", height);
    list.add("speed", speed);
    list.add("speed_along", speed_along);
    list.add("dissipated", dissipated);
  }
};

/// Torque on the nodes of a section line of a revolved block, as tangential forces proportional to mass and
/// radius.
class AxleTorque {
 public:
  AxleTorque() = default;
  AxleTorque(const SweptBlock& block, const std::vector<int>& path, const double* mass);

  /// Subtracts the nodal forces of `torque` [N m] (about +y) from `force`; returns their power per torque
  /// [rad/s]: the mean spin of the loaded nodes in space. The radial growth of a spinning body lengthens
  /// their levers.
  double apply(double torque, ConstNodeField u, ConstNodeField w, const BodyFrame& frame,
               NodeField force) const;
  /// Adds the nodal forces of `torque` [N m] to an external load.
  void add(NodeField load, double torque) const;
  bool empty() const { return nodes_.empty(); }
  std::vector<std::int64_t> slots() const;
  std::int64_t bytes() const { return static_cast<std::int64_t>(nodes_.size() * sizeof(Node)); }

 private:
  struct Node {
    std::int64_t slot;
    double lever;  ///< force per torque [1/m]
  };
  std::vector<Node> nodes_;
};

}  // namespace tread
