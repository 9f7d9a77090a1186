#pragma once
// Profile of the next passage from the frictional work of a passage. [theory.md, Wear]

#include <complex>
#include <vector>

namespace tread {

/// Depths at even distances along the rail, positive downwards, zero at both ends.
struct WornProfile {
  double start = 0;           ///< x of the first depth [m]
  double spacing = 0;         ///< [m]
  std::vector<double> depth;  ///< [m]

  double x(std::size_t i) const { return start + static_cast<double>(i) * spacing; }  ///< [m]
  double length() const { return spacing * static_cast<double>(depth.size() - 1); }   ///< [m]
  double range() const;  ///< height difference of the highest and the deepest place [m]
};

/// Frictional work of a passage at the stations of the rail's surface, averaged across the running band.
struct PassageWork {
  std::vector<double> x;       ///< [m]
  std::vector<double> length;  ///< length of the rail that a station stands for [m]
  std::vector<double> work;    ///< [J/m2]
};

/// Wavelengths that wear [m].
struct WearBand {
  double shortest = 0, longest = 0;

  /// Share of a wave that passes: 1 within the band, 0 a third of an octave outside. [theory.md, eq. (W4)]
  double gain(double wavelength) const;
  /// Length over which the ends of the stretch fade [m].
  double fade() const { return 0.5 * longest; }
};

/// Mean of the work over the profile's stretch, its ends faded [J/m2].
double mean_work(const PassageWork& work, const WornProfile& profile, const WearBand& band);

/// Fourier coefficient of the work [J/m2], its mean taken off and its ends faded, at `turn` = 2 pi /
/// wavelength [1/m]: 1/length of the integral of the taper times (work - mean) exp(-i turn (x - start)).
/// `mean`: of mean_work().
std::complex<double> work_line(const PassageWork& work, double mean, double turn, const WornProfile& profile,
                               const WearBand& band);

/// Share of a wave that the fading ends leave at x [m].
double taper_at(double x, const WornProfile& profile, const WearBand& band);

/// Uneven part of the work at the profile's places [J/m2], without waves shorter or longer than the band and
/// fading at the ends. [theory.md, eq. (W4)]
std::vector<double> uneven_work(const PassageWork& work, const WornProfile& profile, const WearBand& band);

/// Difference `one` less `other` [J/m2]. Throws InputError if their stations differ.
PassageWork without(const PassageWork& one, const PassageWork& other);

/// A change of the profile.
struct WearStep {
  double passages = 0;  ///< number of real passages that the simulated one stands for
  WornProfile profile;  ///< profile after them
};

/// Number of passages that change a depth of range `depth` [m] by the share `change`, where each wears off
/// `per_work` [m3/J] times work of range `uneven` [J/m2]. Throws InputError if nothing is uneven.
double passages_for(double change, double depth, double per_work, double uneven);

/// Wear by as many passages as change the depth by at most `change` of its range. Each passage wears off
/// `per_work` [m3/J] times `uneven` [J/m2]. Throws InputError if nothing is uneven. [theory.md, eq. (W3)]
WearStep worn(const WornProfile& profile, const std::vector<double>& uneven, double per_work, double change);

}  // namespace tread
