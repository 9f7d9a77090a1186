#pragma once
// Charts and drawings of a run's report.

#include "drivers/engine/model/model.hpp"
#include "drivers/results/run_results.hpp"
#include "io/report/report.hpp"

namespace tread {

/// F_L and f F_N, under brakes -f F_N, over the corrugation (smooth rail: over the solution zone) with the
/// running surface below. [paper, Fig. 15]
Figure force_figure(const Model& model, const RunResults& results);

/// Forces, traction and torque over the whole way.
Figure passage_figure(const Model& model, const RunResults& results);

/// Creepage at a node and mean of 28, or by the spin of a guided bore's carrier. [paper, Fig. 18]
Figure creepage_figure(const Model& model, const RunResults& results, const std::vector<Marker>& levels);

/// Area, slip area, pressure, shear stress and penetration.
Figure patch_figure(const Model& model, const RunResults& results);

/// Change of each kind of energy since the start, and what the balance misses.
Figure energy_figure(const Model& model, const RunResults& results);

/// Cross-sections and side views of the undeformed mesh, the wheel just touching the rail.
Drawings section_drawings(const Model& model);
Drawings side_drawings(const Model& model);

}  // namespace tread
