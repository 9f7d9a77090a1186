// Walking pace and the highest speed: force, patch and traction.

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>

#include "drivers/verify/cases.hpp"
#include "drivers/verify/ride.hpp"
#include "drivers/verify/tyre_on_block.hpp"

namespace tread {

namespace {

CaseResult extremes_speed(const VerifyInputs& inputs, const ProgressText& progress) {
  TyreOnBlock bodies = tyre_of(inputs, false);
  bodies.friction = inputs["friction"];
  bodies.thickness = 0.15 * bodies.radius;
  const double duration = inputs["duration"];
  const HertzPatch hertz = bodies.hertz_patch();
  const double mu = 0.2 * bodies.friction;
  CaseResult result;
  Figure figure;
  figure.title = "Traction under a torque that grows in the first quarter";
  figure.x_label = "Time [ms]";
  figure.panels = {{"F_N [kN]", {}, {}, 200, std::nullopt},
                   {"F_L / F_N [-]", {}, {{mu, "target"}}, 240, std::nullopt}};
  for (const double speed : {inputs["slowest"], inputs["fastest"]}) {
    const double ramp = 0.25 * duration;
    bodies.roll_on(speed, speed * duration, speed * duration,
                   fmt::format("traction = {{ mu = {}, ramp = \"{} s\" }}", mu, ramp));
    Model model(bodies.scene());
    const RunResults run = ride(model, 500, progress);
    const std::string at = format_quantity(speed, "km/h") + ": ";
    const auto mean = [&](const auto& value) { return since(run, 0.5 * duration, value).mean; };
    const double normal = mean([](const Sample& s) { return s.vertical_force; });
    result.findings.insert(
        result.findings.end(),
        {{at + "F_N", "kN", 1e-3 * normal, -1e-3 * run.preload.contact.force_on_rail.z, 0.01},
         {at + "F_L / F_N", "-", mean([](const Sample& s) { return s.longitudinal_force; }) / normal, mu, {}},
         {at + "F_N at rest", "kN", -1e-3 * run.preload.contact.force_on_rail.z, 1e-3 * model.wheel_load(),
          1e-4},
         {at + "angular momentum error", "-", angular_momentum_error(model, run), 0, 0.002, true},
         {at + "patch area", "mm2", 1e6 * mean([](const Sample& s) { return s.patch_area; }),
          1e6 * std::numbers::pi * hertz.semi_axis_x * hertz.semi_axis_y, 0.04 * bodies.fineness()},
         {at + "creepage", "%", 100 * mean([](const Sample& s) { return s.creepage_mean; }), 0, {}, true}});
    judge_ride(at, model, run, result.findings);
    figure.panels[0].series.push_back(
        history(at, run, [](const Sample& s) { return 1e-3 * s.vertical_force; }));
    figure.panels[1].series.push_back(history(at, run, [](const Sample& s) { return s.traction(); }));
  }
  result.figures.push_back(figure);
  return result;
}

}  // namespace

VerifyCase extremes_speed_case() {
  std::vector<VerifyInput> inputs = tyre_inputs(false, 3.5e-3);
  inputs.push_back({"friction", nullptr, "", 0.5, {0.01, 2}, "the coefficient of friction f"});
  inputs.push_back({"slowest", &kSpeed, "km/h", 5 / 3.6, {0.1, 300}, "the lower speed"});
  inputs.push_back({"fastest", &kSpeed, "km/h", 600 / 3.6, {0.1, 300}, "the higher speed"});
  inputs.push_back({"duration", &kTime, "ms", 2e-3, {1e-4, 0.1}, "the time of each run"});
  return {"extremes_speed", "walking pace and the highest speed", std::move(inputs), extremes_speed,
          kExtremes};
}

}  // namespace tread
