#pragma once
// Step 1: static equilibrium under gravity, spin and wheel load with contact, by Newton's method on the contact set.
// [theory.md, Preload]

#include <functional>

#include "core/aligned.hpp"
#include "core/body_frame.hpp"
#include "drivers/model.hpp"

namespace tread {

struct Preload {
  AlignedVector<double> displacement;  ///< secondary nodes filled [m]
  BodyFrame wheel;                     ///< at angle 0, at rest; its origin lies on the undeformed axis
  double residual = 0;                 ///< 2-norm of the balanced residual / wheel load (or external load) [-]
  int newton_iterations = 0;
  int cg_iterations = 0;
  double held_force_x = 0;             ///< reaction of the held longitudinal motion of the wheel [N]
  double held_moment = 0;              ///< reaction of its held rotation about the axle [N m]
  double tilt = 0;                     ///< of the wheel about x, from the tread's mean [rad]
  double rail_deflection = 0;          ///< downwards, of the rail's foot under the wheel [m]
  double slab_deflection = 0;          ///< [m]
  ContactTotals contact;
  double spin_tread_growth = 0;        ///< radial, of the freely spinning wheel [m]
};

using ProgressText = std::function<void(const std::string&)>;

/// `spin`: of the wheel for the centrifugal load, 0 for none [rad/s]. Throws NumericalError if Newton's method or the
/// linear solver does not converge.
Preload solve_preload(Model& model, double spin, const ProgressText& progress);

}  // namespace tread
