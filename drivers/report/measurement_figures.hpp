#pragma once
// Figures of a run's report on the values that its scene asks for, and the spectrum of F_N.

#include "drivers/engine/model/model.hpp"
#include "drivers/results/run_results.hpp"
#include "io/report/report.hpp"

namespace tread {

/// Lines and one-third octaves of F_N; without panels where the stretch is too short.
Figure spectrum_figure(const RunResults& results);

/// Chapter of probes, fastenings and stress over depth; without blocks where the scene asks for none.
Chapter measurement_chapter(const Model& model, const RunResults& results);

}  // namespace tread
