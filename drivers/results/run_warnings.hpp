#pragma once
// Warnings of a finished run: what its mesh does not resolve, and which of its values are not steady.

#include <string>
#include <vector>

#include "drivers/engine/model/model.hpp"
#include "drivers/results/run_results.hpp"

namespace tread {

/// The warnings of the mesh, and a sentence for each value of the run that is not steady or not sound, with
/// the bound, the consequence and the way out. Empty for a sound run.
std::vector<std::string> run_warnings(const Model& model, const RunResults& results);

/// "; the loss of material.steel.damping, ..." where materials have damping at all frequencies, whose loss
/// the energy balance does not hold, else "". [theory.md, Energy stop]
std::string uncounted_loss(const Model& model);

}  // namespace tread
