#pragma once
// The multi-body approach: a wheel as a mass on a Hertz spring over a modal rail on its fastenings, in the
// time domain. [theory.md, Multi-body approach]

#include <vector>

#include "drivers/engine/beam/beam_passage.hpp"
#include "drivers/studies/multibody/modal_track.hpp"
#include "drivers/studies/multibody/modal_wheel.hpp"
#include "drivers/studies/multibody/sine_contact.hpp"

namespace tread {

/// The passage by Zhai's explicit two-step method with psi = phi = 1/2: central difference without damping,
/// second order with dampers, one evaluation of the forces per step. [theory.md, eq. M4] A copy goes on by
/// itself over the same track, so that runs with a common beginning share it.
class ModalPassage {
 public:
  /// Starts in equilibrium at x, at rest. The vehicle does not bend (no BeamVehicle::bending); the modes and
  /// the flexibility of `wheel` move the contact besides its mass.
  ModalPassage(const ModalTrack& track, const BeamVehicle& vehicle, double x, double dt,
               const ModalWheel& wheel = {});

  /// Does one step, after which the wheel is at x over `roughness` [m] (positive: the rail is lower). Throws
  /// NumericalError if the step is not stable.
  void step(double x, double roughness = 0, const ContactRelief& relief = {});

  double time() const { return time_; }
  double dt() const { return dt_; }
  double force() const { return force_; }    ///< F_N [N]
  double rail() const { return rail_; }      ///< deflection of the rail under the wheel [m]
  double wheel() const { return wheel_.z; }  ///< deflection of the wheel, downwards [m]
  double sprung() const { return sprung_.z; }

 private:
  struct Mass {
    double z = 0, rate = 0, acceleration = 0, before = 0;  ///< downwards [m], [m/s], [m/s2]
    void move(double dt, double blend);
  };
  void accelerate(double x, double roughness, const ContactRelief& relief);
  double flexibility(double x) const { return track_->flexibility(x) + modal_wheel_.flexibility; }

  const ModalTrack* track_;
  BeamVehicle vehicle_;
  double dt_;
  std::vector<double> state_, rate_, acceleration_, before_;  ///< by coordinate; before_: of the last step
  std::vector<double> shape_, scratch_;
  Mass wheel_, sprung_;
  double rest_ = 0;  ///< deflection of the wheel at the start [m]
  ModalWheel modal_wheel_;
  std::vector<Mass> waves_;  ///< a wave and its companion for each mode, upwards [m sqrt(kg)]
  bool first_ = true;
  double time_ = 0, force_ = 0, rail_ = 0;
};

/// Half the step [s] at which track and vehicle together become unstable, by estimates.
double passage_step(const ModalTrack& track, const BeamVehicle& vehicle, const ModalWheel& wheel = {});

}  // namespace tread
