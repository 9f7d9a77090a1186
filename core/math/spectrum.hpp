#pragma once
// Power spectrum of an evenly sampled record, and its sums over bands. [theory.md, Roughness levels]

#include <cstddef>
#include <span>
#include <vector>

namespace tread {

/// Mean squares of the lines k = 0 ... lines - 1, k waves in the record, in the square of the values' unit.
/// Mean and trend are taken off, and Hann's window weights the record.
std::vector<double> power_lines(std::span<const double> values, std::size_t lines);

/// Mean square within a band of frequency of a spectrum whose lines are `spacing` apart, all three in one
/// unit. A line that lies between two bands counts in both by its parts; the mean does not count.
double band_power(const std::vector<double>& lines, double spacing, double low, double high);

/// Lines over which Hann's window spreads a sine. It leaks from a band of fewer lines into the neighbours.
inline constexpr double kLinesOfASine = 4;

/// Least number of waves in the record, and of samples in a wave, of a band whose level is stated.
inline constexpr double kWavesInRecord = 4;
inline constexpr double kSamplesInWave = 2.5;

/// A one-third octave band: its middle as the standards name it, and its exact middle, 10^(n/10).
/// [IEC 61260-1]
struct ThirdOctave {
  double nominal = 0;
  double middle = 0;

  double low() const;
  double high() const;
};

/// Bands with edges up to `high` that are at least `width` wide, the lowest first.
std::vector<ThirdOctave> third_octaves(double width, double high);

}  // namespace tread
