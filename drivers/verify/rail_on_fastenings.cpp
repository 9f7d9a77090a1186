// A rail on its fastenings against a Timoshenko beam on the same spring-dampers: deflection under the wheel,
// receptance of the rail head, pinned-pinned frequency.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "drivers/engine/beam/track_beam.hpp"
#include "drivers/engine/start/rail_beam.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/fastened_track.hpp"
#include "drivers/verify/rail_blow.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

namespace {

constexpr double kFirstFrequency = 50;   // [Hz]
constexpr double kLastFrequency = 3000;  // [Hz]

/// Rail over an even number of spans about x = 0 between two fastenings. The blow falls at the distance
/// `aside` from x = 0.
Scene struck_rail(const VerifyInputs& inputs, double element_size, double aside) {
  const double spacing = inputs["spacing"];
  const double spans = inputs["spans"];
  const std::string text =
      track_text(inputs, element_size) + fmt::format(R"([rail]
length = "{} m"
origin = "{} m"
[wheel]
present = false
[vehicle]
present = false
[contact]
present = false
[hammer]
position = "{} m"
force = "1 kN"
duration = "{} s"
[motion]
duration = "{} s"
)",
                                                     spans * spacing, 0.5 * spans * spacing, aside,
                                                     0.5 / kLastFrequency, inputs["duration"]);
  return resolve_scene(SceneSource{"verify", text, {}}, {fmt::format("fastenings.count={:.0f}", spans),
                                                         fmt::format("fastenings.first={} m", 0.5 * spacing)})
      .scene;
}

struct Strike {
  BlowRecord head;          ///< record of the struck point
  BlowRecord section;       ///< record of the mean of the cross-section there
  double energy_error = 0;  ///< residual over the hammer's work [-]
};

/// Throws if the response has not decayed: the Fourier integral of a motion that goes on is not a receptance.
void require_decay(const std::vector<double>& response) {
  constexpr double kLeft = 0.03;
  const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const double most = std::abs(*std::max_element(response.begin(), response.end(), larger));
  const double last = std::abs(*std::max_element(
      response.end() - static_cast<std::ptrdiff_t>(response.size() / 10), response.end(), larger));
  if (last > kLeft * most)
    throw InputError(
        fmt::format("verify: the rail still moves by {:.2g} % of its largest deflection when the observed "
                    "time ends: that is no "
                    "receptance; state a longer duration or more damping",
                    100 * last / most));
}

Strike strike(const Scene& scene, const ProgressText& progress) {
  constexpr double kInterval = 2e-5;  // time between samples [s]
  Model model(scene);
  const RailAxis axis(model);
  const double x = scene.hammer->position;
  Strike out;
  double head = 0;
  double section = 0;
  const EnergyLedger energy = run_blow(
      model, kInterval,
      [&](double time, ConstNodeField u) {
        const double at_head = -model.hammer->value(u, 2);
        const double of_section = axis.deflection(x, u);
        if (out.head.time.empty()) {
          head = at_head;
          section = of_section;
        }
        for (BlowRecord* record : {&out.head, &out.section}) {
          record->time.push_back(time);
          record->force.push_back(scene.hammer->force_at(time));
        }
        out.head.response.push_back(at_head - head);
        out.section.response.push_back(of_section - section);
      },
      progress);
  out.energy_error = std::abs(energy.residual) / energy.hammer_work;
  require_decay(out.section.response);
  return out;
}

std::vector<double> frequencies() {
  constexpr int kCount = 400;
  std::vector<double> f;
  for (int i = 0; i <= kCount; ++i)
    f.push_back(kFirstFrequency *
                std::pow(kLastFrequency / kFirstFrequency, static_cast<double>(i) / kCount));
  return f;
}

/// Frequency of the largest amplitude between low and high [Hz].
template <class Amplitude>
double peak(double low, double high, const Amplitude& amplitude) {
  double best = low;
  double most = 0;
  for (double f = low; f <= high; f += 0.1) {
    const double a = amplitude(f);
    if (a <= most) continue;
    most = a;
    best = f;
  }
  return best;
}

/// Root mean square of the difference of both amplitudes' levels [dB].
double level_difference(const BlowRecord& record, const TrackBeam& beam, double x, double low, double high) {
  double sum = 0;
  int count = 0;
  for (const double f : frequencies()) {
    if (f < low || f > high) continue;
    const double level = 20 * std::log10(std::abs(record.receptance(f)) / std::abs(beam.receptance(x, x, f)));
    sum += level * level;
    ++count;
  }
  return std::sqrt(sum / count);
}

Panel receptance_panel(const std::string& place, const Strike& strike, const TrackBeam& beam, double x) {
  Series section{"cross-section " + place, {}, {}, Stroke::solid};
  Series head{"struck point " + place, {}, {}, Stroke::dotted};
  Series theory{"Timoshenko beam " + place, {}, {}, Stroke::dashed};
  for (const double f : frequencies()) {
    for (Series* series : {&section, &head, &theory}) series->x.push_back(f);
    section.y.push_back(std::log10(std::abs(strike.section.receptance(f))));
    head.y.push_back(std::log10(std::abs(strike.head.receptance(f))));
    theory.y.push_back(std::log10(std::abs(beam.receptance(x, x, f))));
  }
  return {"log10 of [m/N]", {section, head, theory}, {}, 240, std::nullopt};
}

void add_static(const VerifyInputs& inputs, const ProgressText& progress, CaseResult& result) {
  const Scene scene =
      resolve_scene(SceneSource{"verify",
                                track_text(inputs, inputs["element_size"]) + R"([solution_zone]
start = "0 m"
length = "0.1 m"
[motion]
speed = "0 m/s"
duration = "1 ms"
)",
                                {}})
          .scene;
  Model model(scene);
  progress(fmt::format("wheelset on the rail: {} elements", model.elements()));
  const Preload preload = solve_preload(model, {}, progress);
  const BeamProperties rail = timoshenko(rail_beam_section(scene), scene.rail_material());
  const double force = model.wheel_load();
  const double theory = loaded_deflection(scene, 0, force);
  const double bed = scene.sleepers ? 1 / scene.sleepers->stiffness : 0;
  const double winkler = 1 / (1 / scene.fastenings->stiffness + bed) / scene.fastenings->spacing;
  const double line = force * std::pow(winkler / (4 * rail.bending_stiffness), 0.25) / (2 * winkler);
  result.findings.push_back({"deflection of the cross-section under the wheel", "mm",
                             1e3 * RailAxis(model).deflection(0, preload.displacement.data()), 1e3 * theory,
                             0.02});
  result.findings.push_back(
      {"the same of the foot", "mm", 1e3 * preload.rail_deflection, 1e3 * theory, 0.02});
  result.findings.push_back(
      {"the same against Winkler and Euler", "mm", 1e3 * preload.rail_deflection, 1e3 * line, {}});
}

/// A struck place of the rail.
struct StruckPlace {
  const char* name;
  const Strike* strike;
  double x;  ///< [m]
};

/// Receptances at 100 Hz and levels over frequency beside those of the beam.
void add_receptances(std::initializer_list<StruckPlace> places, const TrackBeam& beam, CaseResult& result) {
  const double low = std::sqrt(2.0) * kFirstFrequency;
  for (const auto& [name, strike, x] : places) {
    result.findings.push_back({fmt::format("receptance at 100 Hz, {}", name), "nm/N",
                               1e9 * std::abs(strike->section.receptance(100)),
                               1e9 * std::abs(beam.receptance(x, x, 100)), 0.05});
    result.findings.push_back({fmt::format("level of the receptance to 1.5 kHz, rms difference, {}", name),
                               "dB", level_difference(strike->section, beam, x, low, 1500), 0, 1.0, true});
    result.findings.push_back({fmt::format("the same, 1.5 to 3 kHz, {}", name),
                               "dB",
                               level_difference(strike->section, beam, x, 1500, kLastFrequency),
                               0,
                               {},
                               true});
  }
}

CaseResult rail_on_fastenings(const VerifyInputs& inputs, const ProgressText& progress) {
  const double h = inputs["element_size"];
  const double spacing = inputs["spacing"];
  if (std::fmod(inputs["spans"], 2) != 0)
    throw InputError(fmt::format(
        "verify: spans = {:g} is not an even number: x = 0 lies between two fastenings", inputs["spans"]));
  CaseResult result;
  add_static(inputs, progress, result);

  const Scene scene = struck_rail(inputs, h, 0);
  const BeamProperties rail = timoshenko(rail_beam_section(scene), scene.rail_material());
  const TrackBeam beam = rail_beam(scene, rail);
  const double span = 0;  // x of both places
  const double support = 0.5 * spacing;
  const Strike between = strike(scene, progress);
  const Strike over = strike(struck_rail(inputs, h, support), progress);
  const Strike coarse = strike(struck_rail(inputs, 1.5 * h, 0), progress);

  const double pinned = wave_frequency(rail, std::numbers::pi / spacing);
  const auto peak_of = [&](const BlowRecord& record) {
    return peak(0.7 * pinned, 1.4 * pinned, [&](double f) { return std::abs(record.receptance(f)); });
  };
  const double frequency = peak_of(between.section);
  const double of_beam =
      peak(0.7 * pinned, 1.4 * pinned, [&](double f) { return std::abs(beam.receptance(span, span, f)); });
  result.findings.push_back(
      {"pinned-pinned frequency, beam on the same fastenings", "Hz", frequency, of_beam, 0.03});
  result.findings.push_back({"the same, beam pinned at points", "Hz", frequency, pinned, {}});
  result.findings.push_back({"the same, elements of 1.5 h", "Hz", peak_of(coarse.section), frequency, 0.01});
  result.findings.push_back({"receptance there, between fastenings",
                             "nm/N",
                             1e9 * std::abs(between.section.receptance(frequency)),
                             1e9 * std::abs(beam.receptance(span, span, of_beam)),
                             {}});
  add_receptances({{"between fastenings", &between, span}, {"over a fastening", &over, support}}, beam,
                  result);
  result.findings.push_back(
      {"energy residual / work of the hammer", "-", between.energy_error, 0, 1e-3, true});

  Figure figure;
  figure.title = "Receptance of the rail";
  figure.caption =
      "The struck point moves by the indentation of the mesh under a point load more than its cross-section "
      "does.";
  figure.x_label = "Frequency [Hz]";
  figure.panels = {receptance_panel("between fastenings", between, beam, span),
                   receptance_panel("over a fastening", over, beam, support)};
  result.figures.push_back(figure);
  return result;
}

}  // namespace

VerifyCase rail_on_fastenings_case() {
  std::vector<VerifyInput> inputs = track_inputs();
  inputs.push_back({"spans", nullptr, "", 12, {4, 100}, "the spans of the struck rail, an even number"});
  inputs.push_back({"duration", &kTime, "ms", 50e-3, {5e-3, 1}, "the observed time"});
  return {"rail_on_fastenings",
          "a rail on its fastenings: deflection, receptance and pinned-pinned mode against a Timoshenko beam",
          std::move(inputs), rail_on_fastenings};
}

}  // namespace tread
