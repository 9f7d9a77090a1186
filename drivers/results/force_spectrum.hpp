#pragma once
// Spectrum of the vertical contact force over a stretch of the way.

#include <vector>

#include "core/math/spectrum.hpp"
#include "drivers/engine/features/sample.hpp"

namespace tread {

struct ForceSpectrum {
  double spacing = 0;              ///< of the lines [Hz]
  std::vector<double> square;      ///< mean squares of the lines from 0 Hz on [N2]
  std::vector<ThirdOctave> bands;  ///< of frequency [Hz], four lines wide, 2.5 samples a wave
  std::vector<double> rms;         ///< root mean square of F_N by band [N]
};

/// Shortest and longest time between samples [s]; 0 where there are not two.
struct SampleIntervals {
  double least = 0, most = 0;

  /// Returns true if whole steps of dt [s] make the difference.
  bool even(double dt) const { return most - least < 1.5 * dt; }
};

/// Intervals of the samples with the wheel between two places [m].
SampleIntervals sample_intervals(const std::vector<Sample>& samples, double first, double last);

/// Spectrum of F_N with the wheel between two places [m] for the first time, in steps of dt [s]; without
/// lines where fewer than 16 samples lie there, or where their interval changes.
ForceSpectrum force_spectrum(const std::vector<Sample>& samples, double first, double last, double dt);

}  // namespace tread
