#pragma once
// Charts of a blow on the rail head.

#include "drivers/results/run_results.hpp"
#include "io/report/report.hpp"

namespace tread {

/// Force and displacement of the struck point against time.
Figure blow_figure(const RunResults& results);

/// Amplitude of the struck point's receptance, as far as the blow reaches.
Figure receptance_figure(const Scene& scene, const RunResults& results);

}  // namespace tread
