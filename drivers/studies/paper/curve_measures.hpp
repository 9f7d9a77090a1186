#pragma once
// Relations of curves over a corrugation with the corrugation and with one another.

#include <optional>
#include <vector>

#include "drivers/studies/multibody/multibody_run.hpp"
#include "drivers/studies/study/finished_run.hpp"

namespace tread {

/// A curve's first two harmonics over whole waves.
struct WavePattern {
  double share = 0;  ///< share of the curve's variance in these harmonics [-]
  double shift = 0;  ///< lead of the first harmonic's peak before a crest, a wavelength being 2 pi [rad]

  /// Returns true if the first harmonic is larger at crests than at troughs.
  bool larger_at_crests() const;
};

/// Pattern over the stretch on which the run is evaluated; nullopt if the run has no sine or the curve does
/// not cover the stretch.
std::optional<WavePattern> wave_pattern(const FinishedRun& run, const CurvePoints& curve);

/// Returns true if the run has come to the end of its sine.
bool has_passed(const FinishedRun& run);

/// Correlation of two curves over the evaluated stretch.
std::optional<double> correlation(const FinishedRun& run, const CurvePoints& a, const CurvePoints& b);

/// Peaks of F_N about the crests of the run's sine; empty if there is none.
std::vector<CrestPeak> vertical_peaks(const FinishedRun& run);

/// Mean of the peaks nearer to a fastening than to mid-span less that of the others, over the static load
/// [-]; nullopt if one kind is missing.
std::optional<double> fastening_effect(const FinishedRun& run);

/// Delay after T1 [s] until the mean of F_L over 1 ms first reaches 98 % of F_L's mean from `steady_from` [s]
/// on; nullopt if the run ends earlier.
std::optional<double> longitudinal_delay(const FinishedRun& run, double steady_from);

/// Largest difference of F_N from the static load behind x [m], over that load [-].
std::optional<double> residual_oscillation(const FinishedRun& run, double x);

/// Way between both ends of the corrugation, evaluated or not, on which a curve of F_N is zero [m].
double way_without_contact(const FinishedRun& run, const CurvePoints& force);

/// Largest difference of the runs' F_N from `time` [s] on, over the static load [-].
std::optional<double> vertical_difference(const FinishedRun& a, const FinishedRun& b, double time);

/// Steady creepage of the summary [%]; nullopt if the torque still changes or has just changed over its
/// stretch.
std::optional<double> steady_creepage(const FinishedRun& run);

/// Largest mean creepage of the tread's points over the evaluated stretch, over steady_creepage() [-];
/// nullopt without a positive one, or if the run has not come to a crest.
std::optional<double> mean_creepage_ratio(const FinishedRun& run);

/// The same at N_cr, the point that starts in the patch. Places within one length of Hertz's patch of its
/// whole turns do not count: there the point itself sticks and slips in the patch, on a smooth rail, too.
std::optional<double> node_creepage_ratio(const FinishedRun& run);

/// F_N of the multi-body approach over the way, SI.
CurvePoints force_over_way(const MultibodyResult& result);

/// Curves of the histories and of the axis, SI; over the way, the first_passage().
CurvePoints history_over_way(const FinishedRun& run, const char* column, const char* unit);
CurvePoints history_over_time(const FinishedRun& run, const char* column, const char* unit);
CurvePoints along_axis(const FinishedRun& run, const char* column, const char* unit);

}  // namespace tread
