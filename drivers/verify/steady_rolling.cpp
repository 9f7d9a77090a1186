// Steady rolling under traction against the half-space solution. [Kalker, Three-Dimensional Elastic Bodies in
// Rolling Contact, ch. 5]

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "drivers/verify/cases.hpp"
#include "drivers/verify/roll_tyre.hpp"
#include "kernels/half_space/half_space_steady.hpp"
#include "kernels/half_space/half_space_stress.hpp"

namespace tread {

namespace {

struct Shear {
  double x = 0, y = 0;  ///< [Pa]
  double size() const { return std::hypot(x, y); }
};

/// The steady half-space. An odd number of cells fits into a surface element, so that boxes of the element's
/// size stand on the axis.
struct HalfSpace {
  int per_box;  ///< number of cells along an element
  half_space::Influence influence;
  half_space::NormalContact contact;
  half_space::FrictionState state;

  HalfSpace(const TyreOnBlock& bodies, double force)
      : per_box(cells_of(bodies)),
        influence(
            half_space::centred_grid(1.3 * bodies.hertz_patch().semi_axis_x,
                                     1.3 * bodies.hertz_patch().semi_axis_y, bodies.element_size / per_box),
            bodies.elastic.alike()),
        contact(half_space::press(influence, half_space::quadratic_gap(bodies.radius, bodies.crown_radius),
                                  bodies.load)),
        state(half_space::RollingContact(influence, contact, bodies.friction).steady(force)) {}

  static int cells_of(const TyreOnBlock& bodies) {
    constexpr int kMost = 9;
    const HertzPatch patch = bodies.hertz_patch();
    const double semi = std::min(patch.semi_axis_x, patch.semi_axis_y);
    return std::clamp(2 * static_cast<int>(std::ceil(6 * bodies.element_size / semi)) + 1, 3, kMost);
  }
  const half_space::Grid& grid() const { return influence.grid; }

  /// Mean of the shear on the wheel over n by n points that fill a box about (x, y) [m].
  Shear mean_shear(int n, double size, double x, double y) const {
    Shear mean;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double px = x + ((i + 0.5) / n - 0.5) * size;
        const double py = y + ((j + 0.5) / n - 0.5) * size;
        mean.x += half_space::interpolated(grid(), state.tractions.x, px, py) / (n * n);
        mean.y += half_space::interpolated(grid(), state.tractions.y, px, py) / (n * n);
      }
    return mean;
  }
};

struct ShearPeak {
  double x = 0;      ///< [m]
  double shear = 0;  ///< [Pa]
};

/// Largest mean over a box that passes the patch at y, in steps of an eighth of a cell.
ShearPeak largest_shear(const HalfSpace& half_space, double size, double y) {
  constexpr int kPerCell = 8;
  const half_space::Grid& grid = half_space.grid();
  ShearPeak peak;
  for (int i = 0; i <= kPerCell * (grid.nx - 1); ++i) {
    const double x = grid.x(0) + i * (grid.x(1) - grid.x(0)) / kPerCell;
    const double shear = half_space.mean_shear(half_space.per_box, size, x, y).size();
    if (shear > peak.shear) peak = {x, shear};
  }
  return peak;
}

/// Values of the half-space.
struct SteadyReference {
  half_space::SteadyCreepage creepage;
  double slip_fraction = 0;
  double slip_length = 0;  ///< length of the slip zone on the axis [m]
  double max_shear = 0;    ///< shear on the axis, mean over a box of the element's size [Pa]
  double work = 0;         ///< work in the strip of one element's width on the axis [J/m2]
  double von_mises = 0;    ///< Von Mises stress of a surface element's mean stress [Pa]
};

/// Length of the slip zone on the row of cells nearest to the axis [m].
double slip_length(const HalfSpace& half_space) {
  const half_space::Grid& grid = half_space.grid();
  const int axis = static_cast<int>(std::lround(-grid.y0 / grid.dy));
  int cells = 0;
  for (int i = 0; i < grid.nx; ++i)
    cells += half_space.state.slipping[static_cast<std::size_t>(grid.index(i, axis))];
  return cells * grid.dx;
}

/// Distance of the row of nodes on the axis from the middle of the patch [m].
double row_aside(const TyreOnBlock& bodies) {
  return std::abs(bodies.grid_offset) * bodies.element_size;
}

SteadyReference reference_of(const TyreOnBlock& bodies, const HalfSpace& half_space, double force) {
  const double h = bodies.element_size;
  SteadyReference reference;
  reference.creepage =
      half_space::steady_creepage({half_space.influence.material, bodies.radius, bodies.crown_radius,
                                   bodies.load, bodies.friction, force});
  reference.slip_fraction = half_space.state.slip_fraction;
  reference.slip_length = slip_length(half_space);
  reference.work = half_space::centre_element_work(half_space.grid(), half_space.state, h) / (h * h);
  const ShearPeak box = largest_shear(half_space, h, row_aside(bodies));
  reference.max_shear = box.shear;
  // Elements stand beside the axis when nodes stand on it; the largest stress is near the largest shear.
  reference.von_mises = half_space::largest_box_stress(
      {half_space.grid(), half_space.contact.pressure, half_space.state.tractions,
       bodies.elastic.rail.poissons_ratio},
      {box.x, 0.5 * h - row_aside(bodies), 0, h, h, h}, 0.5 * bodies.hertz_patch().semi_axis_x);
  return reference;
}

/// Shear stress along the axis at the last step.
Figure shear_figure(const TyreOnBlock& bodies, const Rolled& rolled, const HalfSpace& half_space) {
  Series ours{"nodes", {}, {}, Stroke::solid};
  Series averaged{"half-space, mean over an element", {}, {}, Stroke::dashed};
  Series cells{"half-space", {}, {}, Stroke::solid};
  for (const PatchPoint& node : rolled.nodes) {
    ours.x.push_back(1e3 * node.x);
    ours.y.push_back(1e-6 * node.shear);
  }
  for (int i = 0; i < half_space.grid().nx; ++i) {
    const double x = half_space.grid().x(i);
    averaged.x.push_back(1e3 * x);
    averaged.y.push_back(
        1e-6 * half_space.mean_shear(half_space.per_box, bodies.element_size, x, row_aside(bodies)).x);
    cells.x.push_back(1e3 * x);
    cells.y.push_back(1e-6 * half_space.mean_shear(1, 0, x, row_aside(bodies)).x);
  }
  Figure figure;
  figure.title = "Surface shear stress on the axis";
  figure.x_label = "x, rolling to the right [mm]";
  figure.panels = {{"Shear stress on the wheel [MPa]", {ours, averaged, cells}, {}, 260, std::nullopt}};
  return figure;
}

CaseResult steady_rolling(const VerifyInputs& inputs, const ProgressText& progress) {
  TyreOnBlock bodies = driven_tyre(inputs);
  const double mu = inputs["mu"];
  const double speed = inputs["speed"];
  const double ramp = inputs["ramp"];
  const double observed = 5 * bodies.hertz_patch().semi_axis_x;
  const double way = speed * 1.15 * ramp + observed;
  const double free = free_creepage(bodies, speed, way, observed, progress);
  bodies.roll_on(speed, way, observed, smooth_traction(mu, ramp));
  const Rolled rolled = roll_tyre(bodies, observed, progress);
  const double creepage = rolled.creepage - free;
  const HalfSpace half_space(bodies, rolled.force);
  const SteadyReference reference = reference_of(bodies, half_space, rolled.force);
  // The shear is largest where slip begins, and all work is done in the slip zone.
  const auto in_slip_zone = [&](double factor, const Finding& finding) {
    return judged_by_slip_zone(finding, factor, bodies.element_size, reference.slip_length);
  };
  const double fineness = bodies.fineness();

  CaseResult result;
  result.findings = {
      {"F_L / F_N", "-", rolled.force / rolled.normal_force, mu, 0.02},
      {"creepage less free rolling", "%", 100 * creepage, 100 * reference.creepage.mean, 0.08 * fineness},
      {"standard error of the half-space's creepage / creepage", "-", reference.creepage.error, 0, {}, true},
      in_slip_zone(0.1,
                   {"creepage from the frictional work", "%", 100 * rolled.work_creepage, 100 * creepage}),
      {"slip area / patch area", "-", rolled.slip_fraction, reference.slip_fraction, 0.05 * fineness, true},
      in_slip_zone(
          0.25, {"largest shear on the axis", "MPa", 1e-6 * rolled.shear.mean, 1e-6 * reference.max_shear}),
      in_slip_zone(0.04, {"standard deviation of the largest shear along the rail / mean",
                          "-",
                          rolled.shear.deviation / rolled.shear.mean,
                          0,
                          {},
                          true}),
      {"standard deviation of F_L / mean", "-", rolled.force_deviation, 0, {}, true},
      in_slip_zone(0.25, {"frictional work on the axis", "J/m2", rolled.work, reference.work}),
      {"Von Mises stress of the surface elements", "MPa", 1e-6 * rolled.surface.von_mises.mean,
       1e-6 * reference.von_mises, 0.05 * std::max(1.0, fineness)},
      {"lost by the lead of the contact forces / frictional work", "-", rolled.lead_loss, 0, {}, true},
      {"energy residual / frictional work", "-", rolled.energy_residual, 0, 0.01, true}};
  add_dundurs(bodies, result);
  result.figures = {shear_figure(bodies, rolled, half_space),
                    creepage_figure(rolled, free, reference.creepage.mean)};
  return result;
}

}  // namespace

VerifyCase steady_rolling_case() {
  std::vector<VerifyInput> inputs = driven_inputs();
  inputs.push_back({"speed", &kSpeed, "m/s", 40, {1, 150}, "the rolling speed"});
  inputs.push_back({"ramp", &kTime, "ms", 0.75e-3, {1e-5, 0.1}, "the time in which the torque grows"});
  return {"steady_rolling", "a wheel of two radii rolls steadily under traction, against the half-space",
          std::move(inputs), steady_rolling};
}

}  // namespace tread
