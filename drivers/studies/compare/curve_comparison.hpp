#pragma once
// A curve of a contact force that was measured or comes from another solver, beside a run.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/math/statistics.hpp"
#include "drivers/studies/multibody/calibration.hpp"

namespace tread {

/// The curve as its file holds it.
struct ForceCurve {
  std::string name;           ///< its file
  bool over_time = false;     ///< abscissae are times since the start of rolling
  std::vector<double> at;     ///< growing [m] or [s]
  std::vector<double> force;  ///< [N]
};

/// Reads two columns with a unit line such as "# x [m]  F_N [kN]"; the first may be a time. `force`: "F_N" or
/// "F_L"; a line that names the other one is refused. `offset` is added to the first column: "0.1 m" or
/// "2 ms", or empty. Throws InputError, ProblemsError where lines are bad.
ForceCurve read_force_curve(const std::filesystem::path& path, const std::string& force,
                            const std::string& offset);

struct ComparisonOptions {
  double mean = 0;              ///< way over which both curves are averaged; 0: none [m]
  std::optional<double> first;  ///< places of the wheel between which they are compared [m]
  std::optional<double> last;   ///< [m]
};

/// Run and curve at the places of the run's samples that both cover.
struct CurveComparison {
  std::vector<double> x;           ///< [m]
  std::vector<double> run, curve;  ///< [N]
  Statistics of_run, of_curve;     ///< [N]
  double misfit = 0;               ///< root mean square of the difference [N]
  std::optional<double> correlation;
  /// Mean lead of the peaks before the crests of a sine [rad]; none without crests.
  std::optional<double> run_shift, curve_shift;
};

/// Throws InputError where the run and the curve have too few places in common.
CurveComparison compare(const TransientRun& run, const ForceCurve& curve, const ComparisonOptions& options);

/// Mean of the polygon of `y` over the growing `x`, over `width` about `place`; NaN where that reaches beyond
/// the ends.
double mean_about(const std::vector<double>& x, const std::vector<double>& y, double place, double width);

}  // namespace tread
