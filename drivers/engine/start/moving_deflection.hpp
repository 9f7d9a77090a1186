#pragma once
// A static deflection that moves along with the wheel. [theory.md, Start]

#include "core/aligned.hpp"
#include "core/body_frame.hpp"
#include "drivers/engine/model/model.hpp"

namespace tread {

/// Fields and frame of a run that begins.
struct StartFields {
  AlignedVector<double>& displacement;  ///< [m]
  AlignedVector<double>& velocity;      ///< [m/s]
  BodyFrame& wheel;
};

/// Sets the velocities of a deflection that stays under the wheel at a speed [m/s] and the frame's spin.
void move_deflection(const Model& model, double speed, const StartFields& fields);

/// Spin that the wheel needs besides its frame's so that the patch found last does not slip as a whole
/// [rad/s].
double free_spin(const Model& model, const StartFields& fields);

/// The same for a static state that moves along at a speed [m/s].
double free_spin(const Model& model, const AlignedVector<double>& displacement, BodyFrame wheel,
                 double speed);

}  // namespace tread
