#pragma once
// Central difference: velocities and displacements from forces. [theory.md, Time step]

#include "core/body_frame.hpp"
#include "core/mesh/swept_block.hpp"

namespace tread {

struct UpdateFields {
  double* displacement;        ///< [m]
  double* velocity;            ///< at the half step [m/s]
  const double* force;         ///< internal minus external [N]
  const double* inverse_mass;  ///< 0 where nothing moves (unused lanes, secondary nodes) [1/kg]
};

/// v -= dt (f / m + g e_z), u += dt v for an extruded block. `vertical_only`: components 0 and 1 stay zero.
void update_fixed_block(const SweptBlock& block, const UpdateFields& fields, double gravity, double dt,
                        bool vertical_only);

/// The same in a spinning frame: forces, gravity and centrifugal term half before and half after the turn of
/// the relative velocity by the Coriolis term, which does no work.
void update_spinning_block(const SweptBlock& block, const UpdateFields& fields, const BodyFrame& frame,
                           double gravity, double dt);

}  // namespace tread
