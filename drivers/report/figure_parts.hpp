#pragma once
// Parts that the charts of a run share.

#include <string>
#include <vector>

#include "core/corrugation.hpp"
#include "core/running_surface.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/results/run_results.hpp"
#include "io/report/report.hpp"

namespace tread {

Panel panel(std::string y_label, std::vector<Series> series, std::vector<Marker> levels, double height);

/// Bands and fastenings that every chart over the way shows within `range`.
void mark_track(const Scene& scene, const Corrugation& corrugation, const Range& range, Figure& figure);

/// The values times a factor, as a figure shows them.
std::vector<double> scaled(std::vector<double> values, double factor);

/// Depths of both running surfaces, and the line across on which a figure shows them.
struct ShownSurfaces {
  Corrugation corrugation;
  RunningSurface rail{};  ///< besides the corrugation
  RunningSurface wheel{};
  double y = 0;  ///< [m]
};
ShownSurfaces shown_surfaces(const Model& model, double y);

/// Heights of the rail's surface and of that part of the wheel's that meets it [mm]; smooth ones are left
/// out.
std::vector<Series> running_surfaces(const ShownSurfaces& surfaces, const Range& range);

/// Adds a panel of them over the figure's x_range [m], if there are any.
void add_surface_panel(const ShownSurfaces& surfaces, double height, Figure& figure);

/// The corrugation, or the solution zone of a smooth rail, as far as the way goes [m].
Range stretch_in_sight(const Scene& scene, const Corrugation& corrugation, const Range& way);
/// The same, or the whole way where that lies elsewhere.
Range stretch_in_sight(const Model& model, const Range& way);

/// Friction on the side of a mean F_L [N]: f, or -f under brakes beyond a hundredth of f times the load [-].
double signed_friction(double f, double longitudinal_force, double load);

/// Returns true for a run whose charts are over time: without a rolling wheel.
bool over_time(const Model& model);

/// Abscissae of a run's charts, by sample: the wheel's position [m], or the time where over_time() [ms].
std::vector<double> abscissae_of(const Model& model, const RunResults& results);

/// Least and largest place or time of a run; brakes may turn the wheel back.
Range whole_way(const Model& model, const RunResults& results);

/// A figure over the wheel's positions in `range` [m], without panels.
Figure over_the_rail(std::string name, std::string title, const Scene& scene, const Corrugation& corrugation,
                     const Range& range);

/// A figure of that name over the whole way, without panels.
Figure over_the_way(std::string name, std::string title, const Model& model, const RunResults& results);

}  // namespace tread
