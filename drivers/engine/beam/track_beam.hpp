#pragma once
// The reference for a rail on its fastenings: a Timoshenko or Euler beam on spring-dampers, w positive
// downwards. [theory.md, Beam on fastenings]

#include <array>
#include <complex>
#include <optional>
#include <vector>

#include "core/scene.hpp"
#include "drivers/engine/beam/band_matrix.hpp"
#include "drivers/engine/beam/beam_section.hpp"

namespace tread {

enum class BeamEnds {
  free,
  guided,  ///< no rotation: what u_x = 0 at the rail's ends means
  pinned   ///< no deflection
};

/// Motion of a section of a beam.
struct SectionMotion {
  double deflection = 0;  ///< [m], [m/s]
  double rotation = 0;    ///< [rad], [rad/s]
  double axial = 0;       ///< of the centroid along x [m], [m/s]
};
inline SectionMotion operator+(const SectionMotion& a, const SectionMotion& b) {
  return {a.deflection + b.deflection, a.rotation + b.rotation, a.axial + b.axial};
}
inline SectionMotion operator*(double factor, const SectionMotion& a) {
  return {factor * a.deflection, factor * a.rotation, factor * a.axial};
}
inline SectionMotion operator-(const SectionMotion& a, const SectionMotion& b) {
  return a + -1 * b;
}

/// Finite elements with the cubic shape functions that solve the static beam exactly and the consistent mass
/// of deflection and rotation; along x the centroid moves linearly within an element. Unknowns: (w, rotation,
/// motion of the foot along x) of node after node. The foot of a beam that is rigid along x does not move
/// along. [theory.md, eqs. B1, B1a]
class TrackBeam {
 public:
  static constexpr int kPerNode = 3;  ///< unknowns of a node
  /// From `left` on, elements no longer than `element` [m].
  TrackBeam(const BeamProperties& properties, double left, double length, BeamEnds ends,
            double element = 0.01);

  /// A spring-damper to ground at x [N/m], [N s/m].
  void support(double x, double stiffness, double damping);

  /// The same along x at the foot.
  void support_foot(double x, double stiffness, double damping);

  /// Holds the foot against motion along x from `first` to `last`, at least at the node nearest to the middle
  /// [m].
  void hold_foot(double first, double last);

  double left() const { return left_; }
  double pitch() const { return pitch_; }
  int nodes() const { return elements_ + 1; }
  double length() const { return length_; }

  /// A force on the rail's head then reaches the beam spread along it as a normal distribution of this
  /// standard deviation [m]; without a call it acts at a point.
  void spread_head_load(double deviation) { spread_ = deviation; }

  /// Nodal loads of a unit force on the head at x; times the nodal values: the head's deflection there.
  std::vector<double> head_load(double x) const;

  /// Nodal values under a force on the head at x, downwards, at rest.
  std::vector<double> static_state(double x, double force) const;
  /// Motion of the section at a node, of nodal values or their rates.
  SectionMotion motion(const std::vector<double>& state, int node) const;
  /// w of the axis.
  double deflection(const std::vector<double>& state, double x) const;

  /// w(x) of the axis over a harmonic force on it at x_force. [m/N]
  std::complex<double> receptance(double x_force, double x, double frequency) const;

  /// The n-th undamped eigenfrequency, n from 0, rigid motion included. [Hz]
  double eigenfrequency(int n) const;

  const BandMatrix<double>& stiffness() const { return stiffness_; }
  const BandMatrix<double>& damping() const { return damping_; }
  const BandMatrix<double>& mass() const { return mass_; }

 private:
  /// Weights of the nodal values in w at x, and of a force at x in the nodal loads.
  struct Shape {
    int first = 0;  ///< unknown of the first of the values
    std::array<double, static_cast<std::size_t>(2 * kPerNode)> value{};
  };
  Shape shape(double x) const;
  void add_element(const BeamProperties& properties, int element);
  void hold(int node, int component);
  int modes_below(double omega) const;

  double left_, length_, pitch_;
  int elements_;
  double phi_;         ///< 12 E I / (kappa G A l^2)
  double foot_;        ///< distance from the centroid down to the foot [m]
  double held_;        ///< stiffness that stands in for a held unknown's [N m/rad], [N/m]
  double spread_ = 0;  ///< of a force on the head [m]
  BandMatrix<double> stiffness_, damping_, mass_;
};

/// A spring-damper to ground.
struct BeamSupport {
  double x = 0;          ///< [m]
  double stiffness = 0;  ///< [N/m]
  double damping = 0;    ///< [N s/m]
};

/// The columns of a scene's fastenings, and of so many more fastenings to their left; none without
/// [fastenings]. InputError without rail.
std::vector<BeamSupport> rail_supports(const Scene& scene, int more_spans = 0);

/// The columns as spring-dampers of the foot along x, where the fastenings are elastic along x; else none.
std::vector<BeamSupport> rail_foot_supports(const Scene& scene, int more_spans = 0);

/// A stretch over which the foot does not move along x [m].
struct FootStretch {
  double first = 0, last = 0;
};

/// The stretches over which the fastenings hold the foot along x: pads or columns; none where they do not.
std::vector<FootStretch> rail_foot_holds(const Scene& scene, int more_spans = 0);

/// Spread of forces on the head before the fastenings see them: at the wave number of a span; 0 for a
/// line or without [fastenings]. [m]
double head_spread(const Scene& scene, const BeamProperties& properties);

/// The rail of a scene: its section, its length, its fastenings' columns on rigid ground, the foot held along
/// x as they hold it, forces on the head spread by `head_spread`; to its left it goes on for so many more
/// spans. InputError without [rail].
TrackBeam rail_beam(const Scene& scene, const BeamProperties& properties, int more_spans = 0);

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
