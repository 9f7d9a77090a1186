#pragma once
// Loads of the static state: vector fields of 3 * mesh.slots values, added to. [theory.md, Preload]

#include "core/body_frame.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/engine/start/run_in.hpp"

namespace tread {

/// Gravity, centrifugal force of the wheel's spin [rad/s] and vehicle weight; forces on a carrier are left to
/// add_carrier_load().
void add_external_load(const Model& model, const BodyFrame& frame, double spin, double* load);

/// The forces on a carrier, at its unknown, after StaticSystem::reduce.
void add_carrier_load(const Model& model, const BodyFrame& frame, double spin, double* load);

/// The inertia of material that passes through the steady deflection u [m]: at a speed along the track [m/s],
/// at a spin in the wheel [rad/s].
void add_steady_inertia(const Model& model, double speed, double spin, const double* u, double* load);

/// The forces that press on a wheelset which has been rolling.
void add_run_in(const Model& model, const RunIn& run_in, const BodyFrame& frame, double* load);

/// The torque of a wheelset that has been rolling under traction, and the inertia of its vehicle along x.
void add_traction(const Model& model, double traction, const BodyFrame& frame, double* load);

}  // namespace tread
