#pragma once
// The contact spring of the multi-body model fitted to a transient run. [paper, section 4.6]

#include <filesystem>
#include <vector>

#include "drivers/studies/multibody/multibody_run.hpp"

namespace tread {

/// F_N of a run, and the scene that it was run with.
struct TransientRun {
  std::filesystem::path directory;
  Scene scene;
  std::vector<double> time;   ///< [s]
  std::vector<double> x;      ///< of the wheel, growing [m]
  std::vector<double> force;  ///< F_N [N]

  /// Mean over the samples within [first, last]: traction has made the wheel faster than motion.speed. 0 with
  /// fewer than two of them. [m/s]
  double speed_between(double first, double last) const;
};

/// From histories.csv and scene.resolved.toml of a run's directory. InputError where they are missing or
/// broken.
TransientRun read_transient_run(const std::filesystem::path& directory);

/// How a curve of F_N compares with the run's over the evaluated stretch.
struct CurveFit {
  std::vector<double> values;  ///< F_N at Calibration::x [N]
  Statistics force;            ///< [N]
  double shift = 0;            ///< mean over the crests, before them [rad]
  double misfit = 0;           ///< root mean square of the difference from the run [N]
};

struct Calibration {
  double contact = 0;                    ///< fitted C of F = C approach^1.5 [N/m^1.5]
  bool at_bound = false;                 ///< the best C is the softest or stiffest tried
  double first = 0, last = 0;            ///< the stretch that both cover [m]
  double speed = 0;                      ///< of the run there, at which the model rolls [m/s]
  std::vector<double> x;                 ///< the run's samples there [m]
  CurveFit run;                          ///< the run itself
  CurveFit before, after;                ///< with the scene's own C and with the fitted one
  std::vector<double> factors, misfits;  ///< C tried over the scene's, growing, and their misfits [N]
};

/// The C between a twentieth and the triple of the scene's with the least misfit. The model rolls
/// as fast as the run does on the stretch. InputError where the run's scene makes another model or the run
/// ends before a wave is past.
Calibration calibrate(const MultibodyModel& model, const TransientRun& run, const MultibodyStep& step);

}  // namespace tread
