// The half wheelset rolls over the smooth rail. The part of F_N that repeats with the fastenings is compared
// with a model: a wheelset that bends in its static shape, on a Hertz spring over the beam on equal
// fastenings.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "drivers/engine/beam/beam_passage.hpp"
#include "drivers/engine/start/rail_beam.hpp"
#include "drivers/engine/start/run_in.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/fastened_track.hpp"
#include "drivers/verify/force_harmonics.hpp"
#include "drivers/verify/ride.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

namespace {

constexpr double kEndOfRail = 0.5;  ///< least distance of the wheel from the rail's ends [m]
constexpr double kBeamStep = 2e-5;  ///< step of the beam's time integration [s]
constexpr double kBound = 0.15;     ///< largest error of a part of F_N over the beam's [-]
constexpr double kFloor = 0.3;      ///< error that always passes [% of static]; a smaller part has no crest

Scene passage_scene(const VerifyInputs& inputs) {
  const double way = inputs["spans"] * inputs["spacing"];
  const std::string text =
      track_text(inputs, inputs["element_size"]) + fmt::format(R"([solution_zone]
start = "0 m"
length = "{} m"
[motion]
speed = "{} m/s"
duration = "{} s"
)",
                                                               way, inputs["speed"], way / inputs["speed"]);
  return resolve_scene(SceneSource{"verify", text, {}}).scene;
}

ForceHistory rolled(Model& model, const Preload& preload, const ProgressText& progress) {
  const MotionSpec& motion = *model.scene.motion;
  const double stable = motion.step_safety * step_limit(model).stable_step;
  // The run is a little longer than the distance, so that it covers the distance.
  const auto steps = static_cast<std::int64_t>(std::ceil(1.002 * motion.duration / stable));
  constexpr double kInterval = 1e-5;
  WholeRun run(model, preload, stable, steps, std::max<std::int64_t>(1, std::llround(kInterval / stable)));
  ForceHistory curve;
  run.roll([&] {
    const Sample& sample = run.simulation.sample();
    curve.time.push_back(sample.time);
    curve.x.push_back(sample.wheel_x);
    curve.force.push_back(sample.vertical_force);
    if (curve.time.size() % 200 == 0)
      progress(fmt::format("x {:.3f} m, F_N {:.2f} kN", sample.wheel_x, 1e-3 * sample.vertical_force));
  });
  return curve;
}

/// The passage on the beam, started far enough behind to have settled.
ForceHistory rolled_on_beam(const MotionSpec& motion, const BeamVehicle& vehicle, const TrackBeam& beam) {
  const double start = beam.left() + kEndOfRail;
  BeamPassage passage(beam, vehicle, start, kBeamStep);
  ForceHistory curve;
  const double end = motion.speed * motion.duration + 0.01;
  for (double x = start; x < end;) {
    x = start + motion.speed * (passage.time() + kBeamStep);
    passage.step(x);
    if (x < 0) continue;
    curve.time.push_back(x / motion.speed);
    curve.x.push_back(x);
    curve.force.push_back(passage.force());
  }
  return curve;
}

/// F_N of both over the way, with the places of the fastenings and the static `load` [N].
Figure passing_figure(const Scene& scene, const ForceHistory& ours, const ForceHistory& theory, double load) {
  const double last = scene.motion->speed * scene.motion->duration;
  Series curve{"tread", {}, {}, Stroke::solid};
  Series reference{"beam model", {}, {}, Stroke::dashed};
  for (const auto& [from, to] : {std::pair{&ours, &curve}, std::pair{&theory, &reference}}) {
    to->x = from->x;
    for (const double force : from->force) to->y.push_back(1e-3 * force);
  }
  Figure figure;
  figure.title = "Contact force on the smooth rail";
  figure.x_label = "Position of the wheel [m]";
  figure.panels = {{"F_N [kN]", {curve, reference}, {{1e-3 * load, "static"}}, 260, std::nullopt}};
  const FasteningSpec& f = *scene.fastenings;
  for (int i = 0; i < f.count; ++i) {
    const double x = f.first + i * f.spacing - scene.rail->origin;
    if (x > 0 && x < last) figure.positions.push_back({x, i % 2 == 0 ? "fastening" : ""});
  }
  return figure;
}

CaseResult fastening_passing(const VerifyInputs& inputs, const ProgressText& progress) {
  const Scene scene = passage_scene(inputs);
  Model model(scene);
  const double spacing = scene.fastenings->spacing;
  const double last = scene.motion->speed * scene.motion->duration;
  progress(fmt::format("{} elements", model.elements()));
  const Preload preload = solve_preload(model, steady_motion(model), progress);
  const BeamVehicle vehicle =
      beam_vehicle(model, axle_bending(model, preload.displacement.data(), preload.wheel));
  const ForceHistory ours = rolled(model, preload, progress);
  const TrackBeam beam = rail_beam(scene, timoshenko(rail_beam_section(scene), scene.rail_material()));
  const ForceHistory theory = rolled_on_beam(*scene.motion, vehicle, beam);

  constexpr int kHarmonics = 3;
  const Harmonics a = harmonics(ours, spacing, 2, last, kHarmonics);
  const Harmonics end = harmonics(ours, spacing, 1, last, kHarmonics);
  const Harmonics before = harmonics(ours, spacing, 1, last - spacing, kHarmonics);
  const Harmonics b = harmonics(theory, spacing, 2, last, kHarmonics);
  const double load = model.wheel_load();
  const double first = 100 * b.amplitude[0] / load;  // [% of static]
  CaseResult result;
  const auto part = [&](const Harmonics& h) { return 100 * 0.5 * (h.high - h.low) / load; };
  result.findings = {
      judged_above_floor(
          {"half range of the part periodic with the fastenings / static", "%", part(a), part(b)}, kBound,
          kFloor),
      {"the same, last span alone", "%", part(end), part(a), {}},
      {"the same, the span before", "%", part(before), part(a), {}},
      judged_above_floor(
          {"amplitude of its first harmonic / static", "%", 100 * a.amplitude[0] / load, first}, kBound,
          kFloor),
      {"place of its crest in the span", "-", b.phase[0] + std::remainder(a.phase[0] - b.phase[0], 1.0),
       b.phase[0], first > kFloor ? std::optional(0.05) : std::nullopt, true},
      {"amplitude of its second harmonic / static",
       "%",
       100 * a.amplitude[1] / load,
       100 * b.amplitude[1] / load,
       {}},
      {"mean of F_N over both spans", "kN", 1e-3 * a.mean, 1e-3 * load, 0.01}};
  // The beam feels the fastenings more: its strip spreads short waves too little.
  // [docs/records/verification.md]
  if (inputs.defaults())
    for (const auto& [finding, difference] : {std::pair{0, -0.12}, std::pair{3, -0.08}})
      result.findings.push_back(
          beside_record(result.findings[static_cast<std::size_t>(finding)], difference, 0.03));

  result.figures.push_back(passing_figure(scene, ours, theory, load));
  return result;
}

}  // namespace

VerifyCase fastening_passing_case() {
  std::vector<VerifyInput> inputs = track_inputs();
  inputs.push_back({"speed", &kSpeed, "km/h", 300 / 3.6, {15, 150}, "the speed"});
  inputs.push_back({"spans", nullptr, "", 3, {3, 8}, "the spans of the way, the last two are evaluated"});
  return {"fastening_passing",
          "the half wheelset rolls over fastenings: the periodic part of F_N against a beam model",
          std::move(inputs), fastening_passing};
}

}  // namespace tread
