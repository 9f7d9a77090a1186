#pragma once
// Charts of a blow on the rail head.

#include "drivers/results/run_results.hpp"
#include "io/report/report.hpp"

namespace tread {

/// Force and displacement of the struck point, and its receptance as far as the blow reaches where no wheel
/// rolls over it.
Chapter hammer_chapter(const Model& model, const RunResults& results);

}  // namespace tread
