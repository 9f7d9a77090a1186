// A sphere pressed on a block and pushed tangentially, forwards and back, by a torque so slow that inertia is
// negligible. [Mindlin and Deresiewicz, J. Appl. Mech. 20 (1953) 327; Johnson, Contact Mechanics, sect. 7.2
// and 7.4]

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/ride.hpp"
#include "drivers/verify/tyre_on_block.hpp"

namespace tread {

namespace {

/// Mindlin's sphere; q: tangential force over f F_N.
struct Mindlin {
  double radius = 0;  ///< radius of the patch [m]
  double limit = 0;   ///< shift at which the whole patch slides [m]
  double force = 0;   ///< f F_N [N]

  Mindlin(const TyreOnBlock& bodies) {
    const ElasticConstants alike = bodies.elastic.alike();
    radius = bodies.hertz_patch().semi_axis_x;
    force = bodies.friction * bodies.load;
    limit = 3 * force * (2 - alike.poissons_ratio) / (8 * radius * alike.shear_modulus());
  }
  double stick_radius(double q) const { return radius * std::cbrt(1 - q); }
  double first_shift(double q) const { return limit * (1 - std::pow(1 - q, 2.0 / 3)); }
  /// Shift on the way back from `turn`.
  double shift_back(double turn, double q) const {
    return limit * (2 * std::pow(1 - 0.5 * (turn - q), 2.0 / 3) - std::pow(1 - turn, 2.0 / 3) - 1);
  }
  /// Area of the loop between -q and q [J].
  double loop_work(double q) const {
    return 2 * force * limit *
           (2.4 * (1 - std::pow(1 - q, 5.0 / 3)) - 2 * q * (1 + std::pow(1 - q, 2.0 / 3)));
  }
};

/// Forward displacement on the axis at depth z of a body, a half-space, under the patch's tractions on the
/// wheel; those on the rail are the opposite. [Cerruti; Johnson, sect. 3.6] [m]
double deep_displacement(const ElasticConstants& body, const std::vector<ContactPoint>& points, double z) {
  const double nu = body.poissons_ratio;
  double sum = 0;
  for (const ContactPoint& point : points) {
    const double x = point.position.x;
    const double r = std::hypot(x, point.position.y, z);
    const double kernel =
        1 / r + x * x / (r * r * r) + (1 - 2 * nu) * (1 / (r + z) - x * x / (r * (r + z) * (r + z)));
    sum -= point.area * point.shear.along * kernel;
  }
  return (1 + nu) / (2 * std::numbers::pi * body.youngs_modulus) * sum;
}

struct Moment {
  double push = 0;          ///< tangential force on the wheel over f F_N
  double shift = 0;         ///< backward shift of distant points of the wheel against those of the block [m]
  double stick_radius = 0;  ///< [m]
  double work = 0;          ///< frictional work since the start [J]
  double residual = 0;      ///< residual of the energy [J]
};

/// Shift of the bodies as seen by two points on the axis, one in each body, at equal depth: their relative
/// displacement and the remaining displacement of a half-space from there on [m].
double shift_seen(const TyreOnBlock& bodies, const Model& model, const Simulation& simulation, double depth) {
  const ConstNodeField u = simulation.displacement();
  const double rail = displacement_at(model, model.index.rail_cap, 0, -depth, 0, u).x;
  const double turned = simulation.wheel_motion().rotation;
  const double wheel = -displacement_at(model, model.index.tread, 0, bodies.radius - depth, 0, u).x -
                       turned * (bodies.radius - depth);
  const double carrier = (simulation.wheel().angle + turned) * bodies.radius;
  const std::vector<ContactPoint>& points = model.contact->points();
  return carrier + wheel + rail + deep_displacement(bodies.elastic.wheel, points, depth) +
         deep_displacement(bodies.elastic.rail, points, depth);
}

/// Shift of distant points [m]. Finite bodies under tangential forces turn a little as a whole, half-spaces
/// do not. The shifts seen from two and four semi-axes deep are therefore continued to the surface.
double distant_shift(const TyreOnBlock& bodies, const Model& model, const Simulation& simulation) {
  const double a = bodies.hertz_patch().semi_axis_x;
  return 2 * shift_seen(bodies, model, simulation, 2 * a) - shift_seen(bodies, model, simulation, 4 * a);
}

std::vector<Moment> push_and_pull(const TyreOnBlock& bodies, const ProgressText& progress) {
  Model model(bodies.scene());
  progress(fmt::format("{} elements of {:.3g} mm", model.elements(), 1e3 * bodies.element_size));
  const Preload preload = solve_preload(model, {}, progress);
  constexpr int kSamples = 1500;
  WholeRun run = whole_run(model, preload, kSamples);
  const Simulation& simulation = run.simulation;
  progress(fmt::format("{} steps of {:.3e} s", run.steps, simulation.dt()));
  const double limit = bodies.friction * bodies.load;
  const double start = distant_shift(bodies, model, simulation);
  std::vector<Moment> moments;
  run.roll([&] {
    const Sample& sample = simulation.sample();
    const double stick = std::max(sample.patch_area - sample.slip_area, 0.0);
    moments.push_back({sample.longitudinal_force / limit, distant_shift(bodies, model, simulation) - start,
                       std::sqrt(stick / std::numbers::pi), sample.energy.frictional_work,
                       sample.energy.residual});
    if (moments.size() % 150 == 0)
      progress(fmt::format("t {:.2f} ms, F_L / f F_N {:.4f}, shift {:.3f} um", 1e3 * sample.time,
                           moments.back().push, 1e6 * moments.back().shift));
  });
  return moments;
}

Figure loop_figure(const Mindlin& theory, const std::vector<Moment>& moments, double turn) {
  Series ours{"finite elements", {}, {}, Stroke::solid};
  Series mindlin{"Mindlin", {}, {}, Stroke::dashed};
  for (const Moment& moment : moments) {
    ours.x.push_back(1e6 * moment.shift);
    ours.y.push_back(moment.push);
  }
  const auto add = [&](double shift, double push) {
    mindlin.x.push_back(1e6 * shift);
    mindlin.y.push_back(push);
  };
  constexpr int kPoints = 60;
  for (int i = 0; i <= kPoints; ++i) add(theory.first_shift(turn * i / kPoints), turn * i / kPoints);
  for (int i = kPoints; i >= -kPoints; --i)
    add(theory.shift_back(turn, turn * i / kPoints), turn * i / kPoints);
  for (int i = kPoints; i >= -kPoints; --i)
    add(-theory.shift_back(turn, turn * i / kPoints), -turn * i / kPoints);
  Figure figure;
  figure.title = "Tangential force against shift";
  figure.x_label = "Shift of distant points [um]";
  figure.panels = {{"F_L / (f F_N) [-]", {ours, mindlin}, {}, 320, std::nullopt}};
  return figure;
}

CaseResult cattaneo_mindlin(const VerifyInputs& inputs, const ProgressText& progress) {
  TyreOnBlock bodies = tyre_of(inputs, true);
  bodies.friction = inputs["friction"];
  bodies.guided = true;
  const double ramp = inputs["ramp"];
  const double wanted = inputs["push"];
  bodies.more = fmt::format(
      "[motion]\nspeed = \"0 m/s\"\nduration = \"{} s\"\n"
      "traction = {{ mu = {}, ramp = \"{} s\", reversals = 2, shape = \"smooth\" }}\n",
      5.3 * ramp, wanted * bodies.friction, ramp);
  const std::vector<Moment> moments = push_and_pull(bodies, progress);
  const Mindlin theory(bodies);

  // The turning points are the largest forces of the first push, the pull and the second push.
  const auto at = [&](double time) {
    return moments.begin() + static_cast<std::ptrdiff_t>(time / 5.3 * static_cast<double>(moments.size()));
  };
  const auto by_push = [](const Moment& a, const Moment& b) { return a.push < b.push; };
  const auto first = std::max_element(moments.begin(), at(2), by_push);
  const auto pull = std::min_element(at(2), at(4), by_push);
  const auto second = std::max_element(at(4), moments.end(), by_push);
  const double turn = 0.25 * (first->push + second->push - 2 * pull->push);
  if (!(first->push < 1 && turn < 1))
    throw NumericalError("verify: the wheel slides as a whole; lower push, or raise ramp");
  const auto rises_to = [&](double push) {
    return std::find_if(moments.begin(), first, [&](const Moment& m) { return m.push >= push; });
  };
  const auto half = rises_to(0.5 * wanted);
  const auto back = std::find_if(first, pull, [](const Moment& m) { return m.push <= 0; });
  // A point that sticks at the largest force has never slipped; a point that slipped may stick there already.
  const auto least = std::min_element(moments.begin(), first + 1, [](const Moment& a, const Moment& b) {
    return a.stick_radius < b.stick_radius;
  });

  const double um = 1e6;
  const double mm = 1e3;
  const double shift_bound = 0.03 * std::max(1.0, bodies.fineness());
  CaseResult result;
  result.findings = {
      {"largest F_L / (f F_N)", "-", turn, wanted, 0.02},
      {"stick radius", "mm", mm * least->stick_radius, mm * theory.stick_radius(first->push),
       mm * 0.5 * bodies.element_size, true},
      {"stick radius at half of the force", "mm", mm * half->stick_radius,
       mm * theory.stick_radius(half->push), mm * 0.5 * bodies.element_size, true},
      {"shift", "um", um * first->shift, um * theory.first_shift(first->push), shift_bound},
      {"shift at half of the force", "um", um * half->shift, um * theory.first_shift(half->push),
       shift_bound},
      {"shift left when the force is gone",
       "um",
       um * back->shift,
       um * theory.shift_back(first->push, back->push),
       {}},
      judged_by_slip_zone({"work of the loop", "J", second->work - first->work, theory.loop_work(turn)}, 0.1,
                          bodies.element_size, theory.radius - theory.stick_radius(turn)),
      {"energy residual / frictional work", "-", std::abs(moments.back().residual) / moments.back().work, 0,
       0.01, true}};
  add_dundurs(bodies, result);
  result.figures.push_back(loop_figure(theory, moments, turn));
  return result;
}

}  // namespace

VerifyCase cattaneo_mindlin_case() {
  std::vector<VerifyInput> inputs = tyre_inputs(true);
  inputs.push_back({"friction", nullptr, "", 0.5, {0.01, 2}, "the coefficient of friction f"});
  inputs.push_back({"push", nullptr, "", 0.875, {0.05, 0.95}, "the largest tangential force over f F_N"});
  inputs.push_back({"ramp", &kTime, "ms", 2e-3, {1e-5, 0.1}, "the time of the first push"});
  return {"cattaneo_mindlin", "a sphere pushed and pulled tangentially, against Cattaneo and Mindlin",
          std::move(inputs), cattaneo_mindlin};
}

}  // namespace tread
