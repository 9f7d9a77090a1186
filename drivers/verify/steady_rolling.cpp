// Steady rolling under traction against the half-space solution. [Kalker, Three-Dimensional Elastic Bodies in
// Rolling Contact, ch. 5]

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/half_space_stress.hpp"
#include "drivers/verify/roll_tyre.hpp"

namespace tread {

namespace {

/// What the half-space shows, averaged over boxes of the element's size.
struct Reference {
  double creepage = 0;
  double slip_fraction = 0;
  double max_shear = 0;  ///< box average on the axis [Pa]
  double work = 0;       ///< strip of one element's width on the axis [J/m2]
  double von_mises = 0;  ///< of a surface element's mean stress [Pa]
};

Reference reference_of(const TyreOnBlock& bodies, double force) {
  using namespace half_space;
  const HertzPatch patch = bodies.hertz_patch();
  const double semi = std::min(patch.semi_axis_x, patch.semi_axis_y);
  const half_space::Material material{bodies.youngs_modulus, bodies.poissons_ratio};
  Reference reference;
  reference.creepage = extrapolated_summary({material, bodies.radius, bodies.crown_radius, bodies.load,
                                             bodies.friction, force, bodies.element_size},
                                            semi / 9)
                           .creepage;

  // An odd number of cells to a box, so that boxes stand on the axis.
  constexpr int kMost = 9;
  int per_box = 2 * static_cast<int>(std::ceil(6 * bodies.element_size / semi)) + 1;
  per_box = std::clamp(per_box, 3, kMost);
  const double cell = bodies.element_size / per_box;
  const Grid grid = centred_grid(1.3 * patch.semi_axis_x, 1.3 * patch.semi_axis_y, cell);
  const Influence influence(grid, material);
  const NormalContact contact =
      press(influence, quadratic_gap(bodies.radius, bodies.crown_radius), bodies.load);
  const RollingContact rolling(influence, contact, bodies.friction);
  const FrictionState state = rolling.steady(force);
  reference.slip_fraction = state.slip_fraction;
  reference.work =
      centre_element_work(grid, state, bodies.element_size) / (bodies.element_size * bodies.element_size);
  const int middle = static_cast<int>(std::lround(-grid.y0 / grid.dy));
  double at = 0;
  for (int i = 0; i + per_box <= grid.nx; ++i) {
    double x = 0;
    double y = 0;
    for (int j = middle - per_box / 2; j <= middle + per_box / 2; ++j)
      for (int k = i; k < i + per_box; ++k) {
        x += state.tractions.x[static_cast<std::size_t>(grid.index(k, j))];
        y += state.tractions.y[static_cast<std::size_t>(grid.index(k, j))];
      }
    const double mean = std::hypot(x, y) / (per_box * per_box);
    if (mean <= reference.max_shear) continue;
    reference.max_shear = mean;
    at = grid.x(i + per_box / 2);
  }
  // Elements stand beside the axis when nodes stand on it; the largest stress is near the largest shear.
  const SurfaceLoad load{grid, contact.pressure, state.tractions, bodies.poissons_ratio};
  const double h = bodies.element_size;
  reference.von_mises = largest_box_stress(load, {at, 0.5 * h, 0, h, h, h}, 0.5 * patch.semi_axis_x);
  return reference;
}

CaseResult steady_rolling(const VerifyInputs& inputs, const ProgressText& progress) {
  TyreOnBlock bodies = tyre_of(inputs, false);
  const double mu = inputs["mu"];
  bodies.friction = inputs["friction"];
  if (std::abs(mu) > 0.95 * bodies.friction)
    throw InputError(fmt::format("verify: mu = {:g} is not below 0.95 of friction = {:g}: no steady rolling",
                                 mu, bodies.friction));
  const double speed = inputs["speed"];
  const double ramp = inputs["ramp"];
  bodies.guided = true;  // light and rigid: what the torque excites dies out fast
  const double observed = 5 * bodies.hertz_patch().semi_axis_x;
  bodies.roll_on(speed, speed * 1.15 * ramp + observed, observed,
                 fmt::format("traction = {{ mu = {}, ramp = \"{} s\", shape = \"smooth\" }}", mu, ramp));
  const Rolled rolled = roll_tyre(bodies, observed, progress);
  const Reference reference = reference_of(bodies, rolled.force);

  CaseResult result;
  result.findings = {
      {"F_L / F_N", "-", rolled.force / rolled.normal_force, mu, 0.02},
      {"creepage less free rolling", "%", 100 * rolled.creepage, 100 * reference.creepage,
       0.08 * bodies.fineness()},
      {"creepage from the frictional work", "%", 100 * rolled.work_creepage, 100 * rolled.creepage, 0.03},
      {"slip area / patch area", "-", rolled.slip_fraction, reference.slip_fraction, 0.05, true},
      {"largest shear on the axis", "MPa", 1e-6 * rolled.shear.mean, 1e-6 * reference.max_shear, 0.05},
      {"its standard deviation along the rail / mean", "-", rolled.shear.deviation / rolled.shear.mean, 0,
       0.02, true},
      {"frictional work on the axis", "J/m2", rolled.work, reference.work, 0.06},
      {"Von Mises stress of the surface elements", "MPa", 1e-6 * rolled.surface.von_mises.mean,
       1e-6 * reference.von_mises, 0.05},
      {"lost by the lead of the contact forces / frictional work", "-", rolled.lead_loss, 0, {}, true},
      {"energy residual / frictional work", "-", rolled.energy_residual, 0, 0.01, true}};
  result.figures.push_back(creepage_figure(rolled, reference.creepage));
  return result;
}

}  // namespace

VerifyCase steady_rolling_case() {
  std::vector<VerifyInput> inputs = tyre_inputs(false);
  inputs.push_back({"friction", nullptr, "", 0.5, {0.01, 2}, "the coefficient of friction f"});
  inputs.push_back({"mu", nullptr, "", 0.3, {-1.9, 1.9}, "the traction coefficient F_L / F_N"});
  inputs.push_back({"speed", &kSpeed, "m/s", 40, {1, 150}, "the rolling speed"});
  inputs.push_back({"ramp", &kTime, "ms", 0.75e-3, {1e-5, 0.1}, "the time in which the torque grows"});
  return {"steady_rolling", "a wheel of two radii rolls steadily under traction, against the half-space",
          std::move(inputs), steady_rolling};
}

}  // namespace tread
