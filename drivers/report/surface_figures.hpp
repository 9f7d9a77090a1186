#pragma once
// The rail's surface and the moving patch in a run's report.

#include "drivers/engine/model/model.hpp"
#include "drivers/results/run_results.hpp"
#include "io/report/report.hpp"

namespace tread {

/// Largest stresses and frictional work along the patch's longitudinal axis. [paper, Figs. 12 and 19]
Figure surface_figure(const Model& model, const RunResults& results);

/// Pressure and surface shear stress on the axis at the results' instants. [paper, Fig. 16]
Figure snapshots_figure(const Model& model, const RunResults& results);

/// Where the patch sticks and slips at these instants.
Drawings stick_slip_drawings(const Model& model, const RunResults& results);

/// The patch along the evaluated stretch: pressure, shear stress and slip speed, frame by frame.
/// [paper, Figs. 16 and 17]
PatchMovie patch_movie(const Model& model, const RunResults& results);

}  // namespace tread
