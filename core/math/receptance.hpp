#pragma once
// The frequency response of a struck point.

#include <complex>
#include <vector>

namespace tread {

/// A blow's force and the response to it at evenly spaced times.
struct BlowRecord {
  std::vector<double> time;      ///< [s]
  std::vector<double> force;     ///< [N]
  std::vector<double> response;  ///< displacement in the direction of the force [m]

  /// Fourier integral of the response over that of the force. Right where the response is over at the end.
  /// [theory.md, Beam on fastenings] [m/N]
  std::complex<double> receptance(double frequency) const;
};

}  // namespace tread
