#pragma once
// Growth of a profile's waves, from the work that they cause and from profiles before and after. [theory.md,
// Wear]

#include <complex>
#include <optional>
#include <vector>

#include "drivers/studies/develop/wear.hpp"

namespace tread {

/// A one-third octave band of a profile and of the work over it.
struct GrowthBand {
  double wavelength = 0;  ///< nominal wavelength [m]
  double depth = 0;       ///< root mean square depth [m]
  /// Work per depth, H [J/m3]. With a positive real part the work is larger in troughs, and the wave grows.
  std::complex<double> response;
  /// Share of the work in the band that H explains [-]; absent for a band with one line, which H meets.
  std::optional<double> coherence;
  /// Root mean square depth that the largest line of the deepest band may leave in this band where the ends
  /// fade [m]; 0 in the deepest band itself.
  double leakage = 0;
  double work = 0;          ///< root mean square work [J/m2]
  double work_leakage = 0;  ///< the same by the largest line of the work of the band with most [J/m2]

  /// Distance of the work's maximum past the trough in the direction of rolling, in waves, -0.5 to 0.5.
  double lag() const;
};

/// Bands within `band` that hold a line of the stretch, longest waves first. `uneven`: work of the passage
/// over the profile. The ends of both fade. [theory.md, eq. (W5)]
std::vector<GrowthBand> growth_bands(const WornProfile& profile, const PassageWork& uneven,
                                     const WearBand& band);

/// Band with the largest depth; nullptr if there is none.
const GrowthBand* deepest_band(const std::vector<GrowthBand>& bands);

}  // namespace tread
