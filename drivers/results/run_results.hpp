#pragma once
// Results of a run: histories and summary.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/math/statistics.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/results/force_spectrum.hpp"
#include "drivers/results/measured_rows.hpp"
#include "drivers/results/patch_file.hpp"
#include "drivers/results/surface_results.hpp"
#include "io/files/history_file.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// Channels of the histories and a sample's row in their order.
std::vector<Channel> history_channels(const Model& model);
std::vector<double> history_row(const Model& model, const Sample& sample);

/// Number of steps of a run with step `dt` [s]. InputError above 1e15.
std::int64_t step_count(const Scene& scene, double dt);
/// Steps between samples. InputError above 1e15.
std::int64_t sampling_interval(const Scene& scene, double dt);

/// Origin of a run that begins with another run's state.
struct ForkOrigin {
  std::string folder;  ///< of the other run
  double time = 0;     ///< of the state [s]
  std::int64_t steps = 0;
};

/// Everything that summary.json and the report state, in SI.
struct RunResults {
  Preload preload;
  StepLimit limit;
  std::vector<Sample> samples;
  MeasuredRows measured;  ///< as many rows as there are samples, or no columns
  std::int64_t steps = 0;
  std::optional<ForkOrigin> origin;  ///< of a fork; its times count from there
  double dt = 0;
  double seconds_mesh = 0, seconds_preload = 0, seconds_rolling = 0;
  std::int64_t preload_cached = 0;  ///< 1: an earlier run had found it
  std::uint64_t state_hash = 0;
  MomentumCheck momentum;
  std::vector<DeformationEnergy> part_energy;   ///< at the end, by part of the mesh [J]
  std::optional<SurfaceFields> surface_fields;  ///< none without contact
  SurfaceResults surface;                       ///< from surface_fields
  std::optional<RailLine> rail_line;            ///< none without contact
  std::vector<PatchSample> instants;            ///< of patch.h5, for the report
  std::vector<PatchSample> movie;               ///< the same along the evaluated stretch

  /// Largest F_N over the evaluated stretch by the static wheel load [-]; 0 without load.
  double dynamic_factor() const {
    const double load = -preload.contact.force_on_rail.z;
    return load > 0 ? vertical_force.max / load : 0;
  }
  /// Steps that this run took itself.
  std::int64_t own_steps() const { return steps - (origin ? origin->steps : 0); }

  /// Lists the values that a resumed run cannot compute again, without the samples.
  void list_state(StateList& list) {
    list.add_part("preload", preload);
    list.add("stable_step", limit.stable_step);
    list.add("dt", dt);
    list.add("seconds_mesh", seconds_mesh);
    list.add("seconds_preload", seconds_preload);
    list.add("seconds_rolling", seconds_rolling);
    list.add("preload_cached", preload_cached);
  }

  Statistics vertical_force;        ///< over evaluated() [N]
  ForceSpectrum spectrum;           ///< of F_N there
  std::vector<ForceSine> ripples;   ///< of F_N there, as the rail's elements and those before them pass
  std::optional<ForceSine> wave;    ///< of F_N there, at a sine of the rail
  Statistics longitudinal_force;    ///< [N]
  Statistics lateral_force;         ///< [N]
  Statistics lateral_creepage;      ///< [-]
  Statistics spin_creepage;         ///< [1/m]
  double traction_coefficient = 0;  ///< mean F_L / mean F_N over the steady stretch [-]
  /// Value of it that the settled torque of motion.traction gives under the static load [-]; nothing without.
  std::optional<double> traction_target;
  /// Traction of its second half less that of its first [-]; nothing where a half holds no sample.
  std::optional<double> traction_drift;
  double creepage = 0;                     ///< mean of 28 points of the tread there [-]
  std::optional<double> creepage_of_work;  ///< of the frictional work there, if F_L counts [-]
  double creepage_max = 0;  ///< mean of 28 points, the largest in size over the stretch of vertical_force [-]
  double full_slip_share = 0;    ///< of the samples in contact there, those whose whole patch slides [-]
  double steady_slip_share = 0;  ///< the same, of the steady stretch [-]
  double max_pressure = 0, max_shear = 0, patch_area = 0;  ///< mean of the samples there [Pa], [Pa], [m2]
  double vertical_force_steady = 0;                        ///< mean there [N]
  double reached = 0;                                      ///< foremost place of the wheel [m]
  bool driven = false;                                     ///< by a torque of motion.traction
  double energy_error = 0;          ///< largest residual over what was dissipated or stored, eq. (14) [-]
  double energy_error_of_work = 0;  ///< the same over the frictional work alone; 0 without any [-]
  double momentum_error = 0;        ///< [-]
  double evaluated_first = 0, evaluated_last = 0;  ///< the stretch of vertical_force [m]
  std::int64_t evaluated_samples = 0;              ///< within it
  bool passed = false;                             ///< the wheel has come to the end that it should have
  double steady_first = 0, steady_last = 0;        ///< the stretch of the steady values [m]
  std::int64_t steady_samples = 0;                 ///< within it
  double steady_begin = 0;                         ///< time of the first of them [s]
  std::vector<std::string> warnings;               ///< sentences for the user (run_warnings.hpp)
  double frictional_work_decrease = 0;             ///< largest fall between two samples, 0 when monotone [J]
};

/// Fills the figures from the samples.
void evaluate(const Model& model, RunResults& results);

/// F_L / F_N below which a wheel rolls freely. [theory.md, eq. 13a]
inline constexpr double kSmallTraction = 0.005;

/// Creepage of the frictional work between two places of the wheel [m], as it first rolls ahead from one
/// to the other: work over the mean of F_L, per way of the mean of rim and forward speed. `radius`: of the
/// rim [m].
/// Nothing without way, or where F_L is too small against F_N. [theory.md, eq. 13a]
std::optional<double> creepage_of_work(const std::vector<Sample>& samples, double first, double last,
                                       double radius);

/// Returns true if the whole patch slides in most samples of the steady stretch, of a driven wheel or under
/// more than kSmallTraction.
bool traction_slides(const RunResults& results);

/// Place from which a torque without a ramp counts as settled that the static state does not carry: as far
/// from the start as the steady stretch is long [m]. Nothing for other torques.
std::optional<double> settling_place(const Scene& scene, const RunResults& results);

/// Returns true if the torque of a scene with [motion] no longer rises, nor has just risen, at the first
/// sample of the steady stretch. That of a wheel that stands is the whole run, which holds the rise.
bool torque_has_settled(const Scene& scene, const RunResults& results);

/// Returns true if the means of F_L / F_N over both halves of the steady stretch agree within 5 %, or within
/// 0.005 where the traction is small, the patch does not slide and the torque of a driven wheel has settled.
bool traction_is_steady(const Scene& scene, const RunResults& results);

/// Returns true if the traction coefficient is off its target by more than 5 % of it, or 0.005 where it is
/// small.
bool traction_misses(const RunResults& results);

/// Statistics of a measured column over the evaluated stretch, or over the whole run without contact; values
/// that were not measured do not count, and without others all are NaN.
Statistics measured_statistics(const Model& model, const RunResults& results, std::size_t column);

std::string summary_json(const Model& model, const ResolvedScene& scene, const RunResults& results);

}  // namespace tread
