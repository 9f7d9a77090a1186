// Contact penalties far softer and stiffer than the default: the force, the patch, the noise, the energy.

#include <fmt/core.h>

#include <array>
#include <cmath>

#include "drivers/verify/cases.hpp"
#include "drivers/verify/ride.hpp"
#include "drivers/verify/tyre_on_block.hpp"

namespace tread {

namespace {

constexpr std::array kFactors = {0.1, 0.3, 1.0, 3.0, 10.0};  ///< factors of the penalty's default
constexpr double kRefused = 100;

/// The key that makes the penalty `factor` times its default.
std::string penalty_key(const Model& as_default, double factor) {
  const HertzPatch& patch = as_default.hertz_patch;
  const double ratio = patch.max_pressure / (factor * as_default.contact->options().penalty * patch.approach);
  return fmt::format("contact.penetration_ratio = {:.12g}", ratio);
}

CaseResult extremes_penalty(const VerifyInputs& inputs, const ProgressText& progress) {
  TyreOnBlock bodies = tyre_of(inputs, false);
  bodies.friction = inputs["friction"];
  bodies.thickness = 0.15 * bodies.radius;
  const double speed = inputs["speed"];
  const HertzPatch hertz = bodies.hertz_patch();
  const double way = 4 * hertz.semi_axis_x;
  const double ramp = 0.25 * way / speed;
  bodies.roll_on(speed, way, way,
                 fmt::format("traction = {{ mu = {}, ramp = \"{} s\" }}", 0.6 * bodies.friction, ramp));
  const Model as_default(bodies.scene());

  CaseResult result;
  Figure figure;
  figure.title = "Contact force while the torque grows and after it";
  figure.x_label = "Time [ms]";
  figure.panels = {{"F_N [kN]", {}, {}, 240, std::nullopt}, {"Patch area [mm2]", {}, {}, 200, std::nullopt}};
  for (const double factor : kFactors) {
    bodies.overrides = {penalty_key(as_default, factor)};
    Model model(bodies.scene());
    const RunResults run = ride(model, 500, progress);
    const std::string at = fmt::format("penalty x {:g}: ", factor);
    const Statistics normal = since(run, ramp, [](const Sample& s) { return s.vertical_force; });
    const double pushed = since(run, ramp, [](const Sample& s) { return s.max_penetration; }).mean;
    const double fineness = bodies.fineness();
    // Between these factors the area is that of Hertz within the mesh's accuracy; softer penalties widen it.
    const bool sharp = factor >= 0.9 && factor <= 1.1;
    result.findings.insert(
        result.findings.end(),
        {{at + "F_N", "kN", 1e-3 * normal.mean, 1e-3 * model.wheel_load(), 0.01},
         {at + "standard deviation of F_N / F_N", "-", normal.deviation / normal.mean, 0, 0.02, true},
         {at + "largest pressure at rest, nodal average", "MPa", 1e-6 * run.preload.max_pressure,
          1e-6 * hertz.max_pressure, 0.12 * fineness},
         {at + "patch area at rest", "mm2", 1e6 * run.preload.contact.area,
          1e6 * hertz.semi_axis_x * hertz.semi_axis_y * M_PI,
          sharp ? std::optional(0.03 * fineness) : std::nullopt},
         {at + "penetration / approach", "-", pushed / hertz.approach, 0, {}, true},
         {at + "energy error, eq. (14)", "-", run.energy_error, 0, 0.01, true},
         {at + "samples that are not finite", "-", static_cast<double>(count_not_finite(model, run)), 0, 0,
          true}});
    figure.panels[0].series.push_back(
        history(fmt::format("x {:g}", factor), run, [](const Sample& s) { return 1e-3 * s.vertical_force; }));
    figure.panels[1].series.push_back(
        history(fmt::format("x {:g}", factor), run, [](const Sample& s) { return 1e6 * s.patch_area; }));
  }
  bodies.overrides = {penalty_key(as_default, kRefused)};
  const bool far_beyond = refused([&] { const Model model(bodies.scene()); }, {"times as stiff"});
  result.findings.push_back(
      {fmt::format("penalty x {:g}: refused", kRefused), "-", far_beyond ? 1.0 : 0.0, 1, 0});
  result.figures.push_back(figure);
  return result;
}

}  // namespace

VerifyCase extremes_penalty_case() {
  std::vector<VerifyInput> inputs = tyre_inputs(false, 3.5e-3);
  inputs.push_back({"friction", nullptr, "", 0.5, {0.01, 2}, "the coefficient of friction f"});
  inputs.push_back({"speed", &kSpeed, "m/s", 20, {5, 150}, "the rolling speed"});
  return {"extremes_penalty", "contact penalties from a tenth to a hundred times the default",
          std::move(inputs), extremes_penalty, kExtremes};
}

}  // namespace tread
