#include "core/math/receptance.hpp"

#include <cmath>
#include <numbers>

namespace tread {

std::complex<double> BlowRecord::receptance(double frequency) const {
  std::complex<double> x;
  std::complex<double> f;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const auto turn = std::polar(1.0, -2 * std::numbers::pi * frequency * time[i]);
    x += response[i] * turn;
    f += force[i] * turn;
  }
  return x / f;
}

}  // namespace tread
