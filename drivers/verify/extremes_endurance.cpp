// Millions of steps: force, momentum and energy of a wheel that rolls freely do not drift. Its speed may
// change: the ring's compliance varies with the size of its elements, and a slow wheel under a heavy load
// rocks on that variation.

#include <fmt/core.h>

#include <cmath>

#include "drivers/verify/cases.hpp"
#include "drivers/verify/ride.hpp"
#include "drivers/verify/tyre_on_block.hpp"

namespace tread {

namespace {

/// Change over the whole run by the least-squares line through the samples after the first tenth.
template <class Value>
double drift(const RunResults& run, const Value& value) {
  LineFit line;
  const double length = run.samples.back().time;
  for (const Sample& sample : run.samples)
    if (sample.time >= 0.1 * length) line.add(sample.time, value(sample));
  return line.rise(length);
}

/// Contact force beside the `load` [N], energies and speed over time.
Figure endurance_figure(const RunResults& run, double load) {
  Figure figure;
  figure.title = fmt::format("{:g} steps", static_cast<double>(run.steps));
  figure.x_label = "Time [ms]";
  figure.panels = {
      {"F_N [kN]",
       {history("contact force", run, [](const Sample& s) { return 1e-3 * s.vertical_force; })},
       {{1e-3 * load, "load"}},
       200,
       std::nullopt},
      {"Energy [mJ]",
       {history("residual", run, [](const Sample& s) { return 1e3 * s.energy.residual; }),
        history("frictional work", run, [](const Sample& s) { return 1e3 * s.energy.frictional_work; })},
       {},
       200,
       std::nullopt},
      {"Speed [m/s]",
       {history("wheel", run, [](const Sample& s) { return s.wheel_speed; })},
       {},
       160,
       std::nullopt}};
  return figure;
}

CaseResult extremes_endurance(const VerifyInputs& inputs, const ProgressText& progress) {
  TyreOnBlock bodies = slice_of(inputs, {0.12, 0.7});
  bodies.thickness = 0.4 * bodies.radius;
  const double way = inputs["way"];
  const double steps = std::round(inputs["steps"]);
  // Speed at which so many steps cover the distance.
  bodies.roll_on(1, way, way, "");
  double speed = 0;
  {
    const Model model(bodies.scene());
    speed = way / (steps * model.scene.motion->step_safety * step_limit(model).stable_step);
  }
  bodies.roll_on(speed, way, way, "");
  Model model(bodies.scene());
  const RunResults run = ride(model, 4000, progress);

  const double load = model.wheel_load();
  const EnergyLedger& start = run.samples.front().energy;
  const double energy = start.kinetic + start.strain;
  const Statistics normal =
      since(run, 0.1 * run.samples.back().time, [](const Sample& s) { return s.vertical_force; });
  const auto relative = [&](const auto& value, double scale) { return drift(run, value) / scale; };
  CaseResult result;
  result.findings = {
      {"steps", "-", static_cast<double>(run.steps), steps, 1e-3},
      {"way", "mm", 1e3 * run.samples.back().wheel_x, 1e3 * way, {}},
      {"F_N, mean", "kN", 1e-3 * normal.mean, 1e-3 * load, 1e-3},
      {"standard deviation of F_N / F_N", "-", normal.deviation / normal.mean, 0, {}, true},
      {"drift of F_N / F_N", "-", relative([](const Sample& s) { return s.vertical_force; }, load), 0, 1e-3,
       true},
      {"drift of the speed / speed",
       "-",
       relative([](const Sample& s) { return s.wheel_speed; }, speed),
       0,
       {},
       true},
      {"mean F_L / F_N", "-", since(run, 0, [](const Sample& s) { return s.longitudinal_force; }).mean / load,
       0, 1e-3, true},
      {"angular momentum error", "-", angular_momentum_error(model, run), 0, 1e-3, true},
      {"drift of the energy residual / (kinetic + strain energy)", "-",
       relative([](const Sample& s) { return s.energy.residual; }, energy), 0, 1e-4, true},
      {"largest energy residual / (kinetic + strain energy)", "-",
       since(run, 0, [](const Sample& s) { return std::abs(s.energy.residual); }).max / energy, 0, 1e-3,
       true},
      {"frictional work / (kinetic + strain energy)",
       "-",
       run.samples.back().energy.frictional_work / energy,
       0,
       {},
       true},
      {"momentum error", "-", run.momentum_error, 0, 1e-6, true},
      {"samples that are not finite", "-", static_cast<double>(count_not_finite(model, run)), 0, 0, true}};
  result.figures.push_back(endurance_figure(run, load));
  return result;
}

}  // namespace

VerifyCase extremes_endurance_case() {
  return {"extremes_endurance",
          "hundreds of thousands of steps of free rolling, for drift",
          {{"steps", nullptr, "", 2e5, {1e4, 1e8}, "the steps that the way takes"},
           {"way", &kLength, "mm", 0.1, {0.01, 10}, "the way of the wheel"},
           {"radius", &kLength, "m", 0.2, {0.05, 5}, "the radius of the rolling circle"},
           {"semi_axis", &kLength, "mm", 8e-3, {1e-4, 0.1}, "half the length of the patch"},
           {"youngs_modulus", &kStress, "GPa", 205.9e9, {1e6, 1e13}, "Young's modulus of both bodies"},
           {"poissons_ratio", nullptr, "", 0.3, {0, 0.49}, "Poisson's ratio of both bodies"},
           {"element_size", &kLength, "mm", 5e-3, {1e-5, 0.02}, "the elements' size in the contact"},
           {"friction", nullptr, "", 0.3, {0, 2}, "the coefficient of friction f"}},
          extremes_endurance,
          kExtremes};
}

}  // namespace tread
