#pragma once
// One sample of the histories.

#include "drivers/engine/features/energy_ledger.hpp"

namespace tread {

/// Values of all features at one instant; those of absent features are zero.
struct Sample {
  double time = 0;
  double wheel_x = 0, wheel_z = 0;         ///< of the frame's origin [m]
  double wheel_speed = 0, wheel_spin = 0;  ///< [m/s], [rad/s]
  double vertical_force = 0;               ///< F_N, on the wheel, upwards [N]
  double longitudinal_force = 0;           ///< F_L, on the wheel, forwards [N]
  double lateral_force = 0;                ///< on the wheel, to the field side [N]
  double patch_area = 0, slip_area = 0;    ///< [m2]
  double max_pressure = 0, max_shear = 0;  ///< nodal averages [Pa]
  double max_penetration = 0;              ///< [m]
  double creepage_node = 0;  ///< eq. (13) at the point of the tread that starts in the patch [-]
  double creepage_mean = 0;  ///< mean of 28 points around the tread; guided bore: by the carrier's spin [-]
  double lateral_creepage = 0;     ///< mean lateral speed of the wheelset over its forward speed [-]
  double spin_creepage = 0;        ///< wheel's rotation about the rail's outward normal, over the way [1/m]
  double torque = 0;               ///< [N m]
  double corrugation_depth = 0;    ///< of the rail, below the wheel [m]
  double hammer_force = 0;         ///< on the rail, downwards [N]
  double hammer_displacement = 0;  ///< of the struck point since the start, downwards [m]
  EnergyLedger energy;

  /// F_L / F_N [-]; 0 without contact.
  double traction() const { return vertical_force > 0 ? longitudinal_force / vertical_force : 0.0; }
};

}  // namespace tread
