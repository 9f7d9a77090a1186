#include "core/corrugation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

namespace tread {

namespace {

double range_with_zero(const std::vector<double>& depth) {
  const auto [low, high] = std::minmax_element(depth.begin(), depth.end());
  return std::max(*high, 0.0) - std::min(*low, 0.0);
}

/// Random phase [rad], uniform in [0, 2 pi). Every machine gives the same number, unlike the library's
/// distributions.
double random_phase(std::mt19937_64& source) {
  return 2 * std::numbers::pi * std::ldexp(static_cast<double>(source() >> 11U), -53);
}

/// Places along the rail [m] at which random depths are sampled; `shortest` is the shortest wavelength [m].
std::vector<double> places(double length, double shortest) {
  constexpr double kSamples = 20;  // samples per wave; cubics join them
  const auto pieces = static_cast<std::size_t>(std::ceil(kSamples * length / shortest));
  std::vector<double> x;
  for (std::size_t i = 0; i <= pieces; ++i)
    x.push_back(length * static_cast<double>(i) / static_cast<double>(pieces));
  return x;
}

std::vector<double> random_depths(const Corrugation::Random& random, double length) {
  const std::vector<double> x = places(length, random.shortest);
  std::vector<double> depth(x.size(), 0.0);
  std::mt19937_64 source(random.seed);
  const double turn = 2 * std::numbers::pi / length;
  const auto [first, last] = waves_of(random.shortest, random.longest, length);
  const double amplitude = random.rms * std::sqrt(2.0 / std::max(1.0, last - first + 1));
  for (std::int64_t i = 0; first + static_cast<double>(i) <= last; ++i) {
    const double phase = random_phase(source);
    const double rate = turn * (first + static_cast<double>(i));
    for (std::size_t k = 0; k < x.size(); ++k) depth[k] += amplitude * std::cos(rate * x[k] + phase);
  }
  for (std::size_t i = 0; i < x.size(); ++i) depth[i] *= end_taper(x[i], length, 0.5 * random.longest);
  return depth;
}

}  // namespace

WaveRange waves_of(double shortest, double longest, double length) {
  return {std::ceil(length / longest - 1e-9), std::floor(length / shortest + 1e-9)};
}

double end_taper(double x, double length, double fade) {
  const double inside = std::min(x, length - x);
  if (inside >= fade) return 1;
  return inside <= 0 ? 0 : 0.5 * (1 - std::cos(std::numbers::pi * inside / fade));
}

Corrugation::Corrugation(Sine sine, double start, double length, double centre, double width)
    : sine_(sine),
      first_(start),
      last_(start + std::floor(length / sine.wavelength + 1e-9) * sine.wavelength),
      centre_(centre),
      width_(width),
      deepest_(sine.depth),
      steepest_(std::numbers::pi * sine.depth / sine.wavelength) {}

Corrugation::Corrugation(std::vector<double> x, std::vector<double> depth, double start, double centre,
                         double width)
    : first_(start + x.front()),
      last_(start + x.back()),
      centre_(centre),
      width_(width),
      deepest_(range_with_zero(depth)) {
  for (double& at : x) at += start;
  curve_ = MonotoneCubic(std::move(x), std::move(depth));
  steepest_ = curve_.steepest();
}

Corrugation::Corrugation(DepthShapePointer map, double start, double centre, double width)
    : first_(start + map->bounds().first),
      last_(start + map->bounds().last),
      centre_(centre),
      width_(width),
      deepest_(map->bounds().deepest + map->bounds().highest),
      steepest_(map->bounds().steepest),
      map_(std::move(map)),
      map_start_(start) {}

Corrugation Corrugation::rough(const Random& random, double start, double length, double centre,
                               double width) {
  return {places(length, random.shortest), random_depths(random, length), start, centre, width};
}

std::optional<double> first_difference(const Corrugation& a, const Corrugation& b, double end,
                                       double tolerance) {
  constexpr double kStep = 5e-5;  // [m]
  // If both depths agree along the centre lines, other widths, centres or maps still show further out. Maps
  // are linear between their rows.
  constexpr int kPlaces = 16;  // to either side
  std::vector<double> across;
  for (const Corrugation* of : {&a, &b}) {
    for (int i = -kPlaces; i <= kPlaces; ++i) across.push_back(of->centre() + i * of->width() / kPlaces);
    const DepthShapeView map = of->view().map.shape;
    across.insert(across.end(), map.y, map.y + map.rows);
  }
  std::sort(across.begin(), across.end());
  across.erase(std::unique(across.begin(), across.end()), across.end());
  const auto start = [](const Corrugation& c) {
    return c.smooth() ? std::numeric_limits<double>::infinity() : c.first();
  };
  const double first = std::min(start(a), start(b));
  for (std::int64_t i = 0; first + static_cast<double>(i) * kStep <= end; ++i) {
    const double x = first + static_cast<double>(i) * kStep;
    for (const double y : across)
      if (std::abs(a.depth(x, y) - b.depth(x, y)) > tolerance) return x;
  }
  return std::nullopt;
}

}  // namespace tread
