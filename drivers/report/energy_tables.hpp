#pragma once
// Energy and momentum in a run's report.

#include <string>

#include "drivers/engine/model/model.hpp"
#include "drivers/results/run_results.hpp"
#include "io/report/report.hpp"

namespace tread {

/// States the energy error and the sum that it is relative to. [theory.md, eq. 14]
std::string energy_error_text(const Model& model, const RunResults& results);

/// Energy of deformation by body, at the end of the run or in the static state, and its hourglass part.
Table body_energy_table(const Model& model, const RunResults& results);

/// Impulses of all forces beside the change of momentum; `error`: relative.
Table momentum_table(const MomentumCheck& momentum, double error);

}  // namespace tread
