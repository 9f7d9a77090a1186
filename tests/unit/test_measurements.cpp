// Probes, forces of fastenings and stress under the patch, on small scenes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/results/measured_rows.hpp"
#include "tests/refusal.hpp"
#include "tests/swept_samples.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

/// A scene a few steps after its static state.
struct Rolled {
  Model model;
  Preload preload;
  Simulation simulation;

  explicit Rolled(const std::vector<std::string>& overrides, int steps = 1)
      : model(samples::tyre_scene(overrides)),
        preload(solve_preload(model, steady_motion(model), [](const std::string& /*text*/) {})),
        simulation(model, preload, 1e-7) {
    simulation.set_sampling_interval(1);
    for (int i = 0; i < steps; ++i) simulation.step();
  }

  double value(const std::string& name) const {
    const MeasuredRows rows(simulation.measurements().channels());
    const std::size_t column = rows.column(name);
    EXPECT_LT(column, rows.columns()) << name;
    return simulation.measurements().values()[column];
  }
};

const std::vector<std::string> kCoarse = {"scene.element_size=8 mm"};

std::vector<std::string> with(std::vector<std::string> more) {
  more.insert(more.end(), kCoarse.begin(), kCoarse.end());
  return more;
}

TEST(Measurements, ASceneThatAsksForNothingHasNone) {
  const Rolled rolled(kCoarse);
  EXPECT_TRUE(rolled.simulation.measurements().channels().empty());
  EXPECT_TRUE(rolled.simulation.measurements().phases().empty());
}

TEST(Measurements, ProbeOnTheRailSinksUnderTheWheel) {
  const Rolled rolled(with({"probe.under.x=0 m", "probe.ahead.x=0.25 m", "probe.deep.depth=30 mm"}));
  EXPECT_LT(rolled.value("under_displacement_z"), -5e-5);
  EXPECT_LT(rolled.value("under_displacement_z"), rolled.value("deep_displacement_z"));
  EXPECT_LT(rolled.value("deep_displacement_z"), 0);
  EXPECT_GT(rolled.value("ahead_displacement_z"), -5e-6);
}

/// Circles of 0.3 m across touch where both lean by the offset over the sum of their radii: the wheel beside
/// the rail's middle is pushed away from it. Its axis is across, so that the lean is spin.
TEST(Measurements, AWheelBesideTheMiddleIsPushedAsideAndSpins) {
  const double lean = 8e-3 / (0.3 + 0.3);
  for (const int side : {1, -1}) {
    SCOPED_TRACE(side);
    const Rolled rolled({"wheel.lateral_offset=" + std::to_string(8 * side) + " mm",
                         "rail.crown_radius=0.3 m", "solution_zone.start=0 mm"});
    const Sample& sample = rolled.simulation.sample();
    EXPECT_NEAR(-side * sample.lateral_force, lean * sample.vertical_force,
                0.1 * lean * sample.vertical_force);
    EXPECT_NEAR(-side * sample.spin_creepage, lean / 0.43, 0.1 * lean / 0.43);
    EXPECT_NEAR(sample.lateral_creepage, 0, 1e-6);  // the bore is held across
  }
}

TEST(Measurements, StressUnderThePatchIsCompressionNearThePressure) {
  const Rolled rolled(
      with({"probe.under.quantity=stress", "probe.rim.body=wheel", "probe.rim.quantity=stress"}));
  for (const char* probe : {"under", "rim"}) {
    const double vertical = rolled.value(std::string(probe) + "_stress_zz");
    EXPECT_LT(vertical, -0.3 * rolled.preload.max_pressure) << probe;
    EXPECT_GT(vertical, -1.2 * rolled.preload.max_pressure) << probe;
  }
}

TEST(Measurements, AxleBoxMovesWithTheWheel) {
  const Rolled rolled({"scene.element_size=8 mm", "probe.box.body=axle_box"}, 20);
  EXPECT_NEAR(rolled.value("box_velocity_x"), 300 / 3.6, 0.01);
  EXPECT_NEAR(rolled.value("box_displacement_x"), 20 * 1e-7 * 300 / 3.6, 1e-5);
  EXPECT_LT(rolled.value("box_displacement_z"), -1e-5);
}

/// The wheel is off the rail, its bore held across, and the step so short that nothing moves.
TEST(Measurements, ProbesReadALinearFieldExactly) {
  const Mat3 slope = {{{3e-4, -1e-4, 2e-4}, {4e-4, -2e-4, 1e-4}, {-3e-4, 2e-4, 5e-4}}};
  const Vec3 shift = {1e-5, 0, 3e-5};
  const auto field = [&](const Vec3& x) {
    Vec3 u = shift;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        u[i] += slope[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] * x[j];
    return u;
  };
  const Model model(samples::tyre_scene(with({"probe.p.x=33 mm", "probe.p.y=7 mm", "probe.p.depth=17 mm",
                                              "probe.p.quantity=all", "probe.box.body=axle_box"})));
  Preload preload;
  preload.displacement = samples::sample(model.mesh, field);
  preload.wheel.origin = {4e-3, -5e-3, model.contact->touching_height() + 6e-3};
  Simulation simulation(model, preload, 1e-13);
  simulation.step();
  const MeasuredRows rows(simulation.measurements().channels());
  const auto value = [&](const std::string& name) {
    return simulation.measurements().values()[rows.column(name)];
  };
  const Vec3 exact = field({33e-3, 7e-3, -17e-3});
  const Vec3 box = Vec3{4e-3, -5e-3, 6e-3} + shift;  // the journal's middle is the wheel's
  for (int i = 0; i < 3; ++i) {
    const std::string axis = std::string("_displacement_") + "xyz"[i];
    EXPECT_NEAR(value("p" + axis), exact[i], 1e-12) << axis;
    EXPECT_NEAR(value("box" + axis), box[i], 1e-10) << axis;
  }
  const auto engineering = [&](std::size_t i, std::size_t j) { return slope[i][j] + slope[j][i]; };
  const Material steel = samples::steel();
  const double pressure = steel.lame_lambda() * (slope[0][0] + slope[1][1] + slope[2][2]);
  const double g = steel.shear_modulus();
  const double xx = pressure + g * engineering(0, 0), yy = pressure + g * engineering(1, 1),
               zz = pressure + g * engineering(2, 2), yz = g * engineering(1, 2), zx = g * engineering(2, 0),
               xy = g * engineering(0, 1);
  const double von_mises =
      std::sqrt(0.5 * ((xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)) +
                3 * (yz * yz + zx * zx + xy * xy));
  const std::vector<std::pair<std::string, double>> stresses = {
      {"p_stress_xx", xx}, {"p_stress_yy", yy}, {"p_stress_zz", zz},       {"p_stress_yz", yz},
      {"p_stress_zx", zx}, {"p_stress_xy", xy}, {"p_von_mises", von_mises}};
  for (const auto& [name, stress] : stresses) EXPECT_NEAR(value(name), stress, 1e-9 * von_mises) << name;
}

TEST(Measurements, VelocitiesAreRatesOfTheDisplacements) {
  Rolled rolled(with({"probe.rail.x=20 mm", "probe.rail.y=7 mm", "probe.box.body=axle_box"}), 200);
  for (const char* probe : {"rail", "box"})
    for (const char axis : {'x', 'y', 'z'}) {
      const std::string displacement = std::string(probe) + "_displacement_" + axis;
      const std::string velocity = std::string(probe) + "_velocity_" + axis;
      const double before = rolled.value(displacement);
      rolled.simulation.step();
      const double rate = (rolled.value(displacement) - before) / rolled.simulation.dt();
      EXPECT_NEAR(rolled.value(velocity), rate, 1e-4 * std::abs(rate) + 1e-8) << velocity;
      EXPECT_EQ(std::abs(rate) > 1e-6, velocity != "box_velocity_y") << velocity;  // the bore is held across
    }
}

TEST(Measurements, FasteningsCarryTheLoad) {
  const Rolled rolled(
      with({"rail.support=fastenings", "rail.height=150 mm", "fastenings.count=3",
            "fastenings.spacing=0.15 m", "fastenings.first=0.05 m", "fastenings.pad_width=40 mm",
            "fastenings.pad_length=60 mm", "fastenings.stiffness=20 MN/m", "fastenings.damping=1 kN s/m",
            "motion.start=rigid", "output.fastening_forces=true"}));
  const std::span<const double> forces = rolled.simulation.measurements().values();
  ASSERT_EQ(forces.size(), 3);
  const double sum = std::accumulate(forces.begin(), forces.end(), 0.0);
  const double rail = 9.81 * 7790 * 0.4 * 0.08 * 0.15;  // weight [N]
  EXPECT_NEAR(sum, rolled.model.wheel_load() + rail, 1e-3 * sum);
}

TEST(Measurements, StressIsLargestBelowTheSurface) {
  const Rolled rolled({"scene.element_size=2 mm", "output.stress_depth=20 mm"});
  const std::vector<MeasuredChannel>& channels = rolled.simulation.measurements().channels();
  const std::span<const double> stress = rolled.simulation.measurements().values();
  ASSERT_GT(stress.size(), 5);
  for (std::size_t i = 1; i < channels.size(); ++i) EXPECT_GT(channels[i].at, channels[i - 1].at);
  // Hertz: about 0.6 of the largest pressure, half a semi-axis deep.
  const auto peak = std::max_element(stress.begin(), stress.end());
  const double depth = channels[static_cast<std::size_t>(peak - stress.begin())].at;
  const HertzPatch& hertz = rolled.model.hertz_patch;
  EXPECT_NEAR(*peak, 0.6 * hertz.max_pressure, 0.1 * hertz.max_pressure);
  EXPECT_GT(depth, 0.2 * hertz.semi_axis_y);
  EXPECT_LT(depth, 0.8 * hertz.semi_axis_y);
}

TEST(Measurements, AProbeOutsideItsBodyIsRefused) {
  const auto error_of = [](const std::vector<std::string>& overrides) {
    return samples::refusal<InputError>([&] {
      const Model model(samples::tyre_scene(with(overrides)));
      const Measurements measurements(model, 0);
    });
  };
  EXPECT_NE(error_of({"probe.p.depth=70 mm"}).find("probe.p: 70 mm below"), std::string::npos);
  for (const char* below : {"60.002", "60.5", "61"})
    EXPECT_EQ(
        error_of({std::string("probe.p.depth=") + below + " mm"}),
        std::string("probe.p: ") + below +
            " mm below the running surface at y = 0 mm there is no element of the body; state a depth of "
            "60 mm at most");
  EXPECT_EQ(error_of({"probe.p.depth=60 mm"}), "");
  EXPECT_EQ(error_of({"probe.p.depth=0 mm", "probe.p.y=-40 mm", "probe.w.body=wheel", "probe.w.y=17 mm",
                      "probe.w.quantity=stress"}),
            "");
  EXPECT_NE(error_of({"probe.p.y=60 mm"}).find("probe.p: y = 60 mm lies beyond"), std::string::npos);
  EXPECT_NE(error_of({"wheel.bore=guided", "wheel.overhang=20 mm", "scene.gravity=0 m/s2",
                      "probe.p.body=wheel", "probe.p.quantity=stress", "probe.p.x=1 m"})
                .find("probe.p: x = 1 m lies beyond"),
            std::string::npos);
}

TEST(ProbeKeys, AreCheckedAgainstTheScene) {
  const auto problem = [](const std::vector<std::string>& overrides) {
    return samples::refusal<InputError>([&] { samples::tyre_scene(overrides); });
  };
  EXPECT_NE(problem({"probe.p.x=0.4 m"}).find("is not on the rail"), std::string::npos);
  EXPECT_NE(problem({"probe.p.body=wheel"}).find("has stress alone"), std::string::npos);
  EXPECT_NE(problem({"probe.p.body=axle_box", "probe.p.quantity=all"}).find("has motion alone"),
            std::string::npos);
  EXPECT_NE(problem({"probe.p.body=axle_box", "probe.p.x=1 m"}).find("has an effect only with"),
            std::string::npos);
  EXPECT_NE(problem({"probe.p.dpth=1 mm"}).find("did you mean"), std::string::npos);
  EXPECT_NE(problem({"probe.a b=1"}).find("a probe's name consists of"), std::string::npos);
  EXPECT_NE(problem({"output.fastening_forces=true"}).find("[fastenings]"), std::string::npos);
}

TEST(MeasuredRows, RatesAreMeansOverTheInterval) {
  MeasuredRows rows({{{"v", "m/s", ""}}, {{"a", "m/s2", ""}, 0}});
  rows.append(std::vector<double>{1, 0}, 0);
  rows.append(std::vector<double>{3, 0}, 0.5);
  EXPECT_TRUE(std::isnan(rows.row(0)[1]));
  EXPECT_DOUBLE_EQ(rows.row(1)[1], 4);
}

TEST(MeasuredRows, FindsColumnsOfAnotherRunByName) {
  MeasuredRows there({{{"a", "m", ""}}, {{"b", "m", ""}}});
  there.append(std::vector<double>{1, 2}, 0);
  there.append(std::vector<double>{3, 4}, 0);
  const MeasuredRows here({{{"b", "m", ""}}, {{"c", "m", ""}}}, there.kept(), 2);
  EXPECT_EQ(here.row(1)[0], 4);
  EXPECT_TRUE(std::isnan(here.row(1)[1]));
}

}  // namespace
}  // namespace tread
