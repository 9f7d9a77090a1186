#pragma once
// A rail as its lowest modes. [theory.md, Multi-body approach]

#include <vector>

#include "drivers/beam/beam_section.hpp"

namespace tread {

/// A free Euler or Timoshenko beam whose ends do not turn: all modes are cosines, known exactly. Deflection w
/// positive downwards; mode 0 is the rigid motion. Modes are scaled to a modal mass of 1 kg.
/// [theory.md, eqs. M1 and M2]
class ModalBeam {
 public:
  /// From x = `left` on [m]; at least two modes.
  ModalBeam(const BeamProperties& properties, double left, double length, int modes);

  int modes() const { return static_cast<int>(omega_.size()); }
  double left() const { return left_; }
  double length() const { return length_; }

  /// Angular frequencies, by mode [rad/s].
  const std::vector<double>& omega() const { return omega_; }

  /// Values of all modes at x [1/sqrt(kg)]; `values` holds modes() of them.
  void shapes(double x, std::vector<double>& values) const;

  /// What the modes lack of a point's deflection under a force there, at rest and far from the ends: that of
  /// the missing modes, and of a Timoshenko beam's upper branch [m/N]. [theory.md, eq. M3]
  double residual_flexibility() const { return residual_; }

 private:
  double left_, length_;
  std::vector<double> omega_, amplitude_;
  double residual_ = 0;
};

/// How many modes lie below a frequency [Hz].
int modes_below(const BeamProperties& properties, double length, double frequency);

}  // namespace tread
