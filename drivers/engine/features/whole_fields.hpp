#pragma once
// Access to all nodes, for phases that need more than the nodes on which their features act.

#include "drivers/engine/features/watched_nodes.hpp"
#include "kernels/ties/tie.hpp"
#include "kernels/update/body_motion.hpp"

namespace tread {

/// Fields whose values may live elsewhere, on a device. Between two phases of a step the views of the fields
/// hold those of nodes on which features act, and at samples those of watched nodes.
class WholeFields {
 public:
  /// Brings all values to the views.
  virtual void fetch() {}
  /// Takes over all values from the views, after fetch(): what they were elsewhere is no more.
  virtual void changed() {}
  /// True in steps in which the views do not hold all values.
  virtual bool elsewhere() const { return false; }
  /// Brings these nodes, and the state of laws in the elements among them, to the views.
  virtual void show(const WatchedNodes& /*nodes*/) {}
  /// True in steps in which tied nodes get their forces and motion where the values live.
  virtual bool ties_follow() const { return false; }
  /// True in steps whose forces the views hold, those of contact included.
  virtual bool adds_forces() const { return !elsewhere(); }
  /// Items of the ties whose nodes the views hold in this step; null: all.
  virtual const TieItems* tie_items() const { return nullptr; }

  /// Kinetic energy of the bodies that do not travel [J].
  virtual double fixed_kinetic_energy() = 0;
  /// Their gravity potential [J].
  virtual double fixed_gravity_potential() = 0;
  /// The mean of both half steps' kinetic energies less the product that the energy balance has, at the end
  /// of a measured step [J]. [drivers/engine/fields/energy_sums.hpp]
  virtual double half_step_excess(double dt) = 0;
  /// SpinningBody's of the same names, for the wheel. `wheel`: its frame at the time of the displacements.
  virtual MeanMotion mean_motion(const SpinningBody& body, const BodyFrame& wheel) = 0;
  virtual double kinetic_energy(const SpinningBody& body, const BodyFrame& wheel, double dt) = 0;
  /// Moves the wheel's frame onto the motion `mean`. Tied nodes have still to follow, unless ties_follow().
  virtual void anchor(const SpinningBody& body, const MeanMotion& mean, BodyFrame& wheel, double dt) = 0;

 protected:
  WholeFields() = default;
  ~WholeFields() = default;
};

}  // namespace tread
