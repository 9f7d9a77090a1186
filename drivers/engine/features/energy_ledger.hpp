#pragma once
// The energy balance of a run. [theory.md, Energy stop]

namespace tread {

/// Energies and works by kind [J]; `residual` closes the balance.
struct EnergyLedger {
  double kinetic = 0;
  double strain = 0;      ///< stored by laws and hourglass stiffness, all bodies, and springs of branches
  double connectors = 0;  ///< springs of fastenings and suspension
  double penalty = 0;     ///< stored in contact
  double gravity = 0;     ///< potential
  double frictional_work = 0;  ///< dissipated
  double connector_loss = 0;   ///< dissipated in dampers of fastenings and suspension
  double damping_loss = 0;     ///< lost because contact forces lead the motion
  double material_loss = 0;    ///< dissipated in Maxwell branches
  double plastic_work = 0;     ///< dissipated by material laws with a state
  double torque_work = 0;      ///< done by the torque
  double guide_work = 0;       ///< done by the guide that holds the bore's forward speed
  double hammer_work = 0;      ///< done by the hammer
  double residual = 0;         ///< total() less that at the start

  /// Stored and dissipated energy less the work of torque, guide and hammer: constant [J].
  double total() const {
    return kinetic + strain + connectors + penalty + gravity + frictional_work + connector_loss +
           damping_loss + material_loss + plastic_work - torque_work - guide_work - hammer_work;
  }
};

}  // namespace tread
