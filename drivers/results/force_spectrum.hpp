#pragma once
// Spectrum of the vertical contact force over a stretch of the way.

#include <optional>
#include <vector>

#include "core/math/spectrum.hpp"
#include "drivers/engine/features/sample.hpp"

namespace tread {

/// A sine in a force, of a wheel that passes one wave of the rail after another.
struct ForceSine {
  double length = 0;     ///< of a wave [m]
  double frequency = 0;  ///< [Hz]
  double amplitude = 0;  ///< [N]
};

struct ForceSpectrum {
  double spacing = 0;              ///< of the lines [Hz]
  double speed = 0;                ///< mean forward speed of the wheel over the record [m/s]
  std::vector<double> square;      ///< mean squares of the lines from 0 Hz on [N2]
  std::vector<ThirdOctave> bands;  ///< of frequency [Hz], four lines wide, 2.5 samples a wave
  std::vector<double> rms;         ///< root mean square of F_N by band [N]

  /// Frequency above which one-third octave bands are four lines wide [Hz]; 0 without lines.
  double lowest() const;
  /// Amplitude of a sine of the mean square between `low` and `high` [Hz], in N; nothing where these hold
  /// fewer than four lines or end above the last line.
  std::optional<double> amplitude(double low, double high) const;
  /// F_N at waves of a length [m], by the four lines about their frequency; nothing where the record has
  /// fewer than four waves.
  std::optional<ForceSine> sine_of_wave(double length) const;
  /// F_N as elements of a length [m] pass, by a one-third octave: those of the wheel may have another length.
  std::optional<ForceSine> sine_of_elements(double length) const;
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
