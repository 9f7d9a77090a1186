#include "drivers/studies/develop/growth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/studies/roughness/roughness_levels.hpp"

namespace tread {

namespace {

using Complex = std::complex<double>;

/// Fourier coefficients of depth and work, each without its mean.
struct Line {
  Complex depth;  ///< [m]
  Complex work;   ///< [J/m2]
};

/// Depths as stations, each of which stands for an equal length of the rail.
PassageWork as_stations(const WornProfile& profile) {
  PassageWork stations;
  for (std::size_t i = 0; i < profile.depth.size(); ++i) stations.x.push_back(profile.x(i));
  stations.length.assign(profile.depth.size(), profile.spacing);
  stations.work = profile.depth;
  return stations;
}

/// Mean square of the fading, by which a wave's power decreases.
double taper_power(const WornProfile& profile, const WearBand& band) {
  double sum = 0;
  for (std::size_t i = 0; i < profile.depth.size(); ++i) {
    const double taper = taper_at(profile.x(i), profile, band);
    sum += taper * taper * profile.spacing;
  }
  return sum / profile.length();
}

std::vector<Line> lines_in(const RoughnessBand& octave_third, const WornProfile& profile,
                           const PassageWork& uneven, const WearBand& band) {
  const PassageWork depths = as_stations(profile);
  const double mean_depth = mean_work(depths, profile, band);
  const double mean = mean_work(uneven, profile, band);
  std::vector<Line> lines;
  const double length = profile.length();
  const auto first = static_cast<int>(std::ceil(length / octave_third.longest()));
  for (int wave = std::max(1, first); length / wave > octave_third.shortest(); ++wave) {
    const double turn = 2 * std::numbers::pi * wave / length;
    lines.push_back(
        {work_line(depths, mean_depth, turn, profile, band), work_line(uneven, mean, turn, profile, band)});
  }
  return lines;
}

GrowthBand band_of(double wavelength, const std::vector<Line>& lines, double taper) {
  GrowthBand result;
  result.wavelength = wavelength;
  Complex cross = 0;
  double depths = 0;
  double works = 0;
  for (const Line& line : lines) {
    cross += line.work * std::conj(line.depth);
    depths += std::norm(line.depth);
    works += std::norm(line.work);
  }
  result.depth = std::sqrt(2 * depths / taper);
  result.response = depths > 0 ? cross / depths : 0;
  result.coherence = depths * works > 0 ? std::norm(cross) / (depths * works) : 0;
  return result;
}

}  // namespace

double GrowthBand::lag() const {
  return -std::arg(response) / (2 * std::numbers::pi);
}

std::vector<GrowthBand> growth_bands(const WornProfile& profile, const PassageWork& uneven,
                                     const WearBand& band) {
  const double taper = taper_power(profile, band);
  std::vector<GrowthBand> bands;
  for (const RoughnessBand& third : roughness_bands()) {
    if (third.nominal > 1.001 * band.longest || third.nominal < 0.999 * band.shortest) continue;
    const std::vector<Line> lines = lines_in(third, profile, uneven, band);
    if (!lines.empty()) bands.push_back(band_of(third.nominal, lines, taper));
  }
  return bands;
}

const GrowthBand* deepest_band(const std::vector<GrowthBand>& bands) {
  const auto deepest = std::max_element(
      bands.begin(), bands.end(), [](const GrowthBand& a, const GrowthBand& b) { return a.depth < b.depth; });
  return deepest == bands.end() ? nullptr : &*deepest;
}

}  // namespace tread
