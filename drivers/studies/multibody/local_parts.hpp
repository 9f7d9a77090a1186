#pragma once
// Parts of the multi-body model from the scene's own finite elements, without any fitted number.
// [theory.md, Multi-body approach]

#include "drivers/studies/multibody/multibody_model.hpp"

namespace tread {

/// The rail becomes the solid of its section, which a model of BeamTheory::solid needs.
void use_solid_rail(MultibodyModel& model);

/// The wheelset bends and vibrates by its modes.
void use_modal_wheel(MultibodyModel& model);

/// The wheel touches a sine as half-spaces do, with its patch. Throws InputError without a sine.
void use_half_space_contact(MultibodyModel& model);

}  // namespace tread
