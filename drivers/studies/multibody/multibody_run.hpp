#pragma once
// A passage of the multi-body model and its results.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/math/statistics.hpp"
#include "drivers/studies/multibody/multibody_model.hpp"

namespace tread {

/// One instant of a passage.
struct MultibodySample {
  double time = 0;       ///< [s]
  double x = 0;          ///< place of the wheel [m]
  double force = 0;      ///< F_N [N]
  double wheel = 0;      ///< deflection of the wheel, downwards [m]
  double rail = 0;       ///< deflection under the wheel [m]
  double sprung = 0;     ///< deflection of the sprung mass [m]
  double roughness = 0;  ///< depth that the wheel follows [m]
};

/// Largest F_N about a crest of the corrugation.
struct CrestPeak {
  double crest = 0;  ///< x of the crest [m]
  double peak = 0;   ///< x of the peak [m]
  double force = 0;  ///< largest sample [N]
  double shift = 0;  ///< lead before the crest, a wavelength being 2 pi [rad]
};

struct MultibodyStep {
  std::optional<int> modes;    ///< number of modes; absent: those of modal_track()
  std::optional<double> step;  ///< step [s]; absent: half the stable step, at most 1/40 of a wave's passing
};

struct MultibodyResult {
  std::vector<MultibodySample> samples;  ///< samples of every step over all that is evaluated
  double dt = 0;                         ///< [s]
  int modes = 0;
  std::int64_t steps = 0;
  double static_rail = 0;  ///< deflection of the rail under the wheel at rest at the scene's start [m]
  double evaluated_first = 0, evaluated_last = 0;  ///< evaluated stretch of `force` [m]
  Statistics force;                                ///< [N]
  double loss_of_contact = 0;                      ///< share of the stretch without contact [-]
  /// Half the range of F_N over the last fastening span before the corrugation [N]; absent where the wheel
  /// starts within that span or surfaces lift or lower it there.
  std::optional<double> passing;
  std::vector<CrestPeak> peaks;       ///< peaks of a sine's crests between its first and its last
  std::vector<std::string> warnings;  ///< sentences on waves and forces beyond the model's range
};

/// Runs a passage. Throws InputError if a stated step is far beyond any stable one, and NumericalError if the
/// step turns out to be unstable.
MultibodyResult run_multibody(const MultibodyModel& model, const MultibodyStep& step);

/// Largest forces about the crests of a sine: `force` [N] at `x` [m], both by ascending x. A peak stands
/// where the least-squares parabola of the samples within 5 % of their range is largest. A crest is left out
/// unless the curve covers half a wave on both sides.
std::vector<CrestPeak> crest_peaks(const Corrugation& corrugation, double wavelength,
                                   const std::vector<double>& x, const std::vector<double>& force);

/// Mean direction of the shifts over the crests, -pi to pi [rad]; 0 without any.
double mean_shift(const std::vector<CrestPeak>& peaks);

/// Step of a passage [s] at a speed [m/s]: half the stable step, at most 1/40 of the passing of the shortest
/// wave of corrugation and surfaces: of measured depths 20 mean pitches, of a dip, dent or flat its length.
/// [theory.md, eq. M4]
double chosen_step(const ModalTrack& track, const MultibodyModel& model, double speed);

/// Rolls over the model's surfaces on to x = `to` and calls visit(x, roughness) after every step. The wheel
/// started at `start`.
template <class Visit>
void roll(ModalPassage& passage, const MultibodyModel& model, double speed, double to, const Visit& visit) {
  for (;;) {
    const double x = model.start + speed * (passage.time() + passage.dt());
    if (x > to) return;
    const double depth = model.roughness(x);
    passage.step(x, depth, model.relief(x));
    visit(x, depth);
  }
}

}  // namespace tread
