#include "drivers/results/force_spectrum.hpp"

#include <algorithm>
#include <cmath>

namespace tread {

namespace {

bool lies_between(const Sample& sample, double first, double last) {
  return sample.wheel_x >= first && sample.wheel_x <= last;
}

}  // namespace

double ForceSpectrum::lowest() const {
  const ThirdOctave one{1, 1};
  return kLinesOfASine * spacing / (one.high() - one.low());
}

std::optional<double> ForceSpectrum::amplitude(double low, double high) const {
  constexpr double kRounding = 1e-9;
  if (square.empty() || high - low < kLinesOfASine * spacing * (1 - kRounding) ||
      high > spacing * static_cast<double>(square.size() - 1))
    return std::nullopt;
  return std::sqrt(2 * band_power(square, spacing, low, high));
}

std::optional<ForceSine> ForceSpectrum::sine_of_wave(double length) const {
  const double frequency = speed / length;
  const double beside = 0.5 * kLinesOfASine * spacing;
  if (frequency < kWavesInRecord * spacing) return std::nullopt;
  const std::optional<double> found = amplitude(frequency - beside, frequency + beside);
  return found ? std::optional(ForceSine{length, frequency, *found}) : std::nullopt;
}

std::optional<ForceSine> ForceSpectrum::sine_of_elements(double length) const {
  const ThirdOctave band{speed / length, speed / length};
  const std::optional<double> found = amplitude(band.low(), band.high());
  return found ? std::optional(ForceSine{length, band.middle, *found}) : std::nullopt;
}

SampleIntervals sample_intervals(const std::vector<Sample>& samples, double first, double last) {
  SampleIntervals intervals;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (!lies_between(samples[i - 1], first, last) || !lies_between(samples[i], first, last)) continue;
    const double interval = samples[i].time - samples[i - 1].time;
    intervals.least = intervals.most == 0 ? interval : std::min(intervals.least, interval);
    intervals.most = std::max(intervals.most, interval);
  }
  return intervals;
}

ForceSpectrum force_spectrum(const std::vector<Sample>& samples, double first, double last, double dt) {
  constexpr std::size_t kLeast = 16;  // samples
  constexpr double kHighest = 20e3;   // [Hz]
  std::vector<double> force;
  Sample begin, end;
  for (const Sample& s : samples) {
    if (!lies_between(s, first, last)) {
      if (force.empty()) continue;
      break;  // brakes may turn the wheel back into the stretch
    }
    if (force.empty()) begin = s;
    end = s;
    force.push_back(s.vertical_force);
  }
  ForceSpectrum spectrum;
  if (force.size() < kLeast || !sample_intervals(samples, first, last).even(dt)) return spectrum;
  const auto count = static_cast<double>(force.size());
  const double interval = (end.time - begin.time) / (count - 1);
  spectrum.speed = (end.wheel_x - begin.wheel_x) / (end.time - begin.time);
  spectrum.spacing = 1 / (count * interval);
  const double highest = std::min(kHighest, 1 / (kSamplesInWave * interval));
  const auto lines = static_cast<std::size_t>(highest / spectrum.spacing) + 2;
  spectrum.square = power_lines(force, std::min(lines, force.size() / 2 + 1));
  spectrum.bands = third_octaves(kLinesOfASine * spectrum.spacing, highest);
  for (const ThirdOctave& band : spectrum.bands)
    spectrum.rms.push_back(std::sqrt(band_power(spectrum.square, spectrum.spacing, band.low(), band.high())));
  return spectrum;
}

}  // namespace tread
