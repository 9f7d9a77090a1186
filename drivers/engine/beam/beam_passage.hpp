#pragma once
// A wheel on the beam of a track in the time domain, w positive downwards. [theory.md, Beam on fastenings]

#include <array>
#include <optional>
#include <vector>

#include "drivers/engine/beam/track_beam.hpp"

namespace tread {

/// A wheel in the model of the beam.
struct BeamVehicle {
  double unsprung_mass = 0;  ///< wheelset and what is fixed to it [kg]
  /// Bending of the wheelset by the journal's deflection b beyond the rim's, in the shape of statics; a
  /// rigid wheelset has none. With the rim's deflection w: kinetic energy m w'^2 / 2 + coupling w' b' + mass
  /// b'^2 / 2.
  struct Bending {
    double coupling = 0;   ///< [kg]
    double mass = 0;       ///< [kg]
    double stiffness = 0;  ///< [N/m]
  };
  std::optional<Bending> bending;
  double sprung_mass = 0;  ///< [kg]
  double stiffness = 0;    ///< of the suspension [N/m]
  double damping = 0;      ///< [N s/m]
  double pressed = 0;      ///< further force on the journal, downwards [N]
  double contact = 0;      ///< C of F = C approach^(3/2) [N/m^1.5]
  double gravity = 9.81;   ///< [m/s2]

  double load() const { return (unsprung_mass + sprung_mass) * gravity + pressed; }
  /// Drop of the sprung mass below its place over the journal without load [m].
  double static_stretch() const { return stiffness > 0 ? sprung_mass * gravity / stiffness : 0; }
};

/// The wheel on the beam in the time domain: average acceleration [Newmark 1959], the contact solved within
/// the step.
class BeamPassage {
 public:
  /// In equilibrium at x, at rest.
  BeamPassage(const TrackBeam& beam, const BeamVehicle& vehicle, double x, double dt);

  /// One step; the wheel is then at x over `roughness` (positive: the rail is lower) [m].
  void step(double x, double roughness = 0);

  /// Mass that joins the sprung mass, the suspension already compressed for it: a step of force on the wheel.
  void add_sprung_mass(double mass);

  /// Places the sprung mass `lower` [m] and makes it move `faster` downwards [m/s].
  void move_sprung_mass(double lower, double faster);

  double time() const { return time_; }
  double force() const { return force_; }                       ///< F_N [N]
  double wheel() const { return wheel_[0]; }                    ///< deflection of the rim [m]
  double bending() const { return wheel_[1]; }                  ///< of the journal beyond the rim's [m]
  double rail() const { return rail_; }                         ///< of the rail under the wheel [m]
  double sprung() const { return wheel_[2]; }                   ///< of the sprung mass [m]
  double wheel_speed() const { return wheel_speed_[0]; }        ///< downwards [m/s]
  double bending_speed() const { return wheel_speed_[1]; }      ///< [m/s]
  double sprung_speed() const { return wheel_speed_[2]; }       ///< downwards [m/s]
  double suspension() const;                                    ///< its force on the journal, downwards [N]
  const std::vector<double>& beam_state() const { return u_; }  ///< the beam's unknowns [m], [rad]
  const std::vector<double>& beam_rate() const { return v_; }   ///< their rates [m/s], [rad/s]

 private:
  using Three = std::array<double, 3>;  ///< of rim, bending, sprung mass
  using Matrix = std::array<Three, 3>;
  void assemble_vehicle();
  Three static_load() const;

  const TrackBeam* beam_;
  BeamVehicle vehicle_;
  double dt_;
  BandMatrix<double> factor_;                  ///< of K + 2 C / dt + 4 M / dt^2
  Matrix vehicle_mass_{}, vehicle_damping_{};  ///< of the vehicle
  Matrix vehicle_system_{};                    ///< its K + 2 C / dt + 4 M / dt^2
  std::vector<double> u_, v_, a_;
  Three wheel_{}, wheel_speed_{}, wheel_acceleration_{};
  double time_ = 0, force_ = 0, rail_ = 0, approach_ = 0;
};

}  // namespace tread
