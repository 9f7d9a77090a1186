#include "drivers/studies/roughness/roughness_levels.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/error.hpp"
#include "core/math/spectrum.hpp"
#include "core/parallel/each_item.hpp"

namespace tread {

namespace {

constexpr double kReference = 1e-6;  // [m]

}  // namespace

const std::vector<RoughnessBand>& roughness_bands() {
  static const std::vector<RoughnessBand> bands = [] {
    // Nominal wavelength [mm] and limit [dB]. [ISO 3095:2013, Fig. 2]
    constexpr double kTable[][2] = {{400, 17.1},  {315, 15.0},  {250, 13.0}, {200, 11.0}, {160, 9.0},
                                    {125, 7.0},   {100, 4.9},   {80, 2.9},   {63, 0.9},   {50, -1.1},
                                    {40, -3.2},   {31.5, -5.0}, {25, -5.6},  {20, -6.2},  {16, -6.8},
                                    {12.5, -7.4}, {10, -8.0},   {8, -8.6},   {6.3, -9.2}, {5, -9.8},
                                    {4, -10.4},   {3.15, -11.0}};
    std::vector<RoughnessBand> list;
    for (const auto& [nominal, limit] : kTable)
      list.push_back(
          {{1e-3 * nominal, 1e-3 * std::pow(10.0, std::round(10 * std::log10(nominal)) / 10)}, limit});
    return list;
  }();
  return bands;
}

RoughnessLevels roughness_levels(const RoughnessProfile& profile, double segment) {
  const std::size_t count = std::min(
      profile.height.size(), static_cast<std::size_t>(std::max(1.0, std::round(segment / profile.spacing))));
  RoughnessLevels levels;
  levels.segment_length = static_cast<double>(count) * profile.spacing;
  const double line = 1 / levels.segment_length;  // spacing of the lines [1/m]
  const auto resolved = [&](const RoughnessBand& band) {
    return kWavesInRecord * band.nominal <= levels.segment_length * (1 + 1e-9) &&
           band.low() >= kSamplesInWave * profile.spacing;
  };
  const std::vector<RoughnessBand>& bands = roughness_bands();
  double finest = 0;
  for (const RoughnessBand& band : bands)
    if (resolved(band)) finest = std::max(finest, 1 / band.low());
  if (finest == 0)
    throw InputError(
        fmt::format("no band of 400 to 3.15 mm fits a record of {:.4g} m with a sample every {:.3g} mm: a "
                    "segment must hold "
                    "{} waves, a wave {} samples; measure longer or finer, or state a longer --segment",
                    profile.length(), 1e3 * profile.spacing, kWavesInRecord, kSamplesInWave));

  const std::size_t lines = std::min(count / 2 + 1, static_cast<std::size_t>(std::lround(finest / line)) + 2);
  const std::size_t hop = std::max<std::size_t>(1, count / 2);
  // As many segments as lie at most half a segment apart, evenly, the last at the record's end.
  const std::size_t way = profile.height.size() - count;
  const std::size_t gaps = (way + hop - 1) / hop;
  const std::size_t segments = gaps + 1;
  std::vector<std::vector<double>> spectra(segments);
  each_item(segments, [&](std::size_t i) {
    const std::size_t first = gaps > 0 ? i * way / gaps : 0;
    spectra[i] = power_lines(std::span(profile.height).subspan(first, count), lines);
  });
  levels.segments = static_cast<int>(segments);
  for (const RoughnessBand& band : bands) {
    if (!resolved(band)) {
      levels.level.emplace_back();
      continue;
    }
    double square = 0;
    for (const std::vector<double>& s : spectra)
      square += band_power(s, line, 1 / band.high(), 1 / band.low()) / static_cast<double>(segments);
    levels.level.emplace_back(10 * std::log10(square / (kReference * kReference)));
  }
  return levels;
}

}  // namespace tread
