// Plane strain rolling under traction against Carter's solution. [Carter 1926; Johnson, Contact Mechanics,
// sect. 8.3]

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/roll_tyre.hpp"

namespace tread {

namespace {

/// Carter's tractions: slip behind, stick at the leading edge.
struct Carter {
  double a, stick, limit;  ///< semi-axes of patch and stick zone [m], f p0 [Pa]

  double at(double x) const {
    if (std::abs(x) >= a) return 0;
    const double whole = std::sqrt(1 - x * x / (a * a));
    const double inner = (x - (a - stick)) / stick;
    return limit * (whole - (std::abs(inner) < 1 ? stick / a * std::sqrt(1 - inner * inner) : 0));
  }
};

/// Shear stress at the nodes beside theory. `side`: sign of the traction.
Figure tractions_figure(const Rolled& rolled, const Carter& theory, double side) {
  Series ours{"nodes", {}, {}, Stroke::solid};
  Series line{"Carter", {}, {}, Stroke::dashed};
  for (const PatchPoint& point : rolled.nodes) {
    ours.x.push_back(1e3 * point.x);
    ours.y.push_back(1e-6 * point.shear);
  }
  for (int i = -100; i <= 100; ++i) {
    line.x.push_back(1e3 * theory.a * i / 100);
    line.y.push_back(1e-6 * side * theory.at(theory.a * i / 100));
  }
  Figure figure;
  figure.title = "Surface shear stress in the patch";
  figure.x_label = "x, rolling to the right [mm]";
  figure.panels = {{"Shear stress on the wheel [MPa]", {ours, line}, {}, 260, std::nullopt}};
  return figure;
}

CaseResult carter(const VerifyInputs& inputs, const ProgressText& progress) {
  TyreOnBlock bodies = slice_of(inputs, {0.05, 0.5});
  bodies.grid_offset = inputs["grid_offset"];
  const double a = inputs["semi_axis"];
  const double exploitation = inputs["exploitation"];
  if (exploitation == 0) throw InputError("verify: exploitation is zero: no traction to compare");
  const double speed = inputs["speed"];
  const double ramp = inputs["ramp"];
  const double observed = 4 * a;
  bodies.guided = true;
  const double way = 1.3 * speed * ramp + observed;
  const double free = free_creepage(bodies, speed, way, observed, progress);
  bodies.roll_on(speed, way, observed, smooth_traction(exploitation * bodies.friction, ramp));
  const Rolled rolled = roll_tyre(bodies, observed, progress);
  const double creepage = rolled.creepage - free;

  const double reached = rolled.force / (bodies.friction * rolled.normal_force);
  const Carter theory{a, a * std::sqrt(1 - std::abs(reached)),
                      bodies.friction * bodies.hertz_patch().max_pressure};
  // Only nodes farther than an element and a half from the ends of patch and stick zone count.
  double worst = 0;
  int compared = 0;
  const double side = std::copysign(1.0, reached);
  const double ends = 1.5 * bodies.element_size;
  for (const PatchPoint& point : rolled.nodes)
    if (std::abs(point.x) < a - ends && std::abs(point.x - (a - 2 * theory.stick)) > ends) {
      worst = std::max(worst, std::abs(side * point.shear - theory.at(point.x)) / theory.limit);
      ++compared;
    }
  constexpr int kFewest = 3;
  if (compared < kFewest)
    throw InputError(
        fmt::format("verify: element_size = {:.3g} mm leaves {} nodes away from the ends of the zones to "
                    "compare; state a "
                    "smaller one",
                    1e3 * bodies.element_size, compared));

  const double fineness = (bodies.element_size / 1e-3) * (6e-3 / a);
  CaseResult result;
  result.findings = {
      {"F_L / (f F_N)", "-", reached, exploitation, 0.02},
      {"creepage less free rolling", "%", 100 * creepage,
       100 * side * bodies.friction * (a - theory.stick) / bodies.radius, 0.01 + 0.04 * fineness},
      {"largest difference of the tractions, nodal, / (f p0)", "-", worst, 0, 0.05, true},
      {"creepage from the frictional work", "%", 100 * rolled.work_creepage, 100 * creepage, {}},
      {"largest pressure, at a point",
       "MPa",
       1e-6 * std::max_element(rolled.patch.begin(), rolled.patch.end(),
                               [](const auto& p, const auto& q) { return p.pressure < q.pressure; })
                  ->pressure,
       1e-6 * bodies.hertz_patch().max_pressure,
       {}},
      {"energy residual / frictional work", "-", rolled.energy_residual, 0, 0.01, true}};

  result.figures = {
      tractions_figure(rolled, theory, side),
      creepage_figure(rolled, free, side * bodies.friction * (a - theory.stick) / bodies.radius)};
  return result;
}

}  // namespace

VerifyCase carter_case() {
  return {"carter",
          "a cylinder rolls in plane strain under traction, against Carter",
          {{"radius", &kLength, "m", 0.43, {0.05, 5}, "the radius of the rolling circle"},
           {"semi_axis", &kLength, "mm", 6e-3, {1e-4, 0.1}, "half the length of the patch"},
           {"youngs_modulus", &kStress, "GPa", 205.9e9, {1e6, 1e13}, "Young's modulus of both bodies"},
           {"poissons_ratio", nullptr, "", 0.3, {0, 0.49}, "Poisson's ratio of both bodies"},
           {"element_size", &kLength, "mm", 1e-3, {1e-5, 0.02}, "the elements' size in the contact"},
           {"grid_offset", nullptr, "", 0, {-0.5, 0.5}, "the meshes' shift in elements"},
           {"friction", nullptr, "", 0.5, {0.01, 2}, "the coefficient of friction f"},
           {"exploitation", nullptr, "", 0.6, {-0.95, 0.95}, "F_L / (f F_N)"},
           {"speed", &kSpeed, "m/s", 40, {1, 150}, "the rolling speed"},
           {"ramp", &kTime, "ms", 1e-3, {1e-5, 0.1}, "the time in which the torque grows"}},
          carter};
}

}  // namespace tread
