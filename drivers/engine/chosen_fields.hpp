#pragma once
// The fields of a run in the scene's precision, on the chosen device or ranks.

#include <memory>

#include "drivers/engine/fields/node_fields.hpp"

namespace tread {

/// Throws InputError if the scene has a body from a file, whose steps are those of one process; `of_others`:
/// what asks for others, such as "mpirun".
void require_no_bodies(const Scene& scene, const char* of_others);

/// The same where a device or ranks are chosen.
void require_steps_of_bodies(const Scene& scene);

/// At rest, undeformed. Keeps a reference to the model, whose coefficients must stay what they are. Throws as
/// require_steps_of_bodies() does.
std::unique_ptr<NodeFields> make_node_fields(const Model& model);

}  // namespace tread
