#include "drivers/studies/develop/growth.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "drivers/studies/roughness/roughness_levels.hpp"

namespace tread {

namespace {

using Complex = std::complex<double>;

/// Fourier coefficients of depth and work, each without its mean.
struct Line {
  int wave = 0;   ///< number of waves in the stretch
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
  const auto first = static_cast<int>(std::ceil(length / octave_third.high()));
  for (int wave = std::max(1, first); length / wave > octave_third.low(); ++wave) {
    const double turn = 2 * std::numbers::pi * wave / length;
    lines.push_back({wave, work_line(depths, mean_depth, turn, profile, band),
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
  result.work = std::sqrt(2 * works / taper);
  result.response = depths > 0 ? cross / depths : 0;
  if (lines.size() > 1) result.coherence = depths * works > 0 ? std::norm(cross) / (depths * works) : 0;
  return result;
}

/// Parts of a wave that the fading ends of a stretch leave beside its line.
class Leakage {
 public:
  /// `waves`: largest distance of two lines.
  Leakage(const WornProfile& profile, const WearBand& band, int waves) : power_(taper_power(profile, band)) {
    PassageWork even = as_stations(profile);
    std::fill(even.work.begin(), even.work.end(), 1.0);
    for (int quarter = 0; quarter <= kParts * waves + kHalf; ++quarter) {
      const double turn = 2 * std::numbers::pi * quarter / (kParts * profile.length());
      squares_.push_back(std::norm(work_line(even, 0, turn, profile, band)));
    }
  }

  /// Largest root mean square in the lines `into` of a band by a wave whose largest line is that of the lines
  /// `from` of another band, in the unit of `value`. The wave lies up to half a line beside that line.
  double left(const std::vector<Line>& into, const std::vector<Line>& from, Complex Line::*value) const {
    const Line& largest =
        *std::ranges::max_element(from, {}, [value](const Line& line) { return std::norm(line.*value); });
    double most = 0;
    for (int beside = -kHalf; beside <= kHalf; ++beside) {
      double sum = 0;
      for (const Line& line : into) sum += square(kParts * (line.wave - largest.wave) - beside);
      most = std::max(most, sum / square(beside));
    }
    return std::abs(largest.*value) * std::sqrt(2 * most / power_);
  }

 private:
  static constexpr int kParts = 4;  ///< of the distance between two lines
  static constexpr int kHalf = kParts / 2;

  /// Square of the taper's spectrum, so many parts from its middle.
  double square(int parts) const { return squares_[static_cast<std::size_t>(std::abs(parts))]; }

  double power_;
  std::vector<double> squares_;
};

/// Fills the leakage of all bands, whose lines these are.
void add_leakage(const std::vector<std::vector<Line>>& lines, const Leakage& leakage,
                 std::vector<GrowthBand>& bands) {
  const GrowthBand* deepest = deepest_band(bands);
  const auto busiest = std::ranges::max_element(bands, {}, &GrowthBand::work);
  for (std::size_t i = 0; i < bands.size(); ++i)
    for (std::size_t other = 0; other < bands.size(); ++other) {
      if (other == i) continue;
      if (&bands[other] == deepest) bands[i].leakage = leakage.left(lines[i], lines[other], &Line::depth);
      if (&bands[other] == &*busiest)
        bands[i].work_leakage = leakage.left(lines[i], lines[other], &Line::work);
    }
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
  if (!bands.empty()) {
    const int waves = lines.back().back().wave - lines.front().front().wave;
    add_leakage(lines, Leakage(profile, band, waves), bands);
  }
  return bands;
}

const GrowthBand* deepest_band(const std::vector<GrowthBand>& bands) {
  const auto deepest = std::max_element(
      bands.begin(), bands.end(), [](const GrowthBand& a, const GrowthBand& b) { return a.depth < b.depth; });
  return deepest == bands.end() ? nullptr : &*deepest;
}

}  // namespace tread
