// Bending waves of the free rail against Timoshenko's beam. The ends do not turn, so the modes are pure
// cosines: the n-th mode of a rail of length L has the wave number n pi / L exactly, for beam and solid
// alike.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "drivers/engine/beam/track_beam.hpp"
#include "drivers/engine/start/rail_beam.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/rail_blow.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

namespace {

struct Mode {
  double wave_number = 0;  ///< [1/m]
  double frequency = 0;    ///< [Hz]
};

Scene free_rail(const VerifyInputs& inputs, double element_size) {
  const std::string text = fmt::format(
      R"([scene]
based_on = "highspeed-slab-2014"
element_size = "{h} m"
gravity = "0 m/s2"
[wheel]
present = false
[vehicle]
present = false
[contact]
present = false
[slab]
present = false
[fastenings]
present = false
[rail]
inclination = 0
support = "free"
length = "{length} m"
origin = "0 m"
[hammer]
force = "1 kN"
duration = "{blow} s"
[motion]
duration = "{duration} s"
)",
      fmt::arg("h", element_size), fmt::arg("length", inputs["length"]),
      fmt::arg("blow", 0.5 / inputs["highest_frequency"]), fmt::arg("duration", inputs["duration"]));
  return resolve_scene(SceneSource{"verify", text, {}}).scene;
}

/// The modes of the rail, each by the amplitude of its cosine after a blow on the left end, from half to
/// twice the beam's frequency.
std::vector<Mode> rail_modes(const Scene& scene, const BeamProperties& beam, int count,
                             const ProgressText& progress) {
  constexpr double kInterval = 2e-5;  // time between samples [s]
  Model model(scene);
  const RailAxis axis(model);
  const std::vector<double>& x = axis.stations();
  const double left = x.front();
  const double length = x.back() - left;
  std::vector<std::vector<double>> amplitudes(static_cast<std::size_t>(count));
  const auto sample = [&](double time, ConstNodeField u) {
    if (time < scene.hammer->duration) return;
    std::vector<double> sums(amplitudes.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double w = axis.deflection(x[i], u);
      const double share = 0.5 * (x[std::min(i + 1, x.size() - 1)] - x[i == 0 ? 0 : i - 1]);
      for (std::size_t n = 0; n < sums.size(); ++n)
        sums[n] +=
            share * w * std::cos(static_cast<double>(n + 1) * std::numbers::pi * (x[i] - left) / length);
    }
    for (std::size_t n = 0; n < sums.size(); ++n) amplitudes[n].push_back(sums[n]);
  };
  run_blow(model, kInterval, sample, progress);
  std::vector<Mode> modes;
  for (int n = 1; n <= count; ++n) {
    const double wave = n * std::numbers::pi / length;
    const double theory = wave_frequency(beam, wave);
    modes.push_back({wave, harmonic_frequency(amplitudes[static_cast<std::size_t>(n - 1)], kInterval,
                                              0.5 * theory, 2 * theory)});
  }
  return modes;
}

/// Throws InputError where the observed time is too short to tell the frequency of the rail's first mode.
void require_half_a_period(const VerifyInputs& inputs, const BeamProperties& beam) {
  const double half = 0.5 / wave_frequency(beam, std::numbers::pi / inputs["length"]);
  if (inputs["duration"] >= half) return;
  throw InputError(fmt::format(
      "verify: duration = {:.3g} ms is shorter than half a period, {:.3g} ms, of the first mode of "
      "a rail of length = {:g} m; state a longer duration or a shorter rail",
      1e3 * inputs["duration"], 1e3 * half, inputs["length"]));
}

Figure dispersion_figure(const std::vector<Mode>& modes, const BeamProperties& beam,
                         const BeamProperties& slender) {
  Series ours{"tread", {}, {}, Stroke::solid};
  Series theory{"Timoshenko", {}, {}, Stroke::dashed};
  Series thin{"Euler", {}, {}, Stroke::dotted};
  Series error{"tread against Timoshenko", {}, {}, Stroke::solid};
  const double highest = modes.back().frequency;
  for (const Mode& mode : modes) {
    ours.x.push_back(mode.frequency);
    ours.y.push_back(mode.wave_number);
    error.x.push_back(mode.frequency);
    error.y.push_back(100 * (mode.frequency / wave_frequency(beam, mode.wave_number) - 1));
  }
  for (int i = 1; i <= 100; ++i) {
    const double f = highest * i / 100;
    theory.x.push_back(f);
    theory.y.push_back(wave_number(beam, f));
    thin.x.push_back(f);
    thin.y.push_back(wave_number(slender, f));
  }
  Figure figure;
  figure.title = "Bending waves of the free rail";
  figure.x_label = "Frequency [Hz]";
  figure.panels = {{"Wave number [1/m]", {ours, theory, thin}, {}, 240, std::nullopt},
                   {"Difference [%]", {error}, {}, 140, std::nullopt}};
  return figure;
}

CaseResult rail_waves(const VerifyInputs& inputs, const ProgressText& progress) {
  const double h = inputs["element_size"];
  const double highest = inputs["highest_frequency"];
  const Scene scene = free_rail(inputs, h);
  const BeamSection section = rail_beam_section(scene);
  const BeamProperties beam = timoshenko(section, scene.rail_material());
  const int count = static_cast<int>(wave_number(beam, highest) * inputs["length"] / std::numbers::pi);
  if (count < 2)
    throw InputError(fmt::format("verify: length = {:g} m holds no wave up to {:g} Hz; state a longer rail",
                                 inputs["length"], highest));
  require_half_a_period(inputs, beam);
  const std::vector<Mode> modes = rail_modes(scene, beam, count, progress);
  const std::vector<Mode> coarse = rail_modes(free_rail(inputs, 1.5 * h), beam, count, progress);

  CaseResult result;
  double worst = 0;
  double change = 0;
  for (std::size_t n = 0; n < modes.size(); ++n) {
    const double theory = wave_frequency(beam, modes[n].wave_number);
    worst = std::max(worst, std::abs(modes[n].frequency / theory - 1));
    change = std::max(change, std::abs(coarse[n].frequency / modes[n].frequency - 1));
  }
  result.findings.push_back(
      {fmt::format("largest error of {} waves up to {:g} Hz", count, highest), "-", worst, 0, 0.03, true});
  for (const std::size_t n : {std::size_t{0}, (modes.size() - 1) / 2, modes.size() - 1})
    result.findings.push_back(
        {fmt::format("frequency at the wavelength {:.3f} m", 2 * std::numbers::pi / modes[n].wave_number),
         "Hz", modes[n].frequency, wave_frequency(beam, modes[n].wave_number), 0.03});
  result.findings.push_back({"largest change by elements of 1.5 h", "-", change, 0, 0.03, true});
  result.findings.push_back({"Cowper's shear coefficient of the section (known range 0.34 to 0.53)", "-",
                             section.shear_coefficient, 0.41, 0.01, true});
  result.figures.push_back(dispersion_figure(modes, beam, euler(section, scene.rail_material())));
  return result;
}

}  // namespace

VerifyCase rail_waves_case() {
  return {"rail_waves",
          "bending waves of the free rail after a blow, against Timoshenko's beam",
          {{"element_size", &kLength, "mm", 4e-3, {1e-3, 6e-3}, "the elements' size in the contact surface"},
           {"length", &kLength, "m", 3, {0.5, 20}, "the length of the rail"},
           {"highest_frequency", &kFrequency, "Hz", 3000, {100, 4000}, "the highest frequency"},
           {"duration", &kTime, "ms", 20e-3, {5e-3, 1}, "the observed time"}},
          rail_waves};
}

}  // namespace tread
