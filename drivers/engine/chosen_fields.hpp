#pragma once
// The fields of a run in the scene's precision, on the chosen device or ranks.

#include <memory>

#include "drivers/engine/node_fields.hpp"

namespace tread {

/// At rest, undeformed. Keeps a reference to the model, whose coefficients must stay what they are.
std::unique_ptr<NodeFields> make_node_fields(const Model& model);

}  // namespace tread
