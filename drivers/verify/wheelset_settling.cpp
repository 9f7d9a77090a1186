// The standing half wheelset after a step of load: an oscillation at about half of critical damping. The
// reference is a wheelset that bends in its static shape, on a Hertz spring over the beam on equal
// fastenings.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/engine/beam/beam_passage.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/rail_beam.hpp"
#include "drivers/engine/start/run_in.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/fastened_track.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

namespace {

constexpr double kInterval = 2e-5;  ///< time between samples, and the beam's step [s]

/// Downward displacement since the step of load, at evenly spaced times [m].
using Settling = std::vector<double>;

Scene standing_scene(const VerifyInputs& inputs, double sprung_mass) {
  const std::string text =
      track_text(inputs, inputs["element_size"]) + fmt::format(R"([vehicle]
sprung_mass = "{} kg"
[solution_zone]
start = "0 m"
length = "0.1 m"
[motion]
speed = "0 m/s"
duration = "{} s"
)",
                                                               sprung_mass, inputs["duration"]);
  return resolve_scene(SceneSource{"verify", text, {}}).scene;
}

/// Settling from the static state of the lighter vehicle under the heavier one.
Settling settle(Model& model, const Preload& preload, const VerifyInputs& inputs,
                const ProgressText& progress) {
  model.scene.vehicle->sprung_mass += inputs["added_mass"];
  const double stable = model.scene.motion->step_safety * step_limit(model).stable_step;
  const auto every = static_cast<std::int64_t>(std::ceil(kInterval / stable));
  Simulation simulation(model, preload, kInterval / static_cast<double>(every));
  simulation.set_sampling_interval(every);
  Settling settling;
  double start = 0;
  const auto samples = static_cast<std::int64_t>(std::ceil(inputs["duration"] / kInterval));
  for (std::int64_t i = 0; i <= samples * every; ++i) {
    if (i % every == 0) {
      const BodyFrame& frame = simulation.wheel();
      const double height = frame.origin.z + rim_displacement(model, simulation.displacement(), frame).z;
      if (settling.empty()) start = height;
      settling.push_back(start - height);
    }
    simulation.step();
    if (!simulation.sampled()) continue;
    if (i % (100 * every) == 0)
      progress(fmt::format("t {:.2f} ms, rim {:.2f} um lower, F_N {:.3f} kN", 1e3 * simulation.time(),
                           1e6 * settling.back(), 1e-3 * simulation.sample().vertical_force));
  }
  return settling;
}

Settling settle_on_beam(const TrackBeam& beam, const BeamVehicle& vehicle, double added_mass,
                        std::size_t count) {
  BeamPassage passage(beam, vehicle, 0, kInterval);
  const double start = passage.wheel();
  passage.add_sprung_mass(added_mass);
  Settling settling = {0};
  while (settling.size() < count) {
    passage.step(0);
    settling.push_back(passage.wheel() - start);
  }
  return settling;
}

/// The oscillator of one degree of freedom whose step response fits best.
struct Oscillator {
  double frequency = 0;  ///< undamped frequency [Hz]
  double damping = 0;    ///< damping ratio zeta, of critical [-]
};

/// Step response of the oscillator of static deflection 1.
double step_response(const Oscillator& o, double time) {
  const double w = 2 * std::numbers::pi * o.frequency;
  const double z = o.damping;
  if (z < 1) {
    const double d = w * std::sqrt(1 - z * z);
    return 1 - std::exp(-z * w * time) * (std::cos(d * time) + z * w / d * std::sin(d * time));
  }
  const double root = w * std::sqrt(std::max(z * z - 1, 1e-12));
  const double fast = z * w + root;
  const double slow = z * w - root;
  return 1 - (fast * std::exp(-slow * time) - slow * std::exp(-fast * time)) / (fast - slow);
}

/// Sum of squares that the oscillator leaves over, with the best size.
double misfit(const Settling& settling, const Oscillator& o) {
  double rr = 0, rs = 0, ss = 0;
  for (std::size_t i = 0; i < settling.size(); ++i) {
    const double r = step_response(o, static_cast<double>(i) * kInterval);
    rr += r * r;
    rs += r * settling[i];
    ss += settling[i] * settling[i];
  }
  return ss - rs * rs / rr;
}

Oscillator fitted(const Settling& settling) {
  Oscillator best{40, 1};
  double least = misfit(settling, best);
  for (double factor = 1.3; factor > 1.0001;) {
    bool better = false;
    for (const auto& [f, z] :
         {std::pair{factor, 1.0}, std::pair{1 / factor, 1.0}, std::pair{1.0, factor},
          std::pair{1.0, 1 / factor}, std::pair{factor, factor}, std::pair{1 / factor, 1 / factor},
          std::pair{factor, 1 / factor}, std::pair{1 / factor, factor}}) {
      const Oscillator o{best.frequency * f, best.damping * z};
      const double left = misfit(settling, o);
      if (left >= least) continue;
      least = left;
      best = o;
      better = true;
      break;
    }
    if (!better) factor = std::sqrt(factor);
  }
  return best;
}

/// First time at which the deflection reaches a share of its last value [s].
double rise(const Settling& settling, double share) {
  std::size_t i = 0;
  while (settling[i] < share * settling.back()) ++i;
  return static_cast<double>(i) * kInterval;
}

CaseResult wheelset_settling(const VerifyInputs& inputs, const ProgressText& progress) {
  const Scene scene = standing_scene(inputs, inputs["sprung_mass"]);
  Model model(scene);
  progress(fmt::format("{} elements", model.elements()));
  const Preload preload = solve_preload(model, {}, progress);
  const BeamVehicle vehicle =
      beam_vehicle(model, axle_bending(model, preload.displacement.data(), preload.wheel));
  const Settling ours = settle(model, preload, inputs, progress);
  const TrackBeam beam = rail_beam(scene, timoshenko(rail_beam_section(scene), scene.rail_material()));
  const Settling theory = settle_on_beam(beam, vehicle, inputs["added_mass"], ours.size());

  const double last = theory.back();
  double worst = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) worst = std::max(worst, std::abs(ours[i] - theory[i]));
  const auto overshoot = [](const Settling& s) {
    return *std::max_element(s.begin(), s.end()) / s.back() - 1;
  };
  const Oscillator a = fitted(ours);
  const Oscillator b = fitted(theory);
  CaseResult result;
  result.findings = {
      {"largest difference of both settling curves / last value", "-", worst / last, 0, 0.05, true},
      {"damping ratio of the oscillator that fits best", "-", a.damping, b.damping, {}},
      {"its undamped frequency", "Hz", a.frequency, b.frequency, 0.1},
      {"time to half of the last value", "ms", 1e3 * rise(ours, 0.5), 1e3 * rise(theory, 0.5), 0.05},
      {"time to nine tenths of it", "ms", 1e3 * rise(ours, 0.9), 1e3 * rise(theory, 0.9), 0.1},
      {"overshoot / last value", "-", overshoot(ours), overshoot(theory), 0.05, true}};
  // The solid wheelset on its rail is damped more than the beam model. [docs/records/verification.md]
  if (inputs.defaults()) {
    result.findings.push_back(beside_record(result.findings[1], 0.2, 0.03));
    result.findings.push_back(beside_record(result.findings[5], -0.038, 0.01));
  }
  Series curve{"tread", {}, {}, Stroke::solid};
  Series reference{"beam model", {}, {}, Stroke::dashed};
  for (std::size_t i = 0; i < ours.size(); ++i) {
    for (Series* s : {&curve, &reference}) s->x.push_back(1e3 * static_cast<double>(i) * kInterval);
    curve.y.push_back(1e6 * ours[i]);
    reference.y.push_back(1e6 * theory[i]);
  }
  Figure figure;
  figure.title = "The wheelset after a step of load";
  figure.x_label = "Time [ms]";
  figure.panels = {{"Wheelset, downwards [um]", {curve, reference}, {}, 260, std::nullopt}};
  result.figures.push_back(figure);
  return result;
}

}  // namespace

VerifyCase wheelset_settling_case() {
  std::vector<VerifyInput> inputs = track_inputs();
  inputs.push_back(
      {"sprung_mass", &kMass, "kg", 7000, {100, 1e5}, "the sprung mass before the step of load"});
  inputs.push_back({"added_mass", &kMass, "kg", 1000, {1, 1e4}, "the sprung mass that the step adds"});
  inputs.push_back({"duration", &kTime, "ms", 20e-3, {10e-3, 1}, "the observed time"});
  return {"wheelset_settling", "the standing wheelset after a step of load, against a beam model",
          std::move(inputs), wheelset_settling};
}

}  // namespace tread
