#pragma once
// Tables of a run's report on energy and momentum.

#include "drivers/engine/model.hpp"
#include "drivers/results/run_results.hpp"
#include "io/report/report.hpp"

namespace tread {

/// Energy of deformation by body, at the end of the run or in the static state, and its hourglass part.
Table body_energy_table(const Model& model, const RunResults& results);

/// Impulses of all forces beside the change of momentum; `error`: relative.
Table momentum_table(const MomentumCheck& momentum, double error);

}  // namespace tread
