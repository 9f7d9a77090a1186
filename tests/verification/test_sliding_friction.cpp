// Friction laws in sliding: force against the law, energy, and the growth of stick-slip vibrations.
// [theory.md, Friction]

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/aligned.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "kernels/contact/patch_solver.hpp"
#include "tests/measured.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

/// A locked wheel that slides over a coarse block.
class Slide {
 public:
  explicit Slide(std::vector<std::string> friction) {
    friction.insert(friction.end(), {"scene.element_size=6 mm", "motion.creepage=-2", "motion.speed=30 m/s",
                                     "motion.duration=1.2 ms", "solution_zone.start=0 mm"});
    model_ = std::make_unique<Model>(samples::tyre_scene(friction));
    const Preload preload = solve_preload(*model_, {}, [](const std::string&) {});
    const MotionSpec& motion = *model_->scene.motion;
    run_ =
        std::make_unique<Simulation>(*model_, preload, motion.step_safety * step_limit(*model_).stable_step);
    run_->set_sampling_interval(1);
  }

  /// Slides on; false at the end.
  bool step() {
    run_->step();
    return run_->time() < model_->scene.motion->duration;
  }

  const Sample& sample() const { return run_->sample(); }
  const Model& model() const { return *model_; }
  /// Force against the motion over F_N.
  double traction() const { return -sample().longitudinal_force / sample().vertical_force; }
  double time() const { return run_->time(); }

  void expect_closed_energy() const {
    const EnergyLedger& energy = sample().energy;
    measured("energy residual / frictional work", energy.residual / energy.frictional_work);
    EXPECT_GT(energy.frictional_work, 10);
    EXPECT_LT(std::abs(energy.residual), 0.005 * energy.frictional_work);
    EXPECT_NEAR(sample().slip_area, sample().patch_area, 1e-9 * sample().patch_area);
  }

 private:
  std::unique_ptr<Model> model_;
  std::unique_ptr<Simulation> run_;
};

std::string table_file(const std::string& name, const std::string& text) {
  static const samples::TemporaryFolder folder;
  std::string path = (folder.path / name).string();
  std::ofstream(path) << text;
  return path;
}

TEST(SlidingFriction, ATableGivesTheForceOfTheCoefficientUnderThePressure) {
  // Linear in x under the whole patch, so that F_L / F_N is f at the centre of pressure.
  const std::string file = table_file("spot.txt", "# x [mm]  f [-]\n0 0.5\n40 0.1\n");
  Slide slide(
      {"contact.friction_law=table", "contact.friction_file=" + file, "contact.friction_start=-5 mm"});
  double worst = 0;
  double lowest = 1;
  while (slide.step()) {
    if (slide.time() < 0.2e-3) continue;  // the stick has loaded
    const double centre = slide.model().contact->totals().centre.x;
    if (centre > 25e-3) continue;  // the patch's front leaves the slope
    const double f = 0.5 - 0.01 * 1e3 * (centre + 5e-3);
    worst = std::max(worst, std::abs(slide.traction() / f - 1));
    lowest = std::min(lowest, f);
  }
  measured("F_L / F_N against f at the centre of pressure - 1", worst);
  EXPECT_LT(lowest, 0.25);  // the spot has been crossed
  EXPECT_LT(worst, 0.005);
  slide.expect_closed_energy();
}

std::vector<std::string> falling(const std::string& memory) {
  return {"contact.friction_law=falling", "contact.friction=0.5", "contact.friction_fast=0.2",
          "contact.friction_speed=20 m/s", "contact.friction_memory=" + memory};
}

double mean_traction(Slide& slide) {
  double sum = 0;
  int count = 0;
  while (slide.step()) {
    if (slide.time() < 0.6e-3) continue;
    sum += slide.traction();
    ++count;
  }
  return sum / count;
}

TEST(SlidingFriction, FallingFrictionIsThatOfTheSlipSpeedOverAShortMemory) {
  Slide slide(falling("20 um"));
  const double found = mean_traction(slide);
  const double expected = 0.2 + 0.3 * std::exp(-slide.sample().wheel_speed / 20);
  measured("F_L / F_N over f(v) - 1", found / expected - 1);
  EXPECT_NEAR(found, expected, 0.01 * expected);
  slide.expect_closed_energy();
}

TEST(SlidingFriction, ALongMemoryFollowsOverTheWayThroughThePatch) {
  // A rail point has slid since it came into contact.
  constexpr double kMemory = 5e-3;
  Slide slide(falling("5 mm"));
  std::map<std::int64_t, double> slid;  // by rail point, in contact [m]
  double worst = 0;
  double lowest = 2;
  double before = 0;
  while (slide.step()) {
    const double speed = slide.sample().wheel_speed;
    std::map<std::int64_t, double> next;
    for (const ContactPoint& point : slide.model().contact->points()) {
      const auto known = slid.find(point.history);
      next[point.history] = known == slid.end() ? 0 : known->second + speed * (slide.time() - before);
    }
    slid = std::move(next);
    before = slide.time();
    if (slide.time() < 0.6e-3) continue;
    const double steady = 0.2 + 0.3 * std::exp(-speed / 20);
    double force = 0;
    double load = 0;
    for (const ContactPoint& point : slide.model().contact->points()) {
      const double f = steady + (0.5 - steady) * std::exp(-slid[point.history] / kMemory);
      force += f * point.area * point.pressure;
      load += point.area * point.pressure;
    }
    worst = std::max(worst, std::abs(slide.traction() * load / force - 1));
    lowest = std::min(lowest, force / load / steady);
  }
  measured("F_L / F_N over f by the points' slid ways - 1, largest", worst);
  EXPECT_GT(lowest, 1.05);
  EXPECT_LT(worst, 0.01);
  slide.expect_closed_energy();
}

/// A mass on a spring and a damper that a belt drags along: one contact point of constant pressure.
class MassOnBelt {
 public:
  static constexpr double kMass = 1e-3;                              // [kg]
  static constexpr double kFrequency = 2 * std::numbers::pi * 1000;  // [rad/s]
  static constexpr double kBelt = 1;                                 // [m/s]
  static constexpr double kLoad = 2;                                 // [N]
  static constexpr FallingFriction kLaw{0.5, 0.2, 1, 50e-6};

  explicit MassOnBelt(double damping)
      : damping_(damping), u_(3 * kSlots, 0.0), v_(u_.size(), 0.0), mass_(kSlots, kMass) {
    mass_[kRail] = 1e12;
    v_[dof(kRail, 0)] = kBelt;
    solver_.reserve(kSlots, 1, 2);
    // At steady sliding, but for a small speed.
    u_[dof(kWheel, 0)] = -kLoad * kLaw.steady(kBelt) / (kMass * kFrequency * kFrequency);
    v_[dof(kWheel, 0)] = -kKick;
    friction_.emplace<FrictionOf<FallingFriction>>(
        FrictionOf<FallingFriction>{kLaw, {{kLaw.friction_coefficient - kLaw.steady(kBelt)}}});
    shear_ = {-kLoad / kArea * kLaw.steady(kBelt), 0};
  }

  /// Growth rate of the vibration from the speeds at zero crossings of 20 periods [1/s].
  double growth() {
    std::vector<double> amplitudes;
    double largest = 0;
    const auto steps = static_cast<int>(2 * std::numbers::pi / kFrequency / kDt);
    for (int period = 0; period < 20; ++period, largest = 0) {
      for (int i = 0; i < steps; ++i) largest = std::max(largest, std::abs(step()));
      amplitudes.push_back(largest);
    }
    return std::log(amplitudes.back() / amplitudes[3]) / (16 * steps * kDt);
  }

  /// Root of (m s^2 + c s + k) (1 + s L / V) + N f'(V) s = 0 near the spring's frequency.
  double linear_growth() const {
    using Complex = std::complex<double>;
    const double slope = -0.3 * std::exp(-kBelt);  // f' [s/m]
    const double memory = kLaw.memory_length / kBelt;
    const auto value = [&](Complex s) {
      return (kMass * s * s + damping_ * s + kMass * kFrequency * kFrequency) * (1.0 + memory * s) +
             kLoad * slope * s;
    };
    Complex s{0, kFrequency};
    for (int i = 0; i < 30; ++i) {
      const Complex h{1e-3, 0};
      s -= value(s) * 2.0 * h / (value(s + h) - value(s - h));
    }
    return s.real();
  }

 private:
  static constexpr std::int64_t kSlots = 8;
  static constexpr std::int64_t kRail = 0;
  static constexpr std::int64_t kWheel = 1;
  static constexpr double kDt = 1e-6;       // [s]
  static constexpr double kArea = 1e-6;     // [m2]
  static constexpr double kPenalty = 1e13;  // [Pa/m]
  static constexpr double kKick = 1e-3;     // [m/s]

  /// Returns the speed of the mass [m/s].
  double step() {
    // Local components of the wheel: (-x, y, -z).
    double& u = u_[dof(kWheel, 0)];
    double& v = v_[dof(kWheel, 0)];
    ContactPoint point{};
    point.rail.slot.fill(kRail);
    point.wheel.slot.fill(kWheel);
    for (SurfaceSupport* support : {&point.rail, &point.wheel}) support->along[0] = support->across[0] = 1;
    point.wheel_cosine.fill(1);
    point.normal = {0, 0, -1};
    point.along = {1, 0, 0};
    point.across = {0, 1, 0};
    point.area = kArea;
    point.gap = -kLoad / kArea / kPenalty;
    point.velocity_before = {-v - kBelt, 0, 0};
    point.shear_before = shear_;
    point.pressure_before = kLoad / kArea;
    v += kDt * (-damping_ * v / kMass - kFrequency * kFrequency * u);
    u += kDt * v;
    std::vector<ContactPoint> points{point};
    solver_.solve(points, {kPenalty, {kPenalty}}, friction_, BodyFrame{},
                  {u_.data(), v_.data(), mass_.data()}, kDt);
    shear_ = points.front().shear;
    for (const int normal : {1, 2})  // the mass slides along the belt only
      u_[dof(kWheel, normal)] = v_[dof(kWheel, normal)] = 0;
    return v;
  }

  double damping_;  ///< [N s/m]
  AlignedVector<double> u_, v_, mass_;
  PatchSolver solver_;
  Friction friction_;
  Traction shear_;
};

TEST(SlidingFriction, AMassOnABeltVibratesUpWhereFallingFrictionExceedsItsDamping) {
  // Without memory the friction feeds in N |f'| of damping; the memory takes a part of it.
  const double fed = MassOnBelt::kLoad * 0.3 * std::exp(-1.0);
  for (const double share : {0.0, 0.5, 0.9, 1.2}) {
    MassOnBelt mass(share * fed);
    const double growth = mass.growth();
    const double expected = mass.linear_growth();
    measured("damping / N |f'| = " + std::to_string(share) + ": growth", growth, "1/s");
    measured("linear theory", expected, "1/s");
    EXPECT_NEAR(growth, expected, 0.03 * fed / (2 * MassOnBelt::kMass)) << share;
  }
  EXPECT_GT(MassOnBelt(0.5 * fed).growth(), 0);
  EXPECT_LT(MassOnBelt(1.2 * fed).growth(), 0);
}

}  // namespace
}  // namespace tread
