#include "drivers/studies/develop/growth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "drivers/studies/roughness/roughness_levels.hpp"

namespace tread {

namespace {

using Complex = std::complex<double>;

/// Fourier coefficients of depth and work, each without its mean.
struct Line {
  double turn = 0;  ///< 2 pi / wavelength [1/m]
  Complex depth;    ///< [m]
  Complex work;     ///< [J/m2]
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
  const auto first = static_cast<int>(std::ceil(length / octave_third.high()));
  for (int wave = std::max(1, first); length / wave > octave_third.low(); ++wave) {
    const double turn = 2 * std::numbers::pi * wave / length;
    lines.push_back({turn, work_line(depths, mean_depth, turn, profile, band),
                     work_line(uneven, mean, turn, profile, band)});
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
  if (lines.size() > 1) result.coherence = depths * works > 0 ? std::norm(cross) / (depths * works) : 0;
  return result;
}

/// Largest sum of squares that a wave leaves in the lines by the taper's own spectrum, over the square that
/// it leaves in the line `largest`. The wave lies up to half a line beside that line.
double leaked_share(const Line& largest, const std::vector<Line>& lines, const WornProfile& profile,
                    const WearBand& band) {
  PassageWork even = as_stations(profile);
  std::fill(even.work.begin(), even.work.end(), 1.0);
  const auto square = [&](double turn) { return std::norm(work_line(even, 0, turn, profile, band)); };
  const double line = 2 * std::numbers::pi / profile.length();
  double most = 0;
  for (const double beside : {-0.5, -0.25, 0.0, 0.25, 0.5}) {
    const double wave = largest.turn + beside * line;
    double sum = 0;
    for (const Line& one : lines) sum += square(one.turn - wave);
    most = std::max(most, sum / square(largest.turn - wave));
  }
  return most;
}

}  // namespace

double GrowthBand::lag() const {
  return -std::arg(response) / (2 * std::numbers::pi);
}

std::vector<GrowthBand> growth_bands(const WornProfile& profile, const PassageWork& uneven,
                                     const WearBand& band) {
  const double taper = taper_power(profile, band);
  std::vector<GrowthBand> bands;
  std::vector<std::vector<Line>> lines;
  for (const RoughnessBand& third : roughness_bands()) {
    if (third.nominal > 1.001 * band.longest || third.nominal < 0.999 * band.shortest) continue;
    std::vector<Line> in_third = lines_in(third, profile, uneven, band);
    if (in_third.empty()) continue;
    bands.push_back(band_of(third.nominal, in_third, taper));
    lines.push_back(std::move(in_third));
  }
  const GrowthBand* deepest = deepest_band(bands);
  for (std::size_t i = 0; i < bands.size(); ++i) {
    if (&bands[i] == deepest) continue;
    const std::vector<Line>& of_deepest = lines[static_cast<std::size_t>(deepest - bands.data())];
    const Line& largest =
        *std::ranges::max_element(of_deepest, {}, [](const Line& line) { return std::norm(line.depth); });
    bands[i].leakage =
        std::abs(largest.depth) * std::sqrt(2 * leaked_share(largest, lines[i], profile, band) / taper);
  }
  return bands;
}

const GrowthBand* deepest_band(const std::vector<GrowthBand>& bands) {
  const auto deepest = std::max_element(
      bands.begin(), bands.end(), [](const GrowthBand& a, const GrowthBand& b) { return a.depth < b.depth; });
  return deepest == bands.end() ? nullptr : &*deepest;
}

}  // namespace tread
