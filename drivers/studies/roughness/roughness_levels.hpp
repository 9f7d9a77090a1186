#pragma once
// One-third octave levels of a profile beside the limit of ISO 3095. [theory.md, Roughness levels]

#include <optional>
#include <vector>

#include "core/math/spectrum.hpp"
#include "drivers/studies/roughness/roughness_profile.hpp"

namespace tread {

/// A one-third octave band of wavelength [m].
struct RoughnessBand : ThirdOctave {
  double limit = 0;  ///< limit of ISO 3095:2013 [dB re 1 um]
};

/// Bands of 400 mm to 3.15 mm, longest first.
const std::vector<RoughnessBand>& roughness_bands();

struct RoughnessLevels {
  int segments = 0;           ///< number of averaged segments
  double segment_length = 0;  ///< [m]
  /// Levels by band of roughness_bands() [dB re 1 um]; absent if the segments hold less than four waves or a
  /// wave less than 2.5 samples.
  std::vector<std::optional<double>> level;
};

/// Root mean square in the bands: segments overlapping by half, mean and trend removed, Hann's window,
/// squares averaged. A line between two bands counts in both by its parts. A record shorter than `segment`
/// [m] is one segment. Throws InputError if no band is resolved.
RoughnessLevels roughness_levels(const RoughnessProfile& profile, double segment);

}  // namespace tread
