// Corrugations that throw the wheel off the rail: no force in flight, no energy lost or gained in landing.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/verify/cases.hpp"
#include "drivers/verify/ride.hpp"
#include "drivers/verify/tyre_on_block.hpp"

namespace tread {

namespace {

CaseResult extremes_corrugation(const VerifyInputs& inputs, const ProgressText& progress) {
  TyreOnBlock bodies = tyre_of(inputs, false);
  bodies.friction = inputs["friction"];
  bodies.thickness = 0.15 * bodies.radius;
  const double speed = inputs["speed"];
  const double depth = inputs["depth"];
  // Fine elements begin two semi-axes before the observed stretch.
  const double before = 2 * bodies.hertz_patch().semi_axis_x;
  const double start = 1.5 * before;
  CaseResult result;
  Figure figure;
  figure.title = fmt::format("Contact force over a corrugation {:.3g} mm deep", 1e3 * depth);
  figure.x_label = "Position of the wheel [mm]";
  figure.panels = {{"F_N [kN]", {}, {}, 320, std::nullopt}};
  for (const double wavelength : {inputs["shortest"], inputs["wavelength"], inputs["longest"]}) {
    // Two long waves, or as many short ones as fit.
    const double length = std::max(wavelength, 2 * inputs["wavelength"]);
    const double way = start + length + 0.02;
    bodies.roll_on(speed, way, way - start,
                   fmt::format("traction = {{ mu = {}, ramp = \"{} s\" }}\n[corrugation]\nwavelength = "
                               "\"{} m\"\ndepth = \"{} m\"\nstart = \"{} m\"\nlength = \"{} m\"",
                               0.5 * bodies.friction, 0.1 * way / speed, wavelength, depth, start, length));
    Model model(bodies.scene());
    const RunResults run = ride(model, 1000, progress);
    const std::string at = fmt::format("{:.3g} mm: ", 1e3 * wavelength);
    int off = 0;
    double left_over = 0;
    for (const Sample& s : run.samples)
      if (s.patch_area == 0) {
        ++off;
        left_over = std::max({left_over, std::abs(s.vertical_force), std::abs(s.longitudinal_force),
                              std::abs(s.lateral_force), s.max_pressure, s.energy.penalty});
      }
    const double share = off / static_cast<double>(run.samples.size());
    const Statistics normal = since(run, 0, [](const Sample& s) { return s.vertical_force; });
    result.findings.insert(
        result.findings.end(),
        {{at + "largest F_N / load", "-", normal.max / model.wheel_load(), 0, {}, true},
         {at + "part of the time off the rail", "-", share, 0, {}, true},
         {at + "smallest F_N", "kN", std::min(0.0, 1e-3 * normal.min), 0, 0, true},
         {at + "largest fall of the frictional work / work", "-",
          run.frictional_work_decrease / run.samples.back().energy.frictional_work, 0, 1e-6, true}});
    // A wave between is to throw the wheel off; the wheel may bridge shorter waves and follow longer ones.
    if (wavelength == inputs["wavelength"])
      result.findings.push_back({at + "the wheel leaves the rail", "-", off > 0 ? 1.0 : 0.0, 1, 0, true});
    judge_ride(at, model, run, result.findings);
    if (off > 0)
      result.findings.push_back(
          {at + "largest force, pressure or penalty energy while off", "-", left_over, 0, 0, true});
    Series force{at, {}, {}, Stroke::solid};
    for (const Sample& s : run.samples) {
      force.x.push_back(1e3 * s.wheel_x);
      force.y.push_back(1e-3 * s.vertical_force);
    }
    figure.panels[0].series.push_back(force);
  }
  result.figures.push_back(figure);
  return result;
}

}  // namespace

VerifyCase extremes_corrugation_case() {
  std::vector<VerifyInput> inputs = tyre_inputs(false, 3.5e-3);
  inputs.push_back({"friction", nullptr, "", 0.5, {0.01, 2}, "the coefficient of friction f"});
  inputs.push_back({"speed", &kSpeed, "km/h", 300 / 3.6, {1, 300}, "the rolling speed"});
  inputs.push_back({"depth", &kLength, "mm", 0.5e-3, {1e-6, 0.01}, "the corrugation's depth"});
  inputs.push_back({"shortest", &kLength, "mm", 0.02, {5e-3, 1}, "the shortest wavelength"});
  inputs.push_back(
      {"wavelength", &kLength, "mm", 0.08, {5e-3, 1}, "a wavelength between, which throws the wheel off"});
  inputs.push_back({"longest", &kLength, "mm", 0.3, {5e-3, 1}, "the longest wavelength"});
  return {"extremes_corrugation", "corrugations that throw the wheel off the rail", std::move(inputs),
          extremes_corrugation, kExtremes};
}

}  // namespace tread
