#pragma once
// A rail as its lowest modes. [theory.md, Multi-body approach]

#include <vector>

#include "drivers/engine/beam/beam_section.hpp"

namespace tread {

/// A mode of a rail.
struct BeamMode {
  int harmonic = 0;       ///< n of the wave number n pi / length
  double omega = 0;       ///< angular frequency [rad/s]
  double deflection = 0;  ///< w on the supports over cos(k x) [1/sqrt(kg)]
  double head = 0;        ///< w averaged over the spread of a force on the head, over cos(k x) [1/sqrt(kg)]
  double foot = 0;        ///< motion of the foot along x over sin(k x) [1/sqrt(kg)]
};

/// Springs along x that hold the foot of a solid rail stand this far apart at the most [m].
inline constexpr double kFootPitch = 0.06;

/// A free Euler or Timoshenko beam whose ends do not turn: all modes are cosines and sines, known exactly.
/// Deflection w is positive downwards; mode 0 is the rigid motion. Modes are scaled to a modal mass of 1 kg.
/// [theory.md, eqs. M1 and M2]
class ModalBeam {
 public:
  /// Motion of the foot besides the waves of bending.
  enum class Foot {
    still,  ///< modes of the lower branch alone
    moves  ///< also the upper branch and the waves along x up to the same frequency: a foot that is held sees
           ///< them. Needs BeamProperties::has_foot()
  };

  /// Beam from x = `left` [m] on, with at least two modes of the lower branch. A force on the head reaches
  /// the beam spread along it as a normal distribution of the standard deviation `spread` [m]; 0: at a point.
  ModalBeam(const BeamProperties& properties, double left, double length, int modes, double spread = 0,
            Foot foot = Foot::still);

  /// Modes from elsewhere and the flexibilities that they lack, of the foot by harmonic.
  struct Modes {
    std::vector<BeamMode> modes;
    double residual = 0;                ///< [m/N]
    std::vector<double> foot_residual;  ///< [m/N]
  };
  ModalBeam(double left, double length, Modes modes);

  int modes() const { return static_cast<int>(omega_.size()); }
  double left() const { return left_; }
  double length() const { return length_; }

  /// Angular frequencies, by mode [rad/s].
  const std::vector<double>& omega() const { return omega_; }

  /// Computes the values of all modes of the axis at x [1/sqrt(kg)]; `values` holds modes() of them.
  void shapes(double x, std::vector<double>& values) const { values_at(x, &BeamMode::deflection, values); }

  /// Computes the mode values for a force on the head and for the deflection that a wheel on the head sees.
  void head_shapes(double x, std::vector<double>& values) const { values_at(x, &BeamMode::head, values); }

  /// Computes the mode values of the foot's motion along x.
  void foot_shapes(double x, std::vector<double>& values) const;

  /// Flexibility that the modes lack in the head's deflection under a force on it [m/N], at rest and far from
  /// the ends: that of the missing modes, and of a Timoshenko beam's upper branch. [theory.md, eq. M3]
  double residual_flexibility() const { return residual_; }

  /// The same of the foot's motion along x under a force along x at the foot, at a distance from it [m]; 0 of
  /// a foot that is still. [theory.md, eq. M5]
  double foot_residual_flexibility(double distance) const;

 private:
  void add(const BeamMode& mode);
  void add_bending(const BeamProperties& properties, int harmonic, double omega, double share);
  void values_at(double x, double BeamMode::*amplitude, std::vector<double>& values) const;

  double left_, length_;
  std::vector<double> omega_;
  std::vector<BeamMode> mode_;  ///< the lower branch first, in the order of harmonics
  double residual_ = 0;
  std::vector<double> foot_residual_;  ///< by harmonic [m/N]
};

/// Number of modes below a frequency [Hz].
int modes_below(const BeamProperties& properties, double length, double frequency);

}  // namespace tread
