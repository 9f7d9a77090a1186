#include "drivers/studies/develop/wear.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/corrugation.hpp"
#include "core/error.hpp"

namespace tread {

namespace {

/// Difference of the highest and the lowest value.
double range_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

}  // namespace

double WornProfile::range() const {
  return range_of(depth);
}

double WearBand::gain(double wavelength) const {
  const double beyond = std::max(std::log2(shortest / wavelength), std::log2(wavelength / longest));
  constexpr double kFlank = 1.0 / 3;  // [octave]
  if (beyond <= 0) return 1;
  return beyond >= kFlank ? 0 : 0.5 * (1 + std::cos(std::numbers::pi * beyond / kFlank));
}

double taper_at(double x, const WornProfile& profile, const WearBand& band) {
  return end_taper(x - profile.start, profile.length(), band.fade());
}

double mean_work(const PassageWork& work, const WornProfile& profile, const WearBand& band) {
  double sum = 0;
  double weights = 0;
  for (std::size_t i = 0; i < work.x.size(); ++i) {
    const double weight = work.length[i] * taper_at(work.x[i], profile, band);
    sum += weight * work.work[i];
    weights += weight;
  }
  return weights > 0 ? sum / weights : 0;
}

std::complex<double> work_line(const PassageWork& work, double mean, double turn, const WornProfile& profile,
                               const WearBand& band) {
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < work.x.size(); ++i)
    sum += work.length[i] * taper_at(work.x[i], profile, band) * (work.work[i] - mean) *
           std::polar(1.0, -turn * (work.x[i] - profile.start));
  return sum / profile.length();
}

std::vector<double> uneven_work(const PassageWork& work, const WornProfile& profile, const WearBand& band) {
  const double mean = mean_work(work, profile, band);
  const double length = profile.length();
  std::vector<double> uneven(profile.depth.size(), 0.0);
  for (int wave = 1; length / wave > 0.5 * band.shortest; ++wave) {
    const double gain = band.gain(length / wave);
    if (gain <= 0) continue;
    const double turn = 2 * std::numbers::pi * wave / length;
    const std::complex<double> line = work_line(work, mean, turn, profile, band);
    for (std::size_t i = 0; i < uneven.size(); ++i)
      uneven[i] += 2 * gain * std::real(line * std::polar(1.0, turn * (profile.x(i) - profile.start)));
  }
  for (std::size_t i = 0; i < uneven.size(); ++i) uneven[i] *= taper_at(profile.x(i), profile, band);
  return uneven;
}

PassageWork without(const PassageWork& one, const PassageWork& other) {
  if (one.x != other.x)
    throw InputError("the passages are of different meshes: begin the development in another folder");
  PassageWork result = one;
  for (std::size_t i = 0; i < result.work.size(); ++i) result.work[i] -= other.work[i];
  return result;
}

double passages_for(double change, double depth, double per_work, double uneven) {
  if (uneven <= 0) throw InputError("no frictional work differs along the rail: there is nothing to develop");
  return change * depth / (per_work * uneven);
}

WearStep worn(const WornProfile& profile, const std::vector<double>& uneven, double per_work, double change) {
  WearStep step{passages_for(change, profile.range(), per_work, range_of(uneven)), profile};
  for (std::size_t i = 0; i < uneven.size(); ++i)
    step.profile.depth[i] += step.passages * per_work * uneven[i];
  return step;
}

}  // namespace tread
