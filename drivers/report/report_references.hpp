#pragma once
// Numbers from the literature that a run can be held against, where its scene is the one that they belong to.

#include <vector>

#include "drivers/engine/model.hpp"
#include "drivers/results/run_results.hpp"
#include "io/report/report.hpp"

namespace tread {

/// Figures that the paper states for this scene; empty if it states none.
std::vector<Comparison> paper_comparisons(const Model& model, const RunResults& results);

/// Hertz for the static patch; CONTACT for steady rolling where its case is this one. Empty without contact.
std::vector<Comparison> theory_comparisons(const Model& model, const RunResults& results);

/// Creepage that the paper states for the smooth rail under this speed, friction and traction [-]; 0 if it
/// does not.
double paper_creepage(const Scene& scene);

}  // namespace tread
