#include "drivers/verify/force_harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.hpp"
#include "core/math/interpolation.hpp"

namespace tread {

Harmonics harmonics(const ForceHistory& curve, double period, int periods, double last, int count) {
  const double first = last - periods * period;
  if (curve.x.empty() || curve.x.front() > first || curve.x.back() < last)
    throw NumericalError("verify: the wheel's way does not cover the periods to evaluate");
  constexpr int kParts = 400;  // parts of a period
  const int points = kParts * periods;
  std::vector<std::complex<double>> sums(static_cast<std::size_t>(count) + 1);
  for (int i = 0; i < points; ++i) {
    const double x = first + period * (i + 0.5) / kParts;
    const double force = value_at(curve.x, curve.force, x);
    for (std::size_t n = 0; n < sums.size(); ++n)
      sums[n] +=
          force * std::polar(1.0 / points, -2 * std::numbers::pi * static_cast<double>(n) * x / period);
  }
  Harmonics h;
  h.mean = sums[0].real();
  for (std::size_t n = 1; n < sums.size(); ++n) {
    h.amplitude.push_back(2 * std::abs(sums[n]));
    const double turns = -std::arg(sums[n]) / (2 * std::numbers::pi);
    h.phase.push_back(turns < 0 ? turns + 1 : turns);
  }
  h.low = h.high = h.mean;
  for (int i = 0; i < kParts; ++i) {
    double force = h.mean;
    for (std::size_t n = 1; n < sums.size(); ++n)
      force +=
          2 * (sums[n] * std::polar(1.0, 2 * std::numbers::pi * static_cast<double>(n) * i / kParts)).real();
    h.low = std::min(h.low, force);
    h.high = std::max(h.high, force);
  }
  return h;
}

}  // namespace tread
