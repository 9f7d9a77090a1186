#pragma once
// A tyre that rolls on a block, and its observed values.

#include <vector>

#include "drivers/engine/simulation.hpp"
#include "drivers/results/surface_results.hpp"
#include "drivers/verify/tyre_on_block.hpp"

namespace tread {

/// A point of the patch at the last step.
struct PatchPoint {
  double x = 0, y = 0;             ///< distance from the wheel's axis, along and across [m]
  double pressure = 0, shear = 0;  ///< pressure, and shear on the wheel, forwards [Pa]
};

/// Values of the finite elements over the observed stretch.
struct Rolled {
  double force = 0;            ///< mean F_L [N]
  double normal_force = 0;     ///< mean F_N [N]
  double force_deviation = 0;  ///< standard deviation of F_L / mean [-]
  double creepage = 0;         ///< mean creepage of 28 nodes, contains that of free rolling [-]
  double work_creepage = 0;    ///< of the frictional work, eq. (13a) [-]
  double slip_fraction = 0;    ///< [-]
  double lead_loss = 0;        ///< loss by the lead of the contact forces, over the frictional work [-]
  double energy_residual = 0;  ///< residual of the energy over the frictional work [-]
  SurfaceResults surface;
  Statistics shear;  ///< nodes' largest shear on the axis [Pa]
  double work = 0;   ///< frictional work on the axis [J/m2]
  std::vector<Sample> samples;
  std::vector<PatchPoint> patch;
  std::vector<PatchPoint> nodes;  ///< nodes in contact, averages of the row of the largest pressure
};

/// Runs the scene of the bodies. `observed`: length of the last, observed part [m].
Rolled roll_tyre(const TyreOnBlock& bodies, double observed, const ProgressText& progress);

/// Mean creepage of 28 nodes without torque [-], over the last `observed` [m] of the distance `way` [m] at
/// `speed` [m/s]. The spin at the start is up to 0.006 % off that of free rolling.
double free_creepage(TyreOnBlock bodies, double speed, double way, double observed,
                     const ProgressText& progress);

/// Creepage (mean of 28 nodes, less `free` [-]) and traction over the distance, with the creepage's
/// `reference` [-] as a line.
Figure creepage_figure(const Rolled& rolled, double free, double reference);

}  // namespace tread
