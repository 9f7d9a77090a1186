#pragma once
// A rail as its lowest modes. [theory.md, Multi-body approach]

#include <vector>

#include "drivers/engine/beam/beam_section.hpp"

namespace tread {

/// A free Euler or Timoshenko beam whose ends do not turn: all modes are cosines, known exactly. Deflection w
/// is positive downwards; mode 0 is the rigid motion. Modes are scaled to a modal mass of 1 kg. [theory.md,
/// eqs. M1 and M2]
class ModalBeam {
 public:
  /// Beam from x = `left` [m] on, with at least two modes. A force on the head reaches the beam spread along
  /// it as a normal distribution of the standard deviation `spread` [m]; 0: at a point.
  ModalBeam(const BeamProperties& properties, double left, double length, int modes, double spread = 0);

  int modes() const { return static_cast<int>(omega_.size()); }
  double left() const { return left_; }
  double length() const { return length_; }

  /// Angular frequencies, by mode [rad/s].
  const std::vector<double>& omega() const { return omega_; }

  /// Computes the values of all modes of the axis at x [1/sqrt(kg)]; `values` holds modes() of them.
  void shapes(double x, std::vector<double>& values) const { shapes(x, amplitude_, values); }

  /// Computes the mode values for a force on the head and for the deflection that a wheel on the head sees.
  void head_shapes(double x, std::vector<double>& values) const { shapes(x, head_amplitude_, values); }

  /// Flexibility that the modes lack in the head's deflection under a force on it [m/N], at rest and far from
  /// the ends: that of the missing modes, and of a Timoshenko beam's upper branch. [theory.md, eq. M3]
  double residual_flexibility() const { return residual_; }

 private:
  void shapes(double x, const std::vector<double>& amplitude, std::vector<double>& values) const;

  double left_, length_;
  std::vector<double> omega_, amplitude_, head_amplitude_;
  double residual_ = 0;
};

/// Number of modes below a frequency [Hz].
int modes_below(const BeamProperties& properties, double length, double frequency);

}  // namespace tread
