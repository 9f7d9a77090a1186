#pragma once
// The patch at single instants of a passage: which ones, and pressure and shear stress on its longitudinal
// axis then. [paper, Fig. 16]

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene.hpp"
#include "drivers/engine/model/station_plan.hpp"
#include "drivers/report/figure_parts.hpp"
#include "drivers/results/patch_file.hpp"
#include "io/report/report.hpp"

namespace tread {

/// Places spread evenly over the stretch, each in the middle of its part [m].
std::vector<double> even_places(const Span& stretch, int count);

/// Where the wheel is at t1 to t10 of a passage over waves [m]: the pressure is least at t4, of the stretch
/// with a wave before it and two behind, largest at t1 and t7 within the waves before and behind t4, and
/// least again at t10 within the wave behind t7; the others part the ways between evenly. Ten even places of
/// the last wave where the stretch is shorter than that. `x`: place of the wheel by sample [m], increasing;
/// `pressure`: largest in the patch then [Pa].
std::vector<double> typical_places(const Span& stretch, double wavelength, const std::vector<double>& x,
                                   const std::vector<double>& pressure);

/// The same for a scene: even places of the last `smooth_way` [m] where it has no waves.
std::vector<double> typical_places(const Scene& scene, const Span& stretch, double smooth_way,
                                   const std::vector<double>& x, const std::vector<double>& pressure);

/// Samples of the patch and what their figure needs beside them.
struct PatchSnapshots {
  PatchAxes axes;
  int axis_row = 0;     ///< the patch's longitudinal axis, of axes.y
  ContactSpec contact;  ///< of the scene
  ShownSurfaces surfaces;
  std::vector<PatchSample> samples;
};

/// "t1" for the first.
std::string instant_name(std::size_t instant);

/// Pressure and surface shear stress along the rail; PatchSnapshots must hold a sample.
Figure snapshots_figure(const PatchSnapshots& instants);

/// A row per instant and node of the axis about the patch.
std::string snapshots_csv(const PatchSnapshots& instants);

}  // namespace tread
