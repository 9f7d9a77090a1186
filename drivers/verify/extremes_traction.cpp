// Traction at the limit of adhesion and beyond, driving and braking; no friction, no torque.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/verify/cases.hpp"
#include "drivers/verify/ride.hpp"
#include "drivers/verify/tyre_on_block.hpp"

namespace tread {

namespace {

/// A run and the values by which all runs are judged.
struct Run {
  Model model;
  RunResults results;
  double first;  ///< start of the judged time [s]

  Run(const Scene& scene, double first_part, const ProgressText& progress)
      : model(scene), results(ride(model, 1000, progress)), first(first_part * results.samples.back().time) {}

  template <class Value>
  double mean(const Value& value) const {
    return since(results, first, value).mean;
  }
  double normal() const {
    return mean([](const Sample& s) { return s.vertical_force; });
  }
  double longitudinal() const {
    return mean([](const Sample& s) { return s.longitudinal_force; });
  }
  void judge(const std::string& at, std::vector<Finding>& findings) const {
    const EnergyLedger& energy = results.samples.back().energy;
    findings.push_back(
        {at + "angular momentum error", "-", angular_momentum_error(model, results), 0, 0.002, true});
    findings.push_back({at + "frictional work", "J", energy.frictional_work, 0, {}, true});
    judge_ride(at, model, results, findings);
  }
};

/// Rolling under the fraction `exploitation` of the friction coefficient.
void below_the_limit(TyreOnBlock bodies, double speed, double exploitation, CaseResult& result,
                     const ProgressText& progress) {
  const double a = bodies.hertz_patch().semi_axis_x;
  const double way = (exploitation > 0 ? 10 : 4) * a;
  const double mu = exploitation * bodies.friction;
  bodies.roll_on(speed, way, way,
                 fmt::format("traction = {{ mu = {}, ramp = \"{} s\" }}", mu, 0.4 * way / speed));
  const Run run(bodies.scene(), 0.7, progress);
  const std::string at = fmt::format("f {:g}, mu {:g} f: ", bodies.friction, exploitation);
  if (mu > 0)
    result.findings.push_back({at + "F_L / F_N", "-", run.longitudinal() / run.normal(), mu, 0.02});
  else
    result.findings.push_back({at + "F_L / F_N", "-", run.longitudinal() / run.normal(), 0, 0.005, true});
  if (bodies.friction == 0)
    result.findings.push_back(
        {at + "frictional work exactly", "J", run.results.samples.back().energy.frictional_work, 0, 0, true});
  result.findings.push_back(
      {at + "creepage", "%", 100 * run.mean([](const Sample& s) { return s.creepage_mean; }), 0, {}, true});
  run.judge(at, result.findings);
}

/// Rolling or sliding under a torque of `times` the limit of adhesion; negative brakes.
void beyond_the_limit(TyreOnBlock bodies, double speed, double times, CaseResult& result,
                      const ProgressText& progress) {
  double adhesion = 0;
  double inertia = 0;
  const double radius = bodies.radius;
  {
    bodies.roll_on(speed, 0.01, 0.01, "");
    const Model model(bodies.scene());
    adhesion = bodies.friction * model.wheel_load() * radius;
    inertia = model.wheelset->inertia();
  }
  const double torque = times * adhesion;
  // Under braking, the run lasts until the rim would run backwards at a tenth of the speed.
  const double slowing = (std::abs(times) - 1) * adhesion / inertia;
  const double time = 1.1 * speed / radius / slowing;
  const double ramp = 0.1 * time;
  const double way = speed * (time + 0.5 * ramp);
  bodies.roll_on(speed, way, way,
                 fmt::format("traction = {{ torque = \"{} N m\", ramp = \"{} s\" }}", torque, ramp));
  const Run run(bodies.scene(), 0.3, progress);
  const std::string at = fmt::format("torque {:g} x adhesion: ", times);
  const double side = std::copysign(1.0, times);
  const std::vector<Sample>& samples = run.results.samples;
  const auto from =
      std::find_if(samples.begin(), samples.end(), [&](const Sample& s) { return s.time >= run.first; });
  const double acceleration =
      (samples.back().wheel_spin - from->wheel_spin) / (samples.back().time - from->time);
  const double normal = run.normal();
  std::vector<Finding>& findings = result.findings;
  findings.push_back(
      {at + "F_L / (f F_N)", "-", run.longitudinal() / (bodies.friction * normal), side, 0.005});
  findings.push_back({at + "slip area / patch area", "-", run.mean([](const Sample& s) {
                        return s.patch_area > 0 ? s.slip_area / s.patch_area : 1;
                      }),
                      1, 0.001});
  findings.push_back({at + "angular acceleration", "rad/s2", acceleration,
                      (torque - side * bodies.friction * normal * radius) / inertia, 0.01});
  findings.push_back({at + "rim speed / speed at the end",
                      "-",
                      samples.back().wheel_spin * radius / samples.back().wheel_speed,
                      0,
                      {},
                      true});
  run.judge(at, findings);
  result.figures[0].panels[0].series.push_back(
      history(at, run.results, [&](const Sample& s) { return s.wheel_spin * radius; }));
  result.figures[0].panels[1].series.push_back(
      history(at, run.results, [](const Sample& s) { return s.traction(); }));
}

CaseResult extremes_traction(const VerifyInputs& inputs, const ProgressText& progress) {
  TyreOnBlock bodies = tyre_of(inputs, false);
  bodies.thickness = 0.15 * bodies.radius;
  const double speed = inputs["speed"];
  CaseResult result;
  Figure figure;
  figure.title = "A torque beyond adhesion";
  figure.x_label = "Time [ms]";
  figure.panels = {{"Speed of the rim [m/s]", {}, {}, 240, std::nullopt},
                   {"F_L / F_N [-]", {}, {}, 200, std::nullopt}};
  result.figures.push_back(figure);
  bodies.friction = 0;
  below_the_limit(bodies, speed, 0, result, progress);
  for (const double friction : {0.05, 0.5, 1.0}) {
    bodies.friction = friction;
    below_the_limit(bodies, speed, 0.99, result, progress);
  }
  bodies.friction = inputs["friction"];
  below_the_limit(bodies, speed, 0, result, progress);
  beyond_the_limit(bodies, inputs["spinning_speed"], inputs["torque"], result, progress);
  beyond_the_limit(bodies, inputs["spinning_speed"], -inputs["torque"], result, progress);
  bodies.roll_on(speed, 0.01, 0.01, fmt::format("traction = {{ mu = {} }}", 1.01 * bodies.friction));
  const bool beyond_friction = refused([&] { bodies.scene(); }, {"cannot be reached"});
  result.findings.push_back({"mu target of 1.01 f: refused", "-", beyond_friction ? 1.0 : 0.0, 1, 0});
  return result;
}

}  // namespace

VerifyCase extremes_traction_case() {
  std::vector<VerifyInput> inputs = tyre_inputs(false, 3.5e-3);
  inputs.push_back({"friction", nullptr, "", 0.5, {0.01, 2}, "the coefficient of friction f"});
  inputs.push_back({"speed", &kSpeed, "m/s", 15, {1, 150}, "the rolling speed below the limit"});
  inputs.push_back(
      {"spinning_speed", &kSpeed, "m/s", 5, {1, 150}, "the speed at which the torque exceeds adhesion"});
  inputs.push_back(
      {"torque", nullptr, "", 4, {1.5, 20}, "the torque over the largest that adhesion carries"});
  return {"extremes_traction", "traction up to adhesion and beyond, driving and braking", std::move(inputs),
          extremes_traction, kExtremes};
}

}  // namespace tread
