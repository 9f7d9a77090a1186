#pragma once
// Distances of the curves of one passage from those of another. [docs/records/dial.md, Definitions]

#include <optional>
#include <string>
#include <vector>

#include "drivers/engine/model/station_plan.hpp"
#include "drivers/studies/study/finished_run.hpp"

namespace tread {

/// A quantity that passages are compared in: its curve along the rail.
struct DialQuantity {
  std::string name;   ///< in options and files, "F_N", "von_mises"
  std::string title;  ///< for readers
  RunCurve curve;
  bool of_traction = false;  ///< noise where the wheel rolls without traction
  bool prescribed = false;   ///< its mean is: by the static load or the traction
};

/// F_N, F_L, creepage, largest pressure and shear over the wheel's way; Von Mises stress and frictional work
/// on the patch's axis over the rail.
const std::vector<DialQuantity>& dial_quantities();

/// A curve beside a reference. All but the shift are relative.
struct CurveDifference {
  double error = 0;             ///< quadratic mean of what differs once the shift is taken out [-]
  double mean = 0;              ///< of the curve less that of the reference [-]
  std::optional<double> range;  ///< of the curve over that of the reference, less one [-]
  std::optional<double>
      shift;  ///< of the curve, further along the rail than the reference [m]; absent: no pattern
  std::optional<double> fluctuation = {};  ///< error over the reference's deviation [-]; absent: not judged
};

/// Over `stretch`, as far as both curves have it with `longest_shift` [m] to either side. `error` and `mean`
/// are relative to the reference's quadratic mean, `range` to its range, `fluctuation` to its deviation; a
/// shift is found where the shifted curve correlates by more than a half with the reference, short of the
/// longest. Nothing where less than half of the stretch is left, or the reference is zero.
std::optional<CurveDifference> curve_difference(const CurvePoints& curve, const CurvePoints& reference,
                                                const Span& stretch, double longest_shift);

/// In this quantity, with the fluctuation of F_N and F_L over depths alone, over the stretch on which the
/// reference is evaluated; the longest shift is a quarter of its corrugation's wave; on other rails 20 mm, or
/// a tenth of the way if that is less. Nothing as above, where a run has no such curve, or of F_L and
/// creepage where the reference's F_L is below 0.005 of its static F_N.
std::optional<CurveDifference> run_difference(const FinishedRun& run, const FinishedRun& reference,
                                              const DialQuantity& quantity);

}  // namespace tread
