#include "drivers/studies/multibody/sine_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace tread {

namespace {

constexpr int kPhases = 5;    ///< from crest to trough
constexpr double kCells = 8;  ///< over the shorter semi-axis

}  // namespace

double SineUnderWheel::depth_at(double x, double y, double phase) const {
  const double aside = y - centre;
  const double across = std::max(0.0, 1 - aside * aside / (width * width));
  return 0.5 * depth * across * (1 - std::cos(2 * std::numbers::pi * x / wavelength + phase));
}

half_space::Gap SineUnderWheel::gap(double phase) const {
  return [sine = *this, smooth = half_space::quadratic_gap(radius, radius_y), phase](double x, double y) {
    return smooth(x, y) + sine.depth_at(x, y, phase);
  };
}

half_space::Grid SineUnderWheel::grid(const HertzPatch& patch) const {
  const double wave_number = 2 * std::numbers::pi / wavelength;
  const double slope = 0.5 * depth * wave_number;
  const double bend = 2 * depth / (width * width);
  const double tilt = bend * std::min(std::abs(centre), width);
  using half_space::reach_in_hollow;
  return half_space::centred_grid(
      reach_in_hollow(patch.semi_axis_x, radius, slope * wave_number, slope, 0.5 * wavelength),
      reach_in_hollow(patch.semi_axis_y, radius_y, bend, tilt, width),
      std::min(patch.semi_axis_x, patch.semi_axis_y) / kCells);
}

std::pair<double, double> ContactRelief::value(double s) const {
  const int i = std::clamp(static_cast<int>(s / pitch), 0, kLoads - 2);
  const double first = approach[static_cast<std::size_t>(i)];
  const double slope = (approach[static_cast<std::size_t>(i) + 1] - first) / pitch;
  return {first + (s - i * pitch) * slope, slope};
}

SineContact::SineContact(const SineUnderWheel& sine, const ElasticPair& pair, double most) : most_(most) {
  using namespace half_space;
  const double pitch = std::pow(most, 2.0 / 3) / (ContactRelief::kLoads - 1);
  const Gap smooth = quadratic_gap(sine.radius, sine.radius_y);
  harmonic_.assign(kPhases, {});
  for (ContactRelief& relief : harmonic_) relief.pitch = pitch;
  const auto angle = [](int phase) { return std::numbers::pi * phase / (kPhases - 1); };
  for (std::size_t load = 1; load < ContactRelief::kLoads; ++load) {
    const double force = std::pow(static_cast<double>(load) * pitch, 1.5);
    const HertzPatch patch = hertz(sine.radius, sine.radius_y, pair.contact_modulus(), force);
    const Influence influence(sine.grid(patch), pair.alike());
    const double on_smooth = press(influence, smooth, force).approach;
    std::array<double, kPhases> beyond{};
    for (int i = 0; i < kPhases; ++i)
      beyond[static_cast<std::size_t>(i)] =
          press(influence, sine.gap(angle(i)), force).approach - on_smooth - sine.depth_at(0, 0, angle(i));
    // The cosine series through the phases, which are even about crest and trough.
    for (int m = 0; m < kPhases; ++m) {
      double sum = 0;
      for (int i = 0; i < kPhases; ++i)
        sum += (i == 0 || i == kPhases - 1 ? 0.5 : 1.0) * beyond[static_cast<std::size_t>(i)] *
               std::cos(m * angle(i));
      const double half_end = m == 0 || m == kPhases - 1 ? 0.5 : 1.0;
      harmonic_[static_cast<std::size_t>(m)].approach[load] = 2 * half_end * sum / (kPhases - 1);
    }
  }
  for (ContactRelief& relief : harmonic_) relief.approach[0] = 2 * relief.approach[1] - relief.approach[2];
}

ContactRelief SineContact::at(double phase, double share) const {
  ContactRelief sum;
  if (harmonic_.empty()) return sum;
  sum.pitch = harmonic_.front().pitch;
  for (std::size_t m = 0; m < harmonic_.size(); ++m) {
    const double weight = share * std::cos(static_cast<double>(m) * phase);
    for (std::size_t i = 0; i < sum.approach.size(); ++i)
      sum.approach[i] += weight * harmonic_[m].approach[i];
  }
  return sum;
}

}  // namespace tread
