#include "drivers/studies/multibody/sine_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/math/hertz.hpp"
#include "kernels/half_space/half_space.hpp"

namespace tread {

namespace {

constexpr int kPhases = 5;    ///< from crest to trough
constexpr double kCells = 8;  ///< over the shorter semi-axis
constexpr double kReach = 2;  ///< half length of the grid over the semi-axis

}  // namespace

std::pair<double, double> ContactRelief::value(double s) const {
  const int i = std::clamp(static_cast<int>(s / pitch), 0, kLoads - 2);
  const double first = approach[static_cast<std::size_t>(i)];
  const double slope = (approach[static_cast<std::size_t>(i) + 1] - first) / pitch;
  return {first + (s - i * pitch) * slope, slope};
}

SineContact::SineContact(const SineUnderWheel& sine, const ElasticPair& pair, double most) {
  using namespace half_space;
  const double pitch = std::pow(most, 2.0 / 3) / (ContactRelief::kLoads - 1);
  const Gap smooth = quadratic_gap(sine.radius, sine.radius_y);
  const auto depth = [&](double x, double y, double phase) {
    const double aside = y - sine.centre;
    const double across = std::max(0.0, 1 - aside * aside / (sine.width * sine.width));
    return 0.5 * sine.depth * across * (1 - std::cos(2 * std::numbers::pi * x / sine.wavelength + phase));
  };
  harmonic_.assign(kPhases, {});
  for (ContactRelief& relief : harmonic_) relief.pitch = pitch;
  const auto angle = [](int phase) { return std::numbers::pi * phase / (kPhases - 1); };
  for (std::size_t load = 1; load < ContactRelief::kLoads; ++load) {
    const double force = std::pow(static_cast<double>(load) * pitch, 1.5);
    const HertzPatch patch = hertz(sine.radius, sine.radius_y, pair.contact_modulus(), force);
    const double cell = std::min(patch.semi_axis_x, patch.semi_axis_y) / kCells;
    // The wheel touches a slope ahead, behind or aside, in a trough more curved than the wheel anywhere.
    const double curvature = 0.5 * sine.depth * std::pow(2 * std::numbers::pi / sine.wavelength, 2);
    const double slope = 0.5 * sine.depth * 2 * std::numbers::pi / sine.wavelength;
    const bool bridged = curvature * sine.radius > 0.5;
    const double half =
        std::max(kReach * patch.semi_axis_x, 1.5 * patch.semi_axis_x + 2 * slope * sine.radius) +
        (bridged ? 0.5 * sine.wavelength : 0.0);
    const double tilt = 2 * sine.depth / sine.width * std::min(std::abs(sine.centre) / sine.width, 1.0);
    const double half_across =
        std::max(kReach * patch.semi_axis_y, 1.5 * patch.semi_axis_y + 2 * tilt * sine.radius_y);
    const Influence influence(centred_grid(half, half_across, cell), pair.alike());
    const double on_smooth = press(influence, smooth, force).approach;
    std::array<double, kPhases> beyond{};
    for (int i = 0; i < kPhases; ++i) {
      const Gap gap = [&](double x, double y) { return smooth(x, y) + depth(x, y, angle(i)); };
      beyond[static_cast<std::size_t>(i)] =
          press(influence, gap, force).approach - on_smooth - depth(0, 0, angle(i));
    }
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
