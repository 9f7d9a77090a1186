// A bore on a rigid carrier: unknown of the statics, momentum of a step, balance of the whole wheel.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "kernels/connectors/guided_bore.hpp"
#include "tests/measured.hpp"
#include "tests/refusal.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

Scene guided_scene(const std::vector<std::string>& more) {
  std::vector<std::string> overrides = {"scene.gravity=0 m/s2", "scene.element_size=6 mm",
                                        "wheel.bore=guided"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return samples::tyre_scene(overrides);
}

std::string refusal(const std::vector<std::string>& more) {
  return samples::refusal<InputError>([&] { guided_scene(more); });
}

double dot_fields(const AlignedVector<double>& a, const AlignedVector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

TEST(GuidedBore, ReduceIsTheTransposeOfExpand) {
  Model model(guided_scene({"wheel.overhang=60 mm"}));
  ASSERT_TRUE(model.guide);
  const auto n = static_cast<std::size_t>(3 * model.mesh.slots);
  AlignedVector<double> rise(n, 0.0);
  AlignedVector<double> force(n, 0.0);
  const auto unknown = static_cast<std::size_t>(model.guide->unknown());
  rise[unknown] = 2e-4;
  for (std::size_t i = 0; i < n; ++i) force[i] = std::sin(static_cast<double>(i));
  AlignedVector<double> expanded = rise;
  model.guide->expand(expanded.data());
  AlignedVector<double> again = expanded;
  model.guide->expand(again.data());
  EXPECT_EQ(again[unknown], expanded[unknown]);
  const double work = dot_fields(expanded, force);
  AlignedVector<double> reduced = force;
  model.guide->reduce(reduced.data());
  EXPECT_NEAR(reduced[unknown] * rise[unknown], work, 1e-12 * std::abs(work));
}

/// The way is a quarter of a turn, and a whole one with the spin.
TEST(GuidedBore, APartOfARingIsLongEnoughForTheSpin) {
  std::vector<std::string> keys = {"wheel.overhang=60 mm", "rail.length=1.2 m", "motion.duration=9 ms"};
  EXPECT_EQ(refusal(keys), "");
  keys.emplace_back("motion.creepage=1.2");
  EXPECT_EQ(refusal(keys),
            "--set: wheel.overhang: the wheel rolls on most of its ring, because motion.creepage makes it "
            "spin 4 times as fast as free rolling; leave the overhang out");
}

TEST(GuidedBore, StepKeepsTheMomentumUnderLoadAndTorque) {
  Model model(guided_scene({"wheel.overhang=60 mm"}));
  const auto n = static_cast<std::size_t>(3 * model.mesh.slots);
  AlignedVector<double> u(n, 0.0);
  AlignedVector<double> w(n, 0.0);
  const BodyFrame frame{{0, 0, 0.43}, {20, 0, 0}, -0.1, 46};
  const double dt = 2e-7;
  const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(model.index.tread)];
  double mass = 0;
  double inertia = 0;
  double arm = 0;
  for (const int node : block.section.paths.at("bore"))
    for (int station = 0; station < block.station_count(); ++station) {
      const std::int64_t slot = block.base + block.slot(node, station);
      const double m = model.mass[static_cast<std::size_t>(slot)];
      const double r = block.section.q[static_cast<std::size_t>(node)];
      mass += m;
      inertia += m * r * r;
      arm += m * r * std::sin(block.stations[static_cast<std::size_t>(station)] + frame.angle);  // towards -x
    }
  model.guide->move({u.data(), w.data()}, frame, dt, {1000, 50});
  const MeanMotion motion = model.guide->motion();
  EXPECT_NEAR(mass * motion.velocity.z + arm * motion.spin, 1000 * dt, 1e-6 * 1000 * dt);
  EXPECT_NEAR(arm * motion.velocity.z + inertia * motion.spin, 50 * dt, 1e-6 * 50 * dt);
  EXPECT_EQ(motion.velocity.x, 0);
}

TEST(GuidedBore, LoadAndTorqueReachTheRailAndTheEnergyCloses) {
  Model model(guided_scene({"wheel.overhang=60 mm", "motion.speed=5 m/s", "motion.duration=1 ms",
                            "motion.traction.mu=0.2", "motion.traction.ramp=0.5 ms"}));
  const Preload preload = solve_preload(model, steady_motion(model), [](const std::string&) {});
  measured("F_N / load - 1", -preload.contact.force_on_rail.z / 87564 - 1);
  EXPECT_NEAR(-preload.contact.force_on_rail.z / 87564, 1, 5e-3);  // includes the part's centrifugal force
  const double stable = step_limit(model).stable_step;
  Simulation simulation(model, preload, 0.95 * stable);
  simulation.set_sampling_interval(20);
  double force = 0;
  int samples = 0;
  while (simulation.time() < 1e-3) {
    simulation.step();
    if (!simulation.sampled() || simulation.time() < 0.5e-3) continue;
    force += simulation.sample().longitudinal_force;
    ++samples;
  }
  const Sample& last = simulation.sample();
  measured("F_L / F_N", force / samples / 87564);
  EXPECT_NEAR(force / samples / 87564, 0.2, 0.02);
  EXPECT_EQ(last.wheel_speed, 5);
  const EnergyLedger& energy = last.energy;
  measured("energy residual", energy.residual, "J");
  measured("work of the guide", energy.guide_work, "J");
  measured("work of the torque", energy.torque_work, "J");
  measured("frictional work", energy.frictional_work, "J");
  EXPECT_LT(std::abs(energy.residual), 1e-5 * energy.torque_work);
  const MomentumCheck momentum = simulation.momentum_check();
  measured("momentum error x", (momentum.impulse.x - momentum.change.x) / momentum.contact_impulse.z);
  EXPECT_NEAR(momentum.impulse.x, momentum.change.x, 1e-6 * momentum.contact_impulse.z);
  EXPECT_NEAR(momentum.impulse.z, momentum.change.z, 1e-6 * momentum.contact_impulse.z);
}

TEST(GuidedBore, HasNoCreepageAtRest) {
  Model model(guided_scene({"wheel.overhang=60 mm", "motion.speed=0 m/s"}));
  const Preload preload = solve_preload(model, steady_motion(model), [](const std::string&) {});
  Simulation simulation(model, preload, 0.9 * step_limit(model).stable_step);
  simulation.set_sampling_interval(1);
  while (simulation.steps() < 3) {
    simulation.step();
    EXPECT_EQ(simulation.sample().creepage_mean, 0);
    EXPECT_EQ(simulation.sample().creepage_node, 0);
  }
}

TEST(GuidedBore, TorqueReverses) {
  MotionSpec motion;
  motion.ramp = 2;
  motion.reversals = 2;
  for (const auto& [time, share] :
       {std::array{0.0, 0.0}, std::array{1.0, 0.5}, std::array{2.0, 1.0}, std::array{4.0, 0.0},
        std::array{6.0, -1.0}, std::array{8.0, 0.0}, std::array{10.0, 1.0}, std::array{50.0, 1.0}})
    for (const char* shape : {"linear", "smooth"}) {
      motion.ramp_shape = shape;
      EXPECT_NEAR(motion.torque_share(time), share, 1e-12) << shape << time;
    }
}

}  // namespace
}  // namespace tread
