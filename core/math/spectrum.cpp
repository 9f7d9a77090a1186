#include "core/math/spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tread {

std::vector<double> power_lines(std::span<const double> values, std::size_t lines) {
  const std::size_t count = values.size();
  const auto n = static_cast<double>(count);
  double mean = 0;
  double moment = 0;
  for (std::size_t j = 0; j < count; ++j) {
    mean += values[j] / n;
    moment += values[j] * (static_cast<double>(j) - 0.5 * (n - 1));
  }
  const double slope = 12 * moment / (n * (n * n - 1));

  // All lines run side by side, each with its own turning pointer.
  std::vector<double> real(lines), imaginary(lines), c(lines, 1.0), s(lines, 0.0), turn_c, turn_s;
  for (std::size_t k = 0; k < lines; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / n;
    turn_c.push_back(std::cos(angle));
    turn_s.push_back(std::sin(angle));
  }
  double window_squares = 0;
  for (std::size_t j = 0; j < count; ++j) {
    const double at = static_cast<double>(j);
    const double window = 0.5 * (1 - std::cos(2 * std::numbers::pi * (at + 0.5) / n));
    window_squares += window * window;
    const double value = window * (values[j] - mean - slope * (at - 0.5 * (n - 1)));
    for (std::size_t k = 0; k < lines; ++k) {
      real[k] += value * c[k];
      imaginary[k] += value * s[k];
      const double next = c[k] * turn_c[k] - s[k] * turn_s[k];
      s[k] = s[k] * turn_c[k] + c[k] * turn_s[k];
      c[k] = next;
    }
  }
  std::vector<double> squares(lines);
  for (std::size_t k = 0; k < lines; ++k)
    squares[k] = 2 * (real[k] * real[k] + imaginary[k] * imaginary[k]) / (n * window_squares);
  return squares;
}

double band_power(const std::vector<double>& lines, double spacing, double low, double high) {
  double square = 0;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const double from = std::max((static_cast<double>(k) - 0.5) * spacing, low);
    const double to = std::min((static_cast<double>(k) + 0.5) * spacing, high);
    if (to > from) square += lines[k] * (to - from) / spacing;
  }
  return square;
}

double ThirdOctave::low() const {
  return middle * std::pow(10.0, -0.05);
}

double ThirdOctave::high() const {
  return middle * std::pow(10.0, 0.05);
}

std::vector<ThirdOctave> third_octaves(double width, double high) {
  constexpr std::array<double, 10> kNominal = {1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3, 8};
  std::vector<ThirdOctave> bands;
  if (width <= 0) return bands;
  constexpr double kRounding = 1e-9;
  for (int n = static_cast<int>(std::floor(10 * std::log10(width))); n <= 10 * std::log10(high); ++n) {
    const int decade = n >= 0 ? n / 10 : (n - 9) / 10;
    const double scale = std::pow(10.0, decade);
    const ThirdOctave band{kNominal[static_cast<std::size_t>(n - 10 * decade)] * scale,
                           std::pow(10.0, 0.1 * n)};
    if (band.high() - band.low() >= width * (1 - kRounding) && band.high() <= high * (1 + kRounding))
      bands.push_back(band);
  }
  return bands;
}

}  // namespace tread
