// From a shift to steady rolling: a torque grows while the wheel hardly rolls, then the wheel rolls on under
// it. [Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, ch. 5]

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/statistics.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/ride.hpp"
#include "drivers/verify/tyre_on_block.hpp"
#include "kernels/half_space/half_space_steady.hpp"

namespace tread {

namespace {

/// Distance and turn of the wheel.
struct WayPoint {
  double way = 0;     ///< distance of the wheel [m]
  double turned = 0;  ///< angle times radius less the distance [m]
  double force = 0;   ///< F_L / F_N [-]
};

constexpr double kPeriods = 2.5;  ///< periods of the wheel's turning on its patch while the torque grows

struct Curve {
  std::vector<double> way;       ///< [m]
  std::vector<double> creepage;  ///< [-]
};

/// The half-space: a shift, then rolling under a constant force. The distance counts from the shift.
struct TransientReference {
  Curve curve;        ///< of one grid
  Curve scaled;       ///< the same times `scale`: that of the limit of fine grids
  double steady = 0;  ///< steady creepage of the curve's grid [-]
  double scale = 1;   ///< steady creepage of many grids over it [-]
};

TransientReference reference_of(const TyreOnBlock& bodies, double force, double way) {
  using namespace half_space;
  const HertzPatch patch = bodies.hertz_patch();
  const double semi = std::min(patch.semi_axis_x, patch.semi_axis_y);
  const half_space::Material material = bodies.elastic.alike();
  constexpr double kCells = 11;  // in the smaller semi-axis
  const double cell = semi / kCells;
  const Influence influence(centred_grid(patch.semi_axis_x + 3 * cell, patch.semi_axis_y + 3 * cell, cell),
                            material);
  const NormalContact contact =
      press(influence, quadratic_gap(bodies.radius, bodies.crown_radius), bodies.load);
  const RollingContact rolling(influence, contact, bodies.friction);
  TransientReference reference;
  reference.steady = rolling.steady(force).creepage;
  const SteadyCreepage steady =
      steady_creepage({material, bodies.radius, bodies.crown_radius, bodies.load, bodies.friction, force});
  reference.scale = steady.mean / reference.steady;
  FrictionState state = rolling.shift(rolling.free_state(), force);
  for (int step = 0; step * cell < way; ++step) {
    state = rolling.roll(state, force);
    reference.curve.way.push_back((step + 0.5) * cell);
    reference.curve.creepage.push_back(state.creepage);
  }
  reference.scaled = reference.curve;
  for (double& creepage : reference.scaled.creepage) creepage *= reference.scale;
  return reference;
}

double interpolate(const Curve& curve, double way) {
  const auto above = std::lower_bound(curve.way.begin(), curve.way.end(), way);
  if (above == curve.way.begin()) return curve.creepage.front();
  if (above == curve.way.end()) return curve.creepage.back();
  const auto i = static_cast<std::size_t>(above - curve.way.begin());
  const double t = (way - curve.way[i - 1]) / (curve.way[i] - curve.way[i - 1]);
  return curve.creepage[i - 1] + t * (curve.creepage[i] - curve.creepage[i - 1]);
}

struct Transient {
  std::vector<WayPoint> places;
  double residual = 0;  ///< residual of the energy, over the frictional work [-]
};

Transient roll(const TyreOnBlock& bodies, const ProgressText& progress) {
  Model model(bodies.scene());
  progress(fmt::format("{} elements of {:.3g} mm", model.elements(), 1e3 * bodies.element_size));
  const Preload preload = solve_preload(model, steady_motion(model), progress);
  constexpr int kSamples = 2000;
  WholeRun run = whole_run(model, preload, kSamples);
  const Simulation& simulation = run.simulation;
  progress(fmt::format("{} steps of {:.3e} s", run.steps, simulation.dt()));
  Transient transient;
  run.roll([&] {
    const Sample& sample = simulation.sample();
    const double way = simulation.wheel().origin.x;
    const double angle = simulation.wheel().angle + simulation.wheel_motion().rotation;
    transient.places.push_back({way, angle * bodies.radius - way, sample.traction()});
    transient.residual = std::abs(sample.energy.residual) / sample.energy.frictional_work;
    if (transient.places.size() % 200 == 0)
      progress(fmt::format("x {:.2f} mm, F_N {:.2f} kN, F_L / F_N {:.4f}", 1e3 * way,
                           1e-3 * sample.vertical_force, transient.places.back().force));
  });
  return transient;
}

/// Creepage: mean slope of the turned over the rolled distance, weighted by a triangle of half the base
/// `period` [m], which hides the wheel's oscillation of that period.
Curve creepage_curve(const Transient& transient, double period) {
  const std::vector<WayPoint>& places = transient.places;
  std::vector<double> sum{0};
  for (const WayPoint& place : places) sum.push_back(sum.back() + place.turned);
  const double spacing = (places.back().way - places.front().way) / static_cast<double>(places.size() - 1);
  const auto box = static_cast<std::size_t>(std::lround(period / spacing));
  Curve curve;
  for (std::size_t i = box; i + box < sum.size(); ++i) {
    const double ahead = sum[i + box] - sum[i];
    const double behind = sum[i] - sum[i - box];
    const double n = static_cast<double>(box);
    const double ratio = (ahead - behind) / (n * n * spacing);  // (w R - v) / v
    curve.way.push_back(0.5 * (places[i - 1].way + places[i].way));
    curve.creepage.push_back(ratio / (1 + 0.5 * ratio));
  }
  return curve;
}

/// Creepage of a curve less that of `free` rolling from the same start, place by place.
Curve less_free(Curve curve, const Curve& free) {
  for (std::size_t i = 0; i < curve.way.size(); ++i) curve.creepage[i] -= interpolate(free, curve.way[i]);
  return curve;
}

/// Period [s] with which the wheel turns to and fro on the sticking patch, with a guess of the bodies' own
/// compliance.
double turning_period(const TyreOnBlock& bodies) {
  const HertzPatch patch = bodies.hertz_patch();
  const ElasticConstants alike = bodies.elastic.alike();
  const double radius = std::sqrt(patch.semi_axis_x * patch.semi_axis_y);
  const double compliance = 1.15 * (2 - alike.poissons_ratio) / (4 * radius * alike.shear_modulus());
  const Model model(bodies.scene());
  const double mass = model.wheelset->inertia() / (bodies.radius * bodies.radius);
  return 2 * std::numbers::pi * std::sqrt(mass * compliance);
}

/// The largest creepage of a curve and its place.
struct CreepagePeak {
  double size = 0;  ///< [-]
  double way = 0;   ///< [m]
};

/// Largest creepage times `sign` from the distance `from` [m] on.
CreepagePeak peak_of(const Curve& curve, double from, double sign) {
  CreepagePeak peak;
  for (std::size_t i = 0; i < curve.way.size(); ++i)
    if (curve.way[i] >= from && sign * curve.creepage[i] > peak.size)
      peak = {sign * curve.creepage[i], curve.way[i]};
  return peak;
}

/// Largest difference of two curves from the distance `from` [m] on [-].
double largest_difference(const Curve& ours, const Curve& reference, double from) {
  double difference = 0;
  for (std::size_t i = 0; i < ours.way.size(); ++i)
    if (ours.way[i] >= from)
      difference = std::max(difference, std::abs(ours.creepage[i] - interpolate(reference, ours.way[i])));
  return difference;
}

/// Creepage in per cent over the distance in millimetres, from the distance `from` [m] on.
Series shown(const char* name, const Curve& curve, double from, Stroke stroke) {
  Series series{name, {}, {}, stroke};
  for (std::size_t i = 0; i < curve.way.size(); ++i) {
    if (curve.way[i] < from) continue;
    series.x.push_back(1e3 * curve.way[i]);
    series.y.push_back(100 * curve.creepage[i]);
  }
  return series;
}

/// Creepage from the way `from` [m] on beside the half-space, and the traction coefficient.
Figure transient_figure(const Transient& transient, const Curve& ours, const TransientReference& reference,
                        double from) {
  Series force{"F_L / F_N", {}, {}, Stroke::solid};
  for (const WayPoint& place : transient.places) {
    force.x.push_back(1e3 * place.way);
    force.y.push_back(place.force);
  }
  Figure figure;
  figure.title = "From a shift to steady rolling";
  figure.x_label = "Position of the wheel [mm]";
  figure.panels = {{"Creepage [%]",
                    {shown("finite elements", ours, from, Stroke::solid),
                     shown("half-space, one grid", reference.curve, 0, Stroke::dashed),
                     shown("half-space, scaled to fine grids", reference.scaled, 0, Stroke::dotted)},
                    {{100 * reference.scale * reference.steady, "steady"}},
                    260,
                    std::nullopt},
                   {"Traction coefficient [-]", {force}, {}, 160, std::nullopt}};
  return figure;
}

CaseResult transient_rolling(const VerifyInputs& inputs, const ProgressText& progress) {
  TyreOnBlock bodies = driven_tyre(inputs);
  const double mu = inputs["mu"];
  const double a = bodies.hertz_patch().semi_axis_x;
  const double way = inputs["way"] * a;
  const double grown = inputs["growth"] * a;
  // A torque that grows as half a cosine of 2.5 periods leaves the wheel nearly at rest on its patch.
  const auto drive = [&](double period, double traction) {
    const double ramp = kPeriods * period;
    bodies.roll_on(grown / ramp, way, way, smooth_traction(traction, ramp));
  };
  drive(1e-3, mu);
  const double period = turning_period(bodies);
  drive(period, 0);
  const Transient free = roll(bodies, progress);
  drive(period, mu);
  const Transient transient = roll(bodies, progress);

  const double window = grown / kPeriods;
  const Curve ours = less_free(creepage_curve(transient, window), creepage_curve(free, window));
  TransientReference reference = reference_of(bodies, mu * bodies.load, way);
  for (Curve* curve : {&reference.curve, &reference.scaled})
    for (double& x : curve->way) x += 0.5 * grown;  // the shift lies in the middle of the growth
  const Statistics full = statistics(
      transient.places, [&](const WayPoint& place) { return place.way >= grown; },
      [](const WayPoint& place) { return place.force; });
  const double from = grown + window;
  const double sign = mu > 0 ? 1 : -1;
  const double steady = std::abs(reference.steady);
  const CreepagePeak highest = peak_of(ours, from, sign);
  const CreepagePeak top = peak_of(reference.scaled, 0, sign);
  const double bound = std::clamp(0.035 * bodies.fineness(), 0.05, 0.1);
  CaseResult result;
  // The finite elements rise later than both curves; the difference falls with the mesh.
  result.findings = {
      {"largest difference of the creepages from the curve scaled to the limit of fine grids / steady value",
       "-", largest_difference(ours, reference.scaled, from) / (reference.scale * steady), 0, 0.1, true},
      {"the same from the curve of one grid / steady value",
       "-",
       largest_difference(ours, reference.curve, from) / steady,
       0,
       {},
       true},
      {"largest creepage", "%", 100 * sign * highest.size, 100 * sign * top.size, bound},
      {"where", "mm", 1e3 * highest.way, 1e3 * top.way, {}},
      {"creepage at the end", "%", 100 * ours.creepage.back(), 100 * reference.scale * reference.steady,
       bound},
      {"smallest F_L / F_N under the full torque", "-", full.min, mu, 0.05},
      {"largest F_L / F_N under the full torque", "-", full.max, mu, 0.05},
      {"energy residual / frictional work", "-", transient.residual, 0, 0.01, true}};
  add_dundurs(bodies, result);
  result.figures.push_back(transient_figure(transient, ours, reference, from));
  return result;
}

}  // namespace

VerifyCase transient_rolling_case() {
  std::vector<VerifyInput> inputs = driven_inputs(1.6e-3);
  inputs.push_back(
      {"growth", nullptr, "", 0.15, {0.02, 0.5}, "the way while the torque grows, in semi-axes"});
  inputs.push_back({"way", nullptr, "", 3, {1, 10}, "the way in semi-axes of the patch"});
  return {"transient", "from a shift to steady rolling, against the half-space", std::move(inputs),
          transient_rolling};
}

}  // namespace tread
