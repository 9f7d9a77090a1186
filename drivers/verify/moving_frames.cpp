// Long motions of a wheel in its moving frame: conserved quantities must not drift. [theory.md, Body frames]

#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/error.hpp"
#include "core/math/hertz.hpp"
#include "core/mesh/structured.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/ride.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

namespace {

constexpr int kCurveSamples = 1000;
constexpr double kYoungsModulus = 205.9e9;  // [Pa]
constexpr double kPoissonsRatio = 0.3;

/// A plain ring of steel; elements have one size over the whole turn.
struct Ring {
  double radius = 0;        ///< [m]
  double element_size = 0;  ///< [m]
  double speed = 0;         ///< [m/s]
  bool slice = false;       ///< true for a ring one element wide, in plane strain
  double way = 0;           ///< [m]
  double damping = 0;       ///< fraction of critical at the highest frequency [-]
  std::string more;         ///< further tables of the scene

  /// Radial thickness [m]. A slice carries its load in bending and is therefore thick.
  double thickness() const {
    return std::max(3.0, std::round((slice ? 0.4 : 0.14) * radius / element_size)) * element_size;
  }
  double width() const { return slice ? element_size : thickness(); }
  /// Length in which elements have one size [m]: at least a turn, otherwise the ring would be out of balance.
  double fine() const { return std::max(way, 1.01 * 2 * std::numbers::pi * radius); }
  Scene scene() const;
};

Scene Ring::scene() const {
  const std::string text = fmt::format(
      R"([scene]
element_size = "{h} m"
gravity = "0 m/s2"
plane_strain = {slice}
[solution_zone]
start = "0 m"
length = "{zone} m"
[material.steel]
youngs_modulus = "{E} Pa"
poissons_ratio = {nu}
density = "{density} kg/m3"
damping = {{ kind = "high_frequency_fraction", value = {damping} }}
[wheel]
shape = "tyre"
profile = "cylinder"
diameter = "{diameter} m"
width = "{width} m"
thickness = "{thickness} m"
lateral_offset = "0 mm"
[motion]
speed = "{speed} m/s"
duration = "{duration} s"
{more})",
      fmt::arg("h", element_size), fmt::arg("slice", slice), fmt::arg("E", kYoungsModulus),
      fmt::arg("nu", kPoissonsRatio), fmt::arg("zone", fine()), fmt::arg("density", kSteelDensity),
      fmt::arg("damping", damping), fmt::arg("diameter", 2 * radius), fmt::arg("width", width()),
      fmt::arg("thickness", thickness()), fmt::arg("speed", speed), fmt::arg("duration", way / speed),
      fmt::arg("more", more));
  return resolve_scene(SceneSource{"verify", text, {}}).scene;
}

/// The ring's state at a sample.
struct FrameMoment {
  double step = 0;
  double time = 0;            ///< [s]
  Vec3 mass_centre;           ///< [m]
  double speed = 0;           ///< [m/s]
  double spin = 0;            ///< [rad/s]
  double mean_stress = 0;     ///< mean Von Mises stress over the ring's elements [Pa]
  double largest_stress = 0;  ///< [Pa]
  double force = 0;           ///< F_N [N]
  double residual = 0;        ///< residual of the energy balance [J]
  double loss = 0;            ///< loss by the lead of the contact forces [J]
};

struct FrameRun {
  std::vector<FrameMoment> moments;
  double mass = 0;         ///< mass of the ring [kg]
  double inertia = 0;      ///< moment of inertia about its axis [kg m2]
  double kinetic = 0;      ///< kinetic energy at the start [J]
  double hoop_stress = 0;  ///< mean hoop stress over the section at the start [Pa]
  double wanted_hoop = 0;  ///< hoop stress that balances the centrifugal force of half the ring [Pa]

  /// Change over the run by the least-squares line through the values after the first tenth.
  template <class Value>
  double trend(const Value& value) const {
    LineFit line;
    const double length = moments.back().time;
    for (const FrameMoment& m : moments)
      if (m.time >= 0.1 * length) line.add(m.time / length, value(m) - value(moments.front()));
    return line.slope();
  }
};

/// Mean hoop stress over the section, and rho spin^2 times the mean of r^2. The centrifugal force of half a
/// ring is balanced by its two cuts, for any material law.
void compare_hoop(const Model& model, ConstNodeField u, double spin, FrameRun& run) {
  const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(model.index.tread)];
  const AreaMoments section = area_moments(block.section);
  double force = 0;
  for (int quad = 0; quad < static_cast<int>(block.section.quads.size()); ++quad)
    for (int station = 0; station < block.station_count(); ++station)
      force += quad_area(block.section, quad) / block.station_count() *
               model.internal->stress(model.index.tread, quad, station, u)[0];
  run.hoop_stress = force / section.area;
  const double second = section.yy / section.area + section.centroid.y * section.centroid.y;
  run.wanted_hoop = kSteelDensity * spin * spin * second;
}

FrameMoment moment_of(const Model& model, const Simulation& simulation) {
  const Sample& sample = simulation.sample();
  const ConstNodeField u = simulation.displacement();
  const MeanMotion mean = model.wheelset->mean_motion(u, simulation.velocity(), simulation.wheel());
  FrameMoment m;
  m.step = static_cast<double>(simulation.steps());
  m.time = simulation.time();
  m.mass_centre = simulation.wheel().origin + mean.displacement;
  m.speed = sample.wheel_speed;
  m.spin = sample.wheel_spin;
  m.force = sample.vertical_force;
  m.residual = sample.energy.residual;
  m.loss = sample.energy.contact_loss;
  const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(model.index.tread)];
  const int quads = static_cast<int>(block.section.quads.size());
  for (int station = 0; station < block.station_count(); ++station)
    for (int quad = 0; quad < quads; ++quad) {
      const double stress = von_mises(model.internal->stress(model.index.tread, quad, station, u));
      m.mean_stress += stress / (quads * block.station_count());
      m.largest_stress = std::max(m.largest_stress, stress);
    }
  return m;
}

/// The largest step at which the ring's scene over a short way runs [s].
double step_on_short_way(Ring ring) {
  ring.way = std::min(ring.way, 4 * ring.element_size);
  const Model model(ring.scene());
  return model.scene.motion->step_safety * step_limit(model).stable_step;
}

FrameRun run_ring(const Ring& ring, std::int64_t wanted, const ProgressText& progress) {
  Model model(ring.scene());
  const Preload preload = solve_preload(model, steady_motion(model), progress);
  WholeRun whole = whole_run(model, preload, kCurveSamples, wanted);
  const Simulation& simulation = whole.simulation;
  progress(fmt::format("{} elements, {} steps of {:.3e} s, {:.3g} m", model.elements(), whole.steps,
                       simulation.dt(), ring.way));
  FrameRun run;
  run.mass = model.wheelset->mass();
  run.inertia = model.wheelset->inertia();
  const auto started = std::chrono::steady_clock::now();
  whole.roll([&] {
    run.moments.push_back(moment_of(model, simulation));
    if (run.moments.size() == 1) {
      run.kinetic = simulation.sample().energy.kinetic;
      compare_hoop(model, simulation.displacement(), simulation.wheel().spin, run);
    }
    if (run.moments.size() % 100 != 0) return;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - started;
    const FrameMoment& m = run.moments.back();
    progress(fmt::format("step {:.0f}, {:.1f} us a step, mean stress {:.6f} MPa, spin {:.9f} rad/s", m.step,
                         1e6 * passed.count() / m.step, 1e-6 * m.mean_stress, m.spin));
  });
  return run;
}

/// Rigid ground under the slice: three rows of elements on a fixed bottom.
std::string ground(const Ring& ring, double load) {
  const double end = 0.1 * ring.radius + 0.1;
  return fmt::format(R"([rail]
profile = "box"
support = "rigid"
inclination = 0
length = "{length} m"
origin = "{end} m"
width = "{h} m"
height = "{height} m"
[load]
wheel_load = "{load} N"
[contact]
friction = 0
)",
                     fmt::arg("length", ring.fine() + 2 * end), fmt::arg("end", end),
                     fmt::arg("h", ring.element_size), fmt::arg("height", 3 * ring.element_size),
                     fmt::arg("load", load));
}

Figure drift_figure(const std::string& title, const FrameRun& run) {
  Series mean{"mean", {}, {}, Stroke::solid};
  Series largest{"largest", {}, {}, Stroke::dashed};
  Series spin{"spin", {}, {}, Stroke::solid};
  Series speed{"speed", {}, {}, Stroke::dashed};
  Series residual{"residual", {}, {}, Stroke::solid};
  const FrameMoment& first = run.moments.front();
  for (const FrameMoment& m : run.moments) {
    for (Series* s : {&mean, &largest, &spin, &speed, &residual}) s->x.push_back(m.step);
    mean.y.push_back(1e-6 * m.mean_stress);
    largest.y.push_back(1e-6 * m.largest_stress);
    spin.y.push_back(m.spin / first.spin - 1);
    speed.y.push_back(m.speed / first.speed - 1);
    residual.y.push_back(m.residual);
  }
  Figure figure;
  figure.title = title;
  figure.x_label = "Step";
  figure.panels = {{"Von Mises stress [MPa]", {mean, largest}, {}, 200, std::nullopt},
                   {"Relative change [-]", {spin, speed}, {}, 200, std::nullopt},
                   {"Energy residual [J]", {residual}, {}, 160, std::nullopt}};
  return figure;
}

/// Bounds of the changes over a run, relative to the values at the start. `way`: bound of the mass centre's
/// distance from its straight line, relative to its length.
struct DriftBounds {
  double stress;
  std::optional<double> speed;
  double way;
  std::optional<double> energy;
};

void add_drifts(const std::string& name, const FrameRun& run, const DriftBounds& bounds, CaseResult& result) {
  const FrameMoment& first = run.moments.front();
  const FrameMoment& last = run.moments.back();
  const auto relative = [&](double FrameMoment::*value) {
    return run.trend([&](const FrameMoment& m) { return m.*value; }) / (first.*value);
  };
  double worst = 0;
  for (const FrameMoment& m : run.moments) worst = std::max(worst, std::abs(m.residual));
  const double way = first.speed * (last.time - first.time);
  const Vec3 off = last.mass_centre - first.mass_centre - Vec3{way, 0, 0};
  const auto add = [&](const char* quantity, double value, std::optional<double> bound) {
    result.findings.push_back({name + ": " + quantity, "-", value, 0, bound, true});
  };
  add("trend of the mean stress", relative(&FrameMoment::mean_stress), bounds.stress);
  add("trend of the largest stress", relative(&FrameMoment::largest_stress), bounds.stress);
  add("trend of the spin", relative(&FrameMoment::spin), bounds.speed);
  add("trend of the speed", relative(&FrameMoment::speed), bounds.speed);
  add("mass centre beside its straight way / way", std::hypot(off.x, off.z) / way, bounds.way);
  add("largest energy residual / kinetic energy", worst / run.kinetic, bounds.energy);
}

void spin_freely(const VerifyInputs& inputs, const ProgressText& progress, CaseResult& result) {
  Ring ring{inputs["radius"], inputs["element_size"], inputs["speed"], false, 1, 0, ""};
  const auto steps = std::llround(inputs["steps"]);
  ring.way = ring.speed * step_on_short_way(ring) * static_cast<double>(steps);
  const FrameRun run = run_ring(ring, steps, progress);
  result.findings.push_back({"free: mean hoop stress against half a ring's balance", "MPa",
                             1e-6 * run.hoop_stress, 1e-6 * run.wanted_hoop, 0.01});
  // Nothing acts on the ring: only rounding and the preload's residual remain.
  add_drifts("free", run, {1e-7, 1e-9, 1e-9, 1e-10}, result);
  result.figures.push_back(drift_figure("A wheel that spins freely", run));
}

void roll_without_friction(const VerifyInputs& inputs, const ProgressText& progress, CaseResult& result) {
  Ring ring{
      inputs["radius"], inputs["rolling_element_size"], inputs["speed"], true, 1, inputs["damping"], ""};
  const auto steps = std::llround(inputs["rolling_steps"]);
  const double a = inputs["semi_axis"];
  // On coarser patches the meshes of wheel and ground lock into one another and exchange spin for speed.
  if (a > 0.06 * ring.radius || ring.element_size > a / 2.99)
    throw InputError(
        fmt::format("verify: semi_axis = {:.3g} mm must lie between {:.3g} mm, three elements of {:.3g} mm, "
                    "and {:.3g} mm, "
                    "small against the radius",
                    1e3 * a, 3e3 * ring.element_size, 1e3 * ring.element_size, 60 * ring.radius));
  const double load =
      line_load(ring.radius, contact_modulus(kYoungsModulus, kPoissonsRatio), a) * ring.element_size;
  ring.more = ground(ring, load);
  ring.way = ring.speed * step_on_short_way(ring) * static_cast<double>(steps);
  ring.more = ground(ring, load);
  const FrameRun run = run_ring(ring, steps, progress);
  // Both meshes pass one another like gears. That shakes undamped bodies more and more and slowly exchanges
  // spin for speed, to and fro. The balance of energy does not book material damping.
  const auto energy = ring.damping > 0 ? std::nullopt : std::optional(1e-6);
  add_drifts("rolling", run, {0.01, {}, 1e-3, energy}, result);
  const double time = run.moments.back().time;
  const double pull = run.mass * run.trend([](const FrameMoment& m) { return m.speed; }) / time;
  const double moment = run.inertia * run.trend([](const FrameMoment& m) { return m.spin; }) / time;
  result.findings.push_back({"rolling: force that changes the speed / F_N", "-", pull / load, 0, 2e-4, true});
  result.findings.push_back({"rolling: moment that changes the spin / (F_N radius)", "-",
                             moment / (load * ring.radius), 0, 2e-4, true});
  result.findings.push_back({"rolling: resistance by the lead of the contact forces / F_N", "-",
                             run.moments.back().loss / (ring.way * load), 0, 1e-4, true});
  const auto every = [](const FrameMoment&) { return true; };
  const Statistics force = statistics(run.moments, every, [](const FrameMoment& m) { return m.force; });
  result.findings.push_back({"rolling: mean F_N", "kN", 1e-3 * force.mean, 1e-3 * load, 1e-3});
  result.figures.push_back(drift_figure("A wheel that rolls without friction", run));
}

CaseResult moving_frames(const VerifyInputs& inputs, const ProgressText& progress) {
  CaseResult result;
  spin_freely(inputs, progress, result);
  roll_without_friction(inputs, progress, result);
  return result;
}

}  // namespace

VerifyCase moving_frames_case() {
  return {
      "moving_frames",
      "a wheel that spins freely and one that rolls without friction: what must not drift",
      {{"radius", &kLength, "m", 0.43, {0.05, 5}, "the wheel's radius"},
       {"speed", &kSpeed, "km/h", 500 / 3.6, {1, 300}, "the rolling speed"},
       {"element_size", &kLength, "mm", 20e-3, {1e-4, 0.1}, "the elements' size of the wheel that spins"},
       {"steps", nullptr, "", 1e6, {1000, 1e8}, "the steps of the wheel that spins"},
       {"rolling_element_size",
        &kLength,
        "mm",
        4e-3,
        {1e-4, 0.1},
        "the elements' size of the wheel that rolls"},
       {"semi_axis", &kLength, "mm", 12e-3, {1e-4, 0.1}, "half the length of its patch"},
       {"rolling_steps", nullptr, "", 5e4, {1000, 1e8}, "the steps of the wheel that rolls"},
       {"damping", nullptr, "", 0, {0, 0.5}, "of its steel: fraction of critical at the highest frequency"}},
      moving_frames};
}

}  // namespace tread
