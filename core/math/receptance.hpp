#pragma once
// The frequency response of a struck point.

#include <complex>
#include <vector>

namespace tread {

/// Force of a blow and the response to it at ascending times, two at least.
struct BlowRecord {
  std::vector<double> time;      ///< [s]
  std::vector<double> force;     ///< [N]
  std::vector<double> response;  ///< displacement in the direction of the force [m]

  /// Fourier integral of the response over that of the force [m/N]. Exact only if the response has decayed at
  /// the end of the record. [theory.md, Beam on fastenings]
  std::complex<double> receptance(double frequency) const;
};

}  // namespace tread
