#include "core/math/receptance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tread {

std::complex<double> BlowRecord::receptance(double frequency) const {
  std::complex<double> x;
  std::complex<double> f;
  const std::size_t last = time.size() - 1;
  const auto gap = [&](std::size_t i) { return time[i] - time[i - 1]; };
  for (std::size_t i = 0; last > 0 && i <= last; ++i) {
    // Half the distance of the neighbours; the ends count whole, for nothing happens beyond them.
    const double share = 0.5 * (gap(std::max<std::size_t>(i, 1)) + gap(std::min(i + 1, last)));
    const auto turn = share * std::polar(1.0, -2 * std::numbers::pi * frequency * time[i]);
    x += response[i] * turn;
    f += force[i] * turn;
  }
  return x / f;
}

}  // namespace tread
