#include "drivers/results/force_spectrum.hpp"

#include <algorithm>
#include <cmath>

namespace tread {

namespace {

bool lies_between(const Sample& sample, double first, double last) {
  return sample.wheel_x >= first && sample.wheel_x <= last;
}

}  // namespace

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
  double begin = 0;
  double end = 0;
  for (const Sample& s : samples) {
    if (!lies_between(s, first, last)) {
      if (force.empty()) continue;
      break;  // brakes may turn the wheel back into the stretch
    }
    if (force.empty()) begin = s.time;
    end = s.time;
    force.push_back(s.vertical_force);
  }
  ForceSpectrum spectrum;
  if (force.size() < kLeast || !sample_intervals(samples, first, last).even(dt)) return spectrum;
  const auto count = static_cast<double>(force.size());
  const double interval = (end - begin) / (count - 1);
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
