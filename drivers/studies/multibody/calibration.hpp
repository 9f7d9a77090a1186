#pragma once
// The contact spring of the multi-body model fitted to a transient run. [paper, section 4.6]

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/studies/multibody/multibody_run.hpp"

namespace tread {

/// A contact force of a run, F_N, and the scene of that run.
struct TransientRun {
  std::filesystem::path directory;
  Scene scene;
  std::string changed;        ///< sentence on a file of the scene that has changed since; empty: none
  std::string unfinished;     ///< sentence on a run that is not done, with its way on; empty: it is done
  std::vector<double> time;   ///< [s]
  std::vector<double> x;      ///< ascending places of the wheel [m]
  std::vector<double> force;  ///< F_N, or the force that was asked for [N]

  /// Mean speed over the samples within [first, last] [m/s]. Traction has made the wheel faster than
  /// motion.speed. 0 with fewer than two samples.
  double speed_between(double first, double last) const;
  /// Way out where the run does not roll as far as needed.
  std::string further() const;
};

/// Reads histories.csv and scene.resolved.toml of a run's directory; `force`: column of the force [N]. Throws
/// InputError if they are missing or broken.
TransientRun read_transient_run(const std::filesystem::path& directory,
                                const std::string& force = "vertical_force");

/// Throws InputError where a file of the run's scene has changed since. `option`: the option and the run's
/// directory, with which the message begins.
void require_same_files(const TransientRun& run, const std::string& option);

/// Throws InputError where the run's samples on a stretch are too far apart to show waves of this length [m].
/// `option` as in require_same_files().
void require_samples(const TransientRun& run, const std::string& option, const Span& stretch, double wave);

/// Comparison of a curve of F_N with the run's over the evaluated stretch.
struct CurveFit {
  std::vector<double> values;  ///< F_N at Calibration::x [N]
  Statistics force;            ///< [N]
  double shift = 0;            ///< mean lead of the peaks before the crests that the run covers [rad]
  double misfit = 0;           ///< root mean square of the difference from the run [N]
};

struct Calibration {
  double contact = 0;                    ///< fitted C of F = C approach^1.5 [N/m^1.5]
  bool at_bound = false;                 ///< true if the best C is the softest or stiffest tried
  double first = 0, last = 0;            ///< the stretch that both cover [m]
  double speed = 0;                      ///< speed of the run on the stretch, at which the model rolls [m/s]
  std::vector<double> x;                 ///< places of the run's samples on the stretch [m]
  CurveFit run;                          ///< fit of the run itself
  CurveFit before, after;                ///< fits with the scene's own C and with the fitted one
  std::vector<double> factors, misfits;  ///< tried C over the scene's, ascending, and their misfits [N]
};

/// Fits C: the value between a twentieth and the triple of the scene's with the least misfit. The model rolls
/// as fast as the run does on the stretch. Throws InputError if the run's scene makes another model, if the
/// run ends before a wave is past, and as require_same_files() and require_samples().
Calibration calibrate(const MultibodyModel& model, const TransientRun& run, const MultibodyStep& step);

}  // namespace tread
