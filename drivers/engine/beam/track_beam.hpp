#pragma once
// The reference for a rail on its fastenings: a Timoshenko or Euler beam on spring-dampers, w positive
// downwards. [theory.md, Beam on fastenings]

#include <array>
#include <complex>
#include <vector>

#include "core/math/band_matrix.hpp"
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

/// A rigid sleeper on its bed.
struct BeamSleeper {
  double mass = 0;       ///< [kg]
  double stiffness = 0;  ///< [N/m]
  double damping = 0;    ///< [N s/m]
};

/// A fastening on a sleeper: equal spring-dampers along the pad.
struct SleeperSupport {
  double x = 0;          ///< [m]
  double stiffness = 0;  ///< of all together [N/m]
  double damping = 0;    ///< of all together [N s/m]
  BeamSleeper sleeper;
  std::vector<double> columns = {0};  ///< places of the spring-dampers from x on [m]
};

/// Finite elements with the cubic shape functions that solve the static beam exactly and the consistent mass
/// of deflection and rotation; along x the centroid moves linearly within an element. Unknowns: (w, rotation,
/// motion of the foot along x) of node after node, and the deflection of a sleeper under the node where the
/// beam can have sleepers. The foot of a beam that is rigid along x does not move along. [theory.md, eqs. B1,
/// B1a]
class TrackBeam {
 public:
  static constexpr int kOfBeam = 3;  ///< unknowns of a node without those of a sleeper
  /// From `left` on, elements no longer than `element` [m].
  TrackBeam(const BeamProperties& properties, double left, double length, BeamEnds ends, double element,
            bool sleepers);

  /// A spring-damper to ground at x [N/m], [N s/m].
  void support(double x, double stiffness, double damping);

  /// A fastening on a sleeper that does not turn. Only on a beam with sleepers, which do not overlap.
  void support_on_sleeper(const SleeperSupport& fastening);

  /// The same along x at the foot.
  void support_foot(double x, double stiffness, double damping);

  /// Holds the foot against motion along x from `first` to `last` [m], or at one place. Over a stretch a foot
  /// gives way by its own compliance; without compliance its nodes are held.
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
  /// Deflection of the sleeper under the support nearest to x, of nodal values or their rates. Only on a beam
  /// with sleepers.
  double sleeper(const std::vector<double>& state, double x) const;
  /// w of the axis.
  double deflection(const std::vector<double>& state, double x) const;

  /// w(x) of the axis over a harmonic force on it at x_force. [m/N]
  std::complex<double> receptance(double x_force, double x, double frequency) const;

  const BandMatrix<double>& stiffness() const { return stiffness_; }
  const BandMatrix<double>& damping() const { return damping_; }
  const BandMatrix<double>& mass() const { return mass_; }

 private:
  /// A place within an element.
  struct Place {
    int first = 0;  ///< first unknown of the element's left node
    double xi = 0;  ///< 0 at the left node, 1 at the right one
  };
  Place place(double x) const;
  /// Weights of the nodal values in w at x, and of a force at x in the nodal loads.
  struct Shape {
    int first = 0;  ///< unknown of the first of the values
    std::array<double, static_cast<std::size_t>(2 * kOfBeam)> value{};
  };
  Shape shape(double x) const;
  /// Unknown of an element's i-th value.
  int unknown(int first, int i) const { return first + (i < kOfBeam ? i : i - kOfBeam + per_node_); }
  void add_outer(BandMatrix<double>& matrix, int first, double factor,
                 const std::array<double, static_cast<std::size_t>(2 * kOfBeam)>& v) const;
  void add_element(const BeamProperties& properties, int element);
  void hold(int node, int component);
  /// From one place to another, counted in elements.
  void hold_stretch(double first, double last);
  void join_to_sleeper(double x, double stiffness, double damping);

  double left_, length_, pitch_;
  int per_node_;  ///< unknowns of a node
  int elements_;
  double phi_;                    ///< 12 E I / (kappa G A l^2)
  double foot_;                   ///< distance from the centroid down to the foot [m]
  double foot_warping_;           ///< [m]
  double foot_compliance_;        ///< [m2/N]
  double held_;                   ///< stiffness that stands in for a held unknown's [N m/rad], [N/m]
  double spread_ = 0;             ///< of a force on the head [m]
  std::vector<double> sleepers_;  ///< x of the supports on sleepers [m]
  BandMatrix<double> stiffness_, damping_, mass_;
};

/// A spring-damper to ground.
struct BeamSupport {
  double x = 0;          ///< [m]
  double stiffness = 0;  ///< [N/m]
  double damping = 0;    ///< [N s/m]
};

/// A stretch over which the foot does not move along x [m].
struct FootStretch {
  double first = 0, last = 0;
};

}  // namespace tread
