#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "core/math/spectrum.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/report/energy_tables.hpp"
#include "drivers/report/figure_parts.hpp"
#include "drivers/report/hammer_figures.hpp"
#include "drivers/report/measurement_figures.hpp"
#include "drivers/report/report_figures.hpp"
#include "drivers/report/surface_figures.hpp"
#include "drivers/results/force_spectrum.hpp"
#include "drivers/results/resolution.hpp"
#include "drivers/results/run_results.hpp"
#include "drivers/results/run_warnings.hpp"
#include "io/text/json.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

constexpr double kForce = 25e3;   // [N]
constexpr double kRadius = 0.43;  // [m]
constexpr double kSpeed = 80;     // [m/s]

/// Samples of a wheel that rolls 1 m and does the frictional work `creepage` times |F_L| times its way, with
/// a spin over that of rolling.
std::vector<Sample> rolling(double force, double creepage, double spin = 1) {
  std::vector<Sample> samples;
  for (int i = 0; i <= 100; ++i) {
    Sample sample;
    sample.wheel_x = 0.01 * i;
    sample.time = sample.wheel_x / kSpeed;
    sample.wheel_spin = spin * kSpeed / kRadius;
    sample.vertical_force = 80e3;
    sample.longitudinal_force = force;
    sample.energy.frictional_work = creepage * kForce * sample.wheel_x;
    samples.push_back(sample);
  }
  return samples;
}

TEST(CreepageOfWork, IsTheWorkPerWayOverTheForce) {
  EXPECT_NEAR(creepage_of_work(rolling(kForce, 0.0027), 0.2, 0.8, kRadius).value(), 0.0027, 1e-12);
  // Braking:
  EXPECT_NEAR(creepage_of_work(rolling(-kForce, 0.0027), 0.2, 0.8, kRadius).value(), -0.0027, 1e-12);
}

/// A locked wheel does the work F_L times its way; its creepage of eq. (13) is -2.
TEST(CreepageOfWork, IsThatOfTheMeanSpeedUnderLargeSlip) {
  EXPECT_NEAR(creepage_of_work(rolling(-kForce, 1, 0), 0.2, 0.8, kRadius).value(), -2, 1e-9);
  EXPECT_NEAR(creepage_of_work(rolling(kForce, 2, 3), 0.2, 0.8, kRadius).value(), 1, 1e-9);
}

TEST(CreepageOfWork, IsAbsentWithoutForceOrWay) {
  EXPECT_FALSE(creepage_of_work(rolling(0, 0), 0.2, 0.8, kRadius));
  EXPECT_FALSE(creepage_of_work(rolling(0.004 * 80e3, 0.0027), 0.2, 0.8, kRadius));  // work of spin
  EXPECT_TRUE(creepage_of_work(rolling(0.006 * 80e3, 0.0027), 0.2, 0.8, kRadius));
  EXPECT_FALSE(creepage_of_work(rolling(kForce, 0.0027), 2.0, 3.0, kRadius));
  EXPECT_FALSE(creepage_of_work({}, 0.2, 0.8, kRadius));
}

TEST(Traction, IsSteadyIfItsHalvesAgree) {
  const Scene scene = samples::tyre_scene({"motion.traction.torque=6 kN m", "motion.traction.ramp=1 ms"});
  RunResults results;
  const auto steady = [&] { return traction_is_steady(scene, results); };
  EXPECT_FALSE(steady());  // without a sample
  results.steady_samples = 1;
  results.traction_coefficient = 0.3;
  results.traction_drift = 0.0149;
  EXPECT_TRUE(steady());
  results.traction_drift = -0.0151;
  EXPECT_FALSE(steady());
  results.traction_drift = 0;
  results.steady_slip_share = 0.6;
  EXPECT_FALSE(steady()) << "the wheel spins up";
  // A wheel that rolls freely has no traction to compare with.
  results.traction_coefficient = 0.001;
  results.traction_drift = 0.0049;
  EXPECT_TRUE(steady());
  results.driven = true;
  EXPECT_FALSE(steady()) << "friction carries nothing of the torque";
  results.steady_slip_share = 0;
  results.steady_begin = 1.4e-3;
  EXPECT_FALSE(steady()) << "the torque has just risen";
  results.steady_begin = 1.6e-3;
  EXPECT_TRUE(steady());
}

TEST(Traction, IsNotSteadyUnderATorqueThatTurns) {
  const Scene scene = samples::tyre_scene(
      {"motion.traction.torque=6 kN m", "motion.traction.ramp=1 ms", "motion.traction.reversals=3"});
  RunResults results;
  results.steady_samples = 1;
  results.traction_drift = 0;
  results.driven = true;
  results.steady_begin = 7.4e-3;
  EXPECT_FALSE(traction_is_steady(scene, results));
  results.steady_begin = 7.6e-3;
  EXPECT_TRUE(traction_is_steady(scene, results));
}

/// A rigid start and a guided bore get it on a state without it.
TEST(Traction, WithoutARampIsNotSteadyOnAStateWithoutIt) {
  const Scene scene = samples::tyre_scene({"motion.traction.torque=6 kN m", "motion.traction.ramp=0 ms"});
  RunResults results;
  results.steady_samples = 1;
  results.traction_drift = 0;
  results.driven = true;
  results.steady_first = 0.05;
  results.steady_last = 0.15;
  EXPECT_FALSE(traction_is_steady(scene, results));
  results.preload.traction = 0.16;
  EXPECT_TRUE(traction_is_steady(scene, results));
  results.preload.traction = 0;
  results.steady_first = 0.11;
  EXPECT_TRUE(traction_is_steady(scene, results)) << "the wheel has rolled as far as the stretch is long";
}

constexpr double kWay = 1e-3;             ///< between samples [m]
constexpr double kApart = kWay / kSpeed;  ///< between samples [s]

/// Sample `i` of a wheel at the place `at`, counted in kWay, that brakes or drives with 16 kN and 10 J.
Sample sample_at(int i, double at) {
  Sample sample;
  sample.time = kApart * i;
  sample.wheel_x = kWay * at;
  sample.wheel_spin = kSpeed / kRadius;
  sample.vertical_force = 80e3;
  sample.longitudinal_force = 16e3;
  sample.creepage_mean = 0.002;
  sample.patch_area = 1e-4;
  sample.max_pressure = 1e9;
  sample.energy.frictional_work = 10.0 * i;
  return sample;
}

/// Model of the tyre with the solution zone from 0.1 to 0.15 m.
Model zoned_model(std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.end(),
                   {"scene.element_size=12 mm", "solution_zone.start=100 mm", "solution_zone.length=50 mm"});
  return Model(samples::tyre_scene(overrides));
}

TEST(Evaluate, FillsTheFiguresFromTheSamples) {
  const Model model = zoned_model({"motion.traction.torque=6.9 kN m"});
  RunResults r;
  r.dt = 1e-6;
  r.preload.contact.force_on_rail.z = -80e3;
  for (int i = 0; i <= 200; ++i) r.samples.push_back(sample_at(i, i));
  r.samples[20].energy.frictional_work -= 13;
  r.samples[120].vertical_force = 100e3;
  r.samples[130].vertical_force = 70e3;
  r.samples[140].creepage_mean = -0.005;
  r.samples[140].lateral_force = -51;
  r.samples[140].lateral_creepage = 0.51;
  r.samples[140].spin_creepage = 5.1;
  r.samples[180].creepage_mean = -0.01;  // beyond
  for (std::size_t i = 126; i <= 200; ++i) r.samples[i].slip_area = r.samples[i].patch_area;
  evaluate(model, r);
  EXPECT_TRUE(r.driven);
  EXPECT_NEAR(r.reached, 0.2, 1e-12);
  EXPECT_NEAR(r.evaluated_first, 0.1, 1e-12);
  EXPECT_NEAR(r.evaluated_last, 0.15, 1e-12);
  EXPECT_EQ(r.evaluated_samples, 51);
  EXPECT_EQ(r.vertical_force.min, 70e3);
  EXPECT_EQ(r.vertical_force.max, 100e3);
  EXPECT_NEAR(r.dynamic_factor(), 1.25, 1e-12);
  EXPECT_EQ(r.creepage_max, -0.005);
  EXPECT_TRUE(r.passed);
  const JsonRecord summary = parse_json(summary_json(model, {}, r), "summary");
  EXPECT_NEAR(number_in(summary, "lateral_force_N.mean").value(), -1, 1e-12);
  EXPECT_NEAR(number_in(summary, "lateral_creepage.mean").value(), 0.01, 1e-12);
  EXPECT_NEAR(number_in(summary, "spin_creepage_per_m.max").value(), 5.1, 1e-12);
  EXPECT_TRUE(number_in(summary, "creepage_percent"));
  EXPECT_NEAR(r.full_slip_share, 25.0 / 51, 1e-12);
  EXPECT_NEAR(r.spectrum.spacing, 1 / (51 * kApart), 1e-6);
  EXPECT_NEAR(r.frictional_work_decrease, 3, 1e-9);
  EXPECT_NEAR(r.steady_first, 0.05, 1e-12);
  EXPECT_NEAR(r.steady_last, 0.15, 1e-12);
  EXPECT_EQ(r.steady_samples, 101);
  EXPECT_NEAR(r.vertical_force_steady, 80e3 + 10e3 / 101, 1e-6);
  EXPECT_NEAR(r.traction_coefficient, 16e3 / (80e3 + 10e3 / 101), 1e-12);
  EXPECT_NEAR(r.creepage, 0.002 - 0.007 / 101, 1e-12);
  EXPECT_NEAR(r.creepage_of_work.value(), 1000 / (0.1 * 16e3), 1e-9);
  EXPECT_NEAR(r.steady_slip_share, 25.0 / 101, 1e-12);
  EXPECT_EQ(r.max_pressure, 1e9);
}

/// A wheel at rest dissipates nothing, and its strain energy stays; rounding leaves a residual.
TEST(Evaluate, AResidualOfAWheelAtRestCountsAgainstItsStrainEnergy) {
  const Model model = zoned_model();
  RunResults r;
  r.dt = 1e-6;
  r.samples.resize(3);
  for (Sample& sample : r.samples) sample.energy.strain = 40;
  r.samples.back().energy.residual = 4e-4;
  evaluate(model, r);
  EXPECT_NEAR(r.energy_error, 4e-4 / 0.4, 1e-12);
  r.samples.back().energy.strain = 41;
  evaluate(model, r);
  EXPECT_NEAR(r.energy_error, 4e-4, 1e-12);
}

/// The samples have F_L / F_N = 0.2; at first the torque has just turned.
TEST(Evaluate, ComparesTheTractionWithTheTorque) {
  for (const double aim : {0.192, 0.208, 0.212}) {
    const Model model = zoned_model({fmt::format("motion.traction.mu={}", -aim), "motion.traction.ramp=1 ms",
                                     "motion.traction.reversals=1"});
    RunResults r;
    r.dt = 1e-6;
    for (int i = 0; i <= 200; ++i) r.samples.push_back(sample_at(i, i));
    const auto warning = [&] {
      for (const std::string& text : run_warnings(model, r))
        if (text.find("motion.traction gives") != std::string::npos) return text;
      return std::string();
    };
    evaluate(model, r);
    EXPECT_NEAR(r.traction_target.value(), aim, 1e-12);
    const JsonRecord summary = parse_json(summary_json(model, {}, r), "summary");
    EXPECT_NEAR(number_in(summary, "traction_target").value(), aim, 1e-12);
    EXPECT_EQ(warning(), "") << "not steady";
    for (Sample& sample : r.samples) sample.time += 4e-3;
    evaluate(model, r);
    EXPECT_TRUE(traction_is_steady(model.scene, r));
    EXPECT_EQ(traction_misses(r), aim == 0.212);
    const std::string text = warning();
    EXPECT_EQ(text.empty(), aim != 0.212) << text;
    if (text.empty()) continue;
    const double off = 100 * (80e3 / model.wheel_load() - 1);
    EXPECT_NE(text.find(fmt::format("and F_N {:+.1f} %", off)), std::string::npos) << text;
    EXPECT_NE(text.find("motion.traction.ramp = \"0 ms\" starts under the steady torque"), std::string::npos)
        << text;
  }
  EXPECT_FALSE(traction_misses(RunResults()));
}

/// From 1 m/s the wheel is soon much faster: it comes to the steady stretch before the ramp ends.
TEST(Evaluate, ATorqueSettlesByTheTimeOfTheSamples) {
  const Model model =
      zoned_model({"motion.speed=1 m/s", "motion.traction.torque=6.9 kN m", "motion.traction.ramp=1 ms"});
  for (const bool settled : {false, true}) {
    RunResults r;
    r.dt = 1e-6;
    for (int i = 0; i <= 200; ++i) {
      r.samples.push_back(sample_at(i, i));
      r.samples.back().time += settled ? 1e-3 : 0;
    }
    evaluate(model, r);
    EXPECT_NEAR(r.steady_begin, 50 * kApart + (settled ? 1e-3 : 0), 1e-12);
    EXPECT_EQ(traction_is_steady(model.scene, r), settled);
  }
}

/// Brakes stop the wheel at x = 0.2 m and drive it back to -0.2 m. The samples of the way back lie between
/// those of the way ahead.
TEST(Evaluate, AWheelThatTurnsBackHasPassedTheZone) {
  const Model model = zoned_model();
  RunResults r;
  r.dt = 1e-6;
  for (int i = 0; i <= 600; ++i) {
    r.samples.push_back(sample_at(i, i <= 200 ? i - 0.5 : 400 - i));
    if (i > 200) r.samples.back().longitudinal_force = 8e3;
  }
  evaluate(model, r);
  EXPECT_NEAR(r.reached, 0.1995, 1e-12);
  EXPECT_EQ(r.evaluated_samples, 50 + 51);
  EXPECT_EQ(r.steady_samples, 100 + 101);
  EXPECT_EQ(r.vertical_force.max, 80e3);
  EXPECT_NEAR(r.creepage_of_work.value(), 1000 / (0.1 * 16e3), 1e-9);
  EXPECT_NEAR(r.spectrum.spacing, 1 / (50 * kApart), 1e-6) << "the first passage alone";
}

TEST(Evaluate, AWheelThatStandsCountsAsAWhole) {
  const Model model =
      zoned_model({"motion.speed=0 m/s", "motion.traction.torque=1 N m", "motion.traction.ramp=0 ms"});
  RunResults r;
  r.dt = 1e-6;
  for (int i = 0; i < 100; ++i) {
    r.samples.push_back(sample_at(i, 0));
    r.samples.back().wheel_x = -5e-9 * i;
  }
  evaluate(model, r);
  EXPECT_EQ(r.evaluated_samples, 100);
  EXPECT_EQ(r.steady_samples, 100);
  EXPECT_FALSE(r.spectrum.square.empty());
  EXPECT_TRUE(r.ripples.empty());
  const JsonRecord summary = parse_json(summary_json(model, {}, r), "summary");
  for (const char* path : {"creepage_percent", "creepage_max_percent"})
    EXPECT_FALSE(number_in(summary, path)) << path;
  EXPECT_FALSE(torque_has_settled(model.scene, r)) << "it acts on a state without it";
  const std::vector<std::string> warnings = run_warnings(model, r);
  const auto says = [&](const char* part) {
    return std::ranges::any_of(
        warnings, [&](const std::string& warning) { return warning.find(part) != std::string::npos; });
  };
  EXPECT_TRUE(says("the wheel stands, and its static state is without the torque: read the last samples"));
  EXPECT_FALSE(says("motion.traction.ramp = 0"));
  Scene ramped = model.scene;
  ramped.motion->ramp = 1e-4;
  EXPECT_FALSE(torque_has_settled(ramped, r));
  r.driven = false;
  EXPECT_TRUE(torque_has_settled(ramped, r));
}

/// Elements of 12 mm ripple F_N by 6 kN, and a wave of 115 mm swings it.
TEST(Evaluate, FindsTheRippleOfElements) {
  const Model model(
      samples::tyre_scene({"scene.element_size=12 mm", "solution_zone.start=50 mm",
                           "solution_zone.length=230 mm", "rail.length=600 mm", "motion.duration=3.6 ms"}));
  const std::vector<double>& stations = model.contact->nodes().grid().x;
  const auto fine = std::ranges::upper_bound(stations, 0.1);
  const double pitch = fine[1] - fine[0];
  const auto rolled = [&](double swing) {
    RunResults r;
    r.dt = 1e-6;
    for (int i = 0; i <= 290; ++i) {
      r.samples.push_back(sample_at(i, i));
      const double angle = 2 * std::numbers::pi * r.samples.back().wheel_x;
      r.samples.back().vertical_force += 3e3 * std::sin(angle / pitch) + swing * std::sin(angle / 0.115);
    }
    evaluate(model, r);
    return r;
  };
  const auto warns = [&](const RunResults& r) {
    return std::ranges::any_of(run_warnings(model, r), [](const std::string& warning) {
      return warning.starts_with("F_N ripples by 6") &&
             warning.find("comes from the mesh") != std::string::npos;
    });
  };
  const RunResults smooth = rolled(0);
  ASSERT_EQ(smooth.ripples.size(), 1U) << "17 waves of the longer elements before are not there";
  EXPECT_NEAR(smooth.ripples[0].length, pitch, 1e-9);
  EXPECT_NEAR(smooth.ripples[0].frequency, kSpeed / pitch, 1e-6);
  EXPECT_NEAR(smooth.ripples[0].amplitude, 3e3, 30);
  EXPECT_TRUE(warns(smooth));
  EXPECT_FALSE(warns(rolled(20e3)));
  EXPECT_EQ(spectrum_figure(smooth).positions.size(), 1U);
  const std::string summary = summary_json(model, {}, smooth);
  EXPECT_EQ(number_in(parse_json(summary, "summary"), "vertical_force_of_elements.0.amplitude_N"),
            smooth.ripples[0].amplitude);
  EXPECT_NE(summary.find("\"of_elements\": true"), std::string::npos);
  EXPECT_NE(summary.find("Hz hold fewer than 17 waves in the evaluated stretch of 0.23 m"),
            std::string::npos);
}

TEST(Evaluate, AHalfWithoutSamplesHasNoDrift) {
  const Model model = zoned_model();
  RunResults r;
  r.dt = 1e-6;
  for (const int i : {0, 60, 70, 200}) r.samples.push_back(sample_at(i, i));
  evaluate(model, r);
  EXPECT_EQ(r.steady_samples, 2);
  EXPECT_FALSE(r.traction_drift);
  EXPECT_FALSE(traction_is_steady(model.scene, r));
  EXPECT_NE(summary_json(model, {}, r).find("\"traction_drift\": null"), std::string::npos);
  const auto names = [&] {
    return std::ranges::any_of(run_warnings(model, r), [](const std::string& warning) {
      return warning.find("holds no sample: traction_drift is null") != std::string::npos &&
             warning.find("output.history_interval") != std::string::npos;
    });
  };
  EXPECT_TRUE(names());
  r.samples.insert(r.samples.begin() + 3, sample_at(120, 120));
  evaluate(model, r);
  EXPECT_TRUE(r.traction_drift);
  EXPECT_FALSE(names());
}

TEST(Steps, TooManyToCountAreRefused) {
  Scene scene;
  scene.motion.emplace();
  scene.motion->duration = 0.5;
  scene.output.history_interval = 0.25;
  EXPECT_EQ(step_count(scene, 0.125), 4);
  EXPECT_EQ(sampling_interval(scene, 0.125), 2);
  constexpr double kTiny = 1e-27;
  EXPECT_THROW(step_count(scene, kTiny), InputError);
  EXPECT_THROW(sampling_interval(scene, kTiny), InputError);
}

/// The patch of a slice in plane strain is that of its load per width, however narrow it is.
TEST(Warnings, ASliceHasThePatchOfItsLoadPerWidth) {
  const auto warnings = [](int width, int rail_width) {
    Scene scene = samples::tyre_scene({"scene.element_size=6 mm", "scene.gravity=0 m/s2",
                                       "wheel.width=" + std::to_string(width) + " mm",
                                       "rail.width=" + std::to_string(rail_width) + " mm",
                                       "load.wheel_load=" + std::to_string(3 * width) + " kN"});
    scene.plane_strain = true;
    scene.wheel->profile = "cylinder";
    return resolution_warnings(Model(scene));
  };
  const std::vector<std::string> narrow = warnings(6, 6);
  ASSERT_FALSE(narrow.empty());
  EXPECT_NE(narrow.front().find("1.3 elements across (7.62 mm of Hertz"), std::string::npos)
      << narrow.front();
  EXPECT_NE(narrow.front().find("; below 2.5, F_N ripples as elements pass, every 6 mm and every 12 mm "
                                "beside the solution zone; "),
            std::string::npos)
      << narrow.front();
  EXPECT_EQ(narrow, warnings(60, 60));
  EXPECT_EQ(narrow, warnings(30, 60));  // only the width over which both face each other carries
}

TEST(Warnings, ARailThatSinks) {
  const Model model(samples::tyre_scene({"scene.element_size=12 mm"}));
  RunResults results;
  const std::size_t before = run_warnings(model, results).size();
  results.preload.rail_deflection = 0.006;
  EXPECT_EQ(run_warnings(model, results).size(), before);
  results.preload.rail_deflection = 0.7;
  const std::vector<std::string> warnings = run_warnings(model, results);
  ASSERT_EQ(warnings.size(), before + 1);
  EXPECT_EQ(warnings.back(),
            "the rail sinks by 700 mm under the wheel: above 20 mm its supports are doubted; a larger "
            "fastenings.stiffness holds it");
}

TEST(Warnings, AGuidedWheelWhoseTorqueFrictionDoesNotCarry) {
  const Model model(samples::tyre_scene(
      {"scene.element_size=12 mm", "wheel.bore=guided", "motion.traction.torque=30 kN m"}));
  RunResults results;
  results.samples.resize(1);
  results.steady_samples = 1;
  results.steady_slip_share = 1;
  results.traction_coefficient = 0.5;
  const std::vector<std::string> warnings = run_warnings(model, results);
  EXPECT_TRUE(std::ranges::any_of(warnings, [](const std::string& warning) {
    return warning.find("friction does not carry the torque") != std::string::npos;
  }));
}

/// The corrugation bounds the steady stretch, or the zone, or the end of the run.
TEST(Warnings, ATractionThatIsNotSteadyNamesTheKeyThatHelps) {
  const std::vector<std::string> driven = {"scene.element_size=12 mm", "motion.traction.torque=6 kN m",
                                           "motion.traction.ramp=1 ms"};
  std::vector<std::string> corrugated = driven;
  corrugated.insert(corrugated.end(), {"corrugation.start=50 mm", "corrugation.length=50 mm",
                                       "corrugation.wavelength=50 mm", "corrugation.depth=0.01 mm"});
  const Model smooth(samples::tyre_scene(driven));
  const Model rough(samples::tyre_scene(corrugated), 0.0);
  RunResults r;
  r.samples = {sample_at(0, 0), sample_at(121, 125), sample_at(200, 200)};
  r.steady_samples = 1;
  r.driven = true;
  r.traction_coefficient = 0.2;
  r.traction_drift = 0.02;
  r.steady_last = 0.25;
  const auto says = [&](const Model& model, const std::string& part) {
    return std::ranges::any_of(run_warnings(model, r), [&](const std::string& warning) {
      return warning.find(part) != std::string::npos;
    });
  };
  for (const auto& [first, text] :
       {std::pair(1.4e-3,
                  "it counts as settled from 1.5 ms on, x = 0.125 m: a smaller motion.traction.ramp or "),
        std::pair(1.6e-3, "not steady there; a smaller motion.traction.ramp or ")}) {
    r.steady_begin = first;
    r.reached = 0.3;
    EXPECT_TRUE(says(smooth, std::string(text) + "a later solution_zone.start gives")) << first;
    EXPECT_TRUE(says(rough, std::string(text) + "a later corrugation.start gives")) << first;
    r.reached = 0.25;
    EXPECT_TRUE(says(rough, std::string(text) + "a longer motion.duration gives")) << first;
  }
}

/// The torque counts as settled at x = 0.125 m; a weld lies from 0.09 to 0.11 m.
TEST(Warnings, ATractionThatIsNotSteadyNamesWhatLiesNear) {
  const std::vector<std::string> driven = {"scene.element_size=12 mm", "motion.traction.torque=6 kN m"};
  const auto warning = [&](std::vector<std::string> more, double first, double traction = 0) {
    more.insert(more.end(), driven.begin(), driven.end());
    const Model model(samples::tyre_scene(more));
    RunResults r;
    r.samples = {sample_at(0, 0), sample_at(121, 125), sample_at(300, 300)};
    r.steady_samples = 1;
    r.driven = true;
    r.preload.traction = traction;
    r.traction_coefficient = 0.2;
    r.traction_drift = 0.02;
    r.steady_begin = 1.6e-3;
    r.steady_first = first;
    r.steady_last = first + 0.1;
    r.reached = 1;
    for (const std::string& text : run_warnings(model, r))
      if (const auto found = text.find("creepage are not steady there; "); found != std::string::npos)
        return text.substr(found + 31);
    return std::string();
  };
  const std::vector<std::string> ramp = {"motion.traction.ramp=1 ms"};
  std::vector<std::string> weld = {"surface.weld.kind=dip", "surface.weld.at=100 mm",
                                   "surface.weld.length=20 mm", "surface.weld.depth=0.1 mm"};
  const std::string later = "a later solution_zone.start gives it the way";
  EXPECT_EQ(warning(ramp, 0.15), "a smaller motion.traction.ramp or " + later);
  EXPECT_EQ(warning(ramp, 0.3), later);
  EXPECT_EQ(warning({"motion.traction.ramp=0 ms"}, 0.05, 0.2), later);
  weld.push_back(ramp.front());
  const std::string meets = "the wheel meets surface.weld there or shortly before, and the forces follow: ";
  EXPECT_EQ(warning(weld, 0.15), meets +
                                     "a run without it shows the traction alone; "
                                     "a smaller motion.traction.ramp or " +
                                     later);
  weld.back() = "motion.traction.ramp=0 ms";
  EXPECT_EQ(warning(weld, 0.15, 0.2), meets + "a run without it shows the traction alone");
  EXPECT_EQ(warning(weld, 0.4, 0.2), later);
}

TEST(Warnings, AStaticStateThatYieldsInTheFirstStep) {
  const Model model(samples::tyre_scene(
      {"scene.element_size=12 mm", "material.steel.law=j2", "material.steel.yield_stress=50 MPa"}));
  RunResults r;
  r.samples.resize(1);
  r.preload.contact.force_on_rail.z = -88e3;
  const auto warns = [&](double force) {
    r.samples.front().vertical_force = force;
    return std::ranges::any_of(run_warnings(model, r), [](const std::string& warning) {
      return warning.find("yields in the first step") != std::string::npos;
    });
  };
  EXPECT_FALSE(warns(64e3)) << "nothing has yielded";
  r.samples.front().energy.plastic_work = 1;
  EXPECT_TRUE(warns(64e3));
  EXPECT_FALSE(warns(82e3));
  r.origin.emplace();
  EXPECT_FALSE(warns(64e3)) << "the first sample of a fork is that of a dynamic state";
}

/// The 20 mm to the rail's end that the scene's check asks for are too few for a large wheel.
TEST(Warnings, AWayThatIsTooShortKeepsRoomForTheSearch) {
  const Model model(
      samples::tyre_scene({"scene.element_size=12 mm", "wheel.diameter=1.2 m", "motion.duration=1 ms",
                           "solution_zone.start=239 mm", "solution_zone.length=40 mm"}));
  const std::vector<std::string> warnings = resolution_warnings(model);
  EXPECT_TRUE(std::ranges::any_of(warnings, [](const std::string& warning) {
    return warning.find("passes it, with rail.length = \"0.6 m\"") != std::string::npos;
  }));
}

/// A torque brakes or drives the ring by half at the least, the rest spins it.
TEST(Warnings, AWayUnderATorqueIsTheSureOne) {
  const auto has = [](const std::vector<std::string>& overrides, const char* part) {
    std::vector<std::string> all = {"scene.element_size=12 mm", "motion.speed=10 m/s",
                                    "motion.traction.ramp=0.1 ms"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    const std::vector<std::string> warnings = resolution_warnings(Model(samples::tyre_scene(all)));
    return std::ranges::any_of(
        warnings, [&](const std::string& warning) { return warning.find(part) != std::string::npos; });
  };
  EXPECT_TRUE(has({"motion.traction.torque=-15 kN m", "motion.duration=20 ms", "solution_zone.start=120 mm"},
                  "m and may not reach the solution zone, x = 0.12 to 0.17 m, so that the run's values are "
                  "those of the way from the start; motion.traction may stop it or turn it back before"));
  EXPECT_TRUE(has({"motion.traction.torque=15 kN m", "motion.duration=1 ms", "solution_zone.start=220 mm"},
                  "motion.duration = \"21.38 ms\" passes it, with rail.length = \"0.6 m\""));
}

TEST(Warnings, EnergiesThatDoNotBalance) {
  const Model model(samples::tyre_scene({"scene.element_size=12 mm"}));
  RunResults results;
  results.samples.resize(1);
  const std::size_t before = run_warnings(model, results).size();
  results.energy_error = 0.019;
  EXPECT_EQ(run_warnings(model, results).size(), before);
  results.energy_error = 0.021;
  EXPECT_EQ(run_warnings(model, results).size(), before + 1);
}

TEST(Warnings, SamplesWhoseIntervalChanges) {
  std::vector<Sample> samples(200);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].time = 1e-5 * (i < 100 ? 2.0 * static_cast<double>(i) : 100.0 + static_cast<double>(i));
    samples[i].wheel_x = 50 * samples[i].time;
    samples[i].vertical_force = i % 3 == 0 ? 1 : 0;
  }
  constexpr double kStep = 1e-6;
  EXPECT_FALSE(sample_intervals(samples, 0, 1).even(kStep));
  EXPECT_TRUE(sample_intervals(samples, 0, 0.08).even(kStep));
  EXPECT_TRUE(force_spectrum(samples, 0, 1, kStep).square.empty());
  EXPECT_FALSE(force_spectrum(samples, 0, 0.08, kStep).square.empty());
  samples.resize(100);
  EXPECT_TRUE(sample_intervals(samples, 0, 1).even(kStep));
  samples.back().time += 1e-5;
  EXPECT_FALSE(sample_intervals(samples, 0, 1).even(kStep)) << "the last counts like the others";
}

/// The wheel had left the evaluated stretch when its stress under the patch was first asked for.
TEST(Measured, ValuesThatNoSampleHasAreNone) {
  const Model model = zoned_model();
  RunResults r;
  r.dt = 1e-6;
  const std::string name = "von_mises_below_01";
  r.measured =
      MeasuredRows({{.channel = {name, "Pa", "stress"}, .at = 0.01}}, {{name}, {NAN, NAN, NAN, 5e6}}, 4);
  r.samples = {sample_at(0, 110), sample_at(1, 120), sample_at(2, 130), sample_at(3, 160)};
  evaluate(model, r);
  EXPECT_EQ(r.evaluated_samples, 3);
  EXPECT_TRUE(std::isnan(measured_statistics(model, r, 0).mean));
  const JsonRecord summary = parse_json(summary_json(model, {}, r), "summary");
  EXPECT_EQ(text_in(summary, "measured." + name + ".unit"), "Pa");
  for (const char* value : {".mean", ".min", ".max"})
    EXPECT_FALSE(number_in(summary, "measured." + name + value)) << value;
  r.samples.back().wheel_x = 0.14;
  EXPECT_EQ(measured_statistics(model, r, 0).min, 5e6);
}

/// Each energy has a size of its own.
EnergyLedger ledger_of(double size) {
  EnergyLedger energy;
  for (const EnergyKind& kind : kEnergyKinds) {
    size *= 2;
    energy.*kind.member = size;
  }
  return energy;
}

TEST(Energies, AddUpToTheTotal) {
  const EnergyLedger e = ledger_of(1.1);
  const double stored = e.kinetic + e.strain + e.connectors + e.penalty + e.gravity;
  const double lost =
      e.frictional_work + e.connector_loss + e.contact_loss + e.material_loss + e.plastic_work;
  EXPECT_NEAR(e.total(), stored + lost - e.torque_work - e.guide_work - e.hammer_work, 1e-9);
}

TEST(Energies, CurvesAddUpToTheResidual) {
  const Model model = zoned_model({"motion.traction.torque=6.9 kN m"});
  RunResults r;
  for (const int i : {0, 1}) {
    r.samples.push_back(sample_at(i, i));
    r.samples.back().energy = ledger_of(1 + i);
  }
  r.samples[1].energy.plastic_work = r.samples[0].energy.plastic_work;
  r.samples[1].energy.residual = r.samples[1].energy.total() - r.samples[0].energy.total();
  const Figure figure = energy_figure(model, r);
  double sum = 0;
  std::size_t curves = 0;
  for (std::size_t i = 0; i + 1 < figure.panels.size(); ++i)
    for (const Series& series : figure.panels[i].series) {
      EXPECT_NE(series.label, "plastic work") << "it does not change";
      sum += series.label.starts_with("work of the ") ? -series.y.back() : series.y.back();
      ++curves;
    }
  EXPECT_EQ(curves, kEnergyKinds.size() - 1);
  EXPECT_NEAR(sum, figure.panels.back().series.front().y.back(), 1e-9);
}

TEST(Energies, OfAllPartsHaveColumns) {
  const Model model = zoned_model();
  const std::vector<Channel> channels = history_channels(model);
  const std::vector<double> row = history_row(model, {.energy = ledger_of(1)});
  ASSERT_EQ(row.size(), channels.size());
  for (const EnergyKind& kind : kEnergyKinds) {
    const auto channel =
        std::ranges::find_if(channels, [&](const Channel& c) { return c.name == kind.name; });
    const bool part = kind.part == EnergyPart::bodies || kind.part == EnergyPart::contact;
    ASSERT_EQ(channel != channels.end(), part) << kind.name;
    if (!part) continue;
    EXPECT_EQ(row[static_cast<std::size_t>(channel - channels.begin())], ledger_of(1).*kind.member);
  }
}

/// A sine of 3 kN on a line has that amplitude, and 15 % less in the middle between two; its mean square
/// stays.
TEST(SpectrumFigure, ShowsTheAmplitudeOfASine) {
  constexpr double kInterval = 1e-4;  // [s]
  constexpr int kCount = 1000;        // 10 Hz between two lines
  const auto largest = [](double frequency) {
    std::vector<Sample> samples(kCount);
    for (int i = 0; i < kCount; ++i) {
      Sample& sample = samples[static_cast<std::size_t>(i)];
      sample.time = kInterval * i;
      sample.wheel_x = 50 * sample.time;
      sample.vertical_force = 80e3 + 3e3 * std::sin(2 * std::numbers::pi * frequency * sample.time);
    }
    RunResults results;
    results.spectrum = force_spectrum(samples, -1, 10, kInterval);
    EXPECT_NEAR(band_power(results.spectrum.square, results.spectrum.spacing, 500, 1500), 4.5e6, 0.02e6);
    EXPECT_NEAR(results.spectrum.sine_of_wave(50 / frequency).value().amplitude, 3e3, 30);
    EXPECT_FALSE(results.spectrum.sine_of_wave(50 / 35.0)) << "3.5 waves";
    const std::vector<double> shown = spectrum_figure(results).panels.front().series.front().y;
    return *std::max_element(shown.begin(), shown.end());
  };
  EXPECT_NEAR(largest(1000), 3, 0.01);
  EXPECT_NEAR(largest(1005), 0.85 * 3, 0.02);
}

TEST(ForceFigure, NamesTheCoefficientOfFriction) {
  const Model model(samples::tyre_scene({"scene.element_size=12 mm", "contact.friction=0.299"}));
  RunResults results;
  results.samples = rolling(kForce, 0.0027);
  const std::string caption = force_figure(model, results).caption;
  EXPECT_NE(caption.find("f = 0.299."), std::string::npos) << caption;
}

TEST(ForceFigure, BrakesHaveTheirLimitBelow) {
  const Model model(samples::tyre_scene({"scene.element_size=12 mm", "contact.friction=0.299"}));
  RunResults r;
  r.samples = rolling(-kForce, 0.0027);
  r.longitudinal_force.mean = -kForce;
  const Figure forces = force_figure(model, r);
  const Panel& panel = forces.panels.front();
  EXPECT_EQ(panel.series.front().label, "−f F_N");
  EXPECT_NEAR(panel.series.front().y.front(), -0.299 * 80, 1e-9);
  EXPECT_EQ(panel.levels.front().label, "static −f F_N");
  EXPECT_LT(panel.levels.front().at, 0);
  EXPECT_NE(forces.caption.find("meets −f F_N the whole patch slides. f = 0.299."), std::string::npos)
      << forces.caption;
  EXPECT_EQ(passage_figure(model, r).panels[1].levels.front().at, -0.299);
  r.longitudinal_force.mean = -100;  // rolls freely
  EXPECT_EQ(force_figure(model, r).panels.front().series.front().label, "f F_N");
  EXPECT_EQ(passage_figure(model, r).panels[1].levels.front().label, "f");
}

TEST(ForceFigure, ShowsTheSurfaceThatThePatchMeets) {
  const Model model(
      samples::tyre_scene({"scene.element_size=12 mm", "surface.hole.kind=dent", "surface.hole.at=75 mm",
                           "surface.hole.centre=15 mm", "surface.hole.depth=1 mm",
                           "surface.hole.length=20 mm", "surface.hole.width=10 mm"}));
  RunResults results;
  results.samples = rolling(kForce, 0.0027);
  results.preload.contact.centre.y = 0.015;
  const Figure figure = force_figure(model, results);
  ASSERT_EQ(figure.panels.size(), 2U);
  const std::vector<double>& height = figure.panels.back().series.front().y;
  EXPECT_NEAR(*std::min_element(height.begin(), height.end()), -1, 0.01);  // [mm]
}

TEST(SurfaceFigure, ShowsADipOfASmoothRail) {
  const Model model(
      samples::tyre_scene({"scene.element_size=12 mm", "surface.weld.kind=dip", "surface.weld.at=75 mm",
                           "surface.weld.depth=1 mm", "surface.weld.length=40 mm"}));
  RunResults results;
  for (const double x : {0.05, 0.1}) results.surface.axis.push_back({.x = x});
  const Figure figure = surface_figure(model, results);
  ASSERT_EQ(figure.panels.size(), 3U);
  const std::vector<double>& height = figure.panels.back().series.front().y;
  EXPECT_NEAR(*std::min_element(height.begin(), height.end()), -1, 0.01);  // [mm]
}

TEST(FigureParts, FasteningsAreMarkedWhereTheyStand) {
  Scene scene;
  scene.rail.emplace();
  scene.fastenings.emplace();
  scene.supports["moved"] = {.fastening = 2, .shift = 0.1};
  Figure figure;
  mark_track(scene, Corrugation(), {-10, 30}, figure);
  ASSERT_EQ(std::ssize(figure.positions), scene.fastenings->count);
  EXPECT_NEAR(figure.positions[1].at - figure.positions[0].at, scene.fastenings->spacing + 0.1, 1e-12);
  EXPECT_NEAR(figure.positions[2].at - figure.positions[1].at, scene.fastenings->spacing - 0.1, 1e-12);
}

TEST(FigureParts, AWheelThatTurnsBackIsShownOnItsWholeWay) {
  const Model model = zoned_model();
  RunResults r;
  r.samples = {sample_at(0, 0), sample_at(200, 200), sample_at(450, -50)};
  const Range way = whole_way(model, r);
  EXPECT_NEAR(way[0], -0.05, 1e-12);
  EXPECT_NEAR(way[1], 0.2, 1e-12);
  const Range seen = stretch_in_sight(model, way);
  EXPECT_NEAR(seen[0], 0.1, 1e-12);
  EXPECT_NEAR(seen[1], 0.15, 1e-12);
  EXPECT_EQ(stretch_in_sight(model, {0.2, 0.3}), (Range{0.2, 0.3}));
}

TEST(HammerChapter, ShowsNoReceptanceUnderAWheelThatRolls) {
  RunResults r;
  r.samples = {sample_at(0, 0), sample_at(8, 1)};
  const auto figures = [&](const char* speed) {
    const Model model = zoned_model({"hammer.force=1 kN", "hammer.duration=0.2 ms", speed});
    return hammer_chapter(model, r).blocks.size();
  };
  EXPECT_EQ(figures("motion.speed=0 m/s"), 2U);
  EXPECT_EQ(figures("motion.speed=80 m/s"), 1U);
}

TEST(FigureParts, AWheelThatStandsIsShownOverTime) {
  RunResults r;
  r.samples = {sample_at(0, 0), sample_at(8, 1)};
  const Model standing = zoned_model({"motion.speed=0 m/s"});
  const Figure over_time = patch_figure(standing, r);
  EXPECT_EQ(over_time.x_label, "Time [ms]");
  EXPECT_NEAR(over_time.panels.front().series.front().x.back(), 8e3 * kApart, 1e-12);
  EXPECT_NEAR((*over_time.x_range)[1], 8e3 * kApart, 1e-12);
  const PatchMovie at_rest = patch_movie(standing, r);
  EXPECT_FALSE(at_rest.rolls);
  EXPECT_EQ(at_rest.title, "The patch at rest");
  EXPECT_EQ(at_rest.caption.find("rolling"), std::string::npos) << at_rest.caption;
  const Model rolls = zoned_model();
  const Figure over_the_way = patch_figure(rolls, r);
  EXPECT_EQ(over_the_way.x_label, "Position of the wheel [m]");
  EXPECT_NEAR(over_the_way.panels.front().series.front().x.back(), kWay, 1e-12);
  EXPECT_TRUE(patch_movie(rolls, r).rolls);
}

TEST(CreepageFigure, AGuidedBoreShowsItsCarrier) {
  RunResults r;
  r.samples = {sample_at(0, 0), sample_at(1, 1)};
  const auto shown = [&](const char* bore) {
    return creepage_figure(zoned_model({std::string("wheel.bore=") + bore}), r, {});
  };
  const Figure guided = shown("guided");
  EXPECT_EQ(guided.panels.front().series[1].label, "of the bore's carrier");
  ASSERT_EQ(guided.panels.size(), 3U);
  EXPECT_EQ(guided.panels[1].y_label, "Lateral [%]");
  EXPECT_NE(guided.caption.find("the carrier is rigid."), std::string::npos) << guided.caption;
  EXPECT_EQ(shown("free").panels.front().series[1].label, "mean of 28 nodes around the tread");
}

TEST(FasteningForces, AreThoseAboutTheBlow) {
  const Model model(
      read_scene(std::string(TREAD_SOURCE_DIR) + "/scenes/hammer.toml",
                 {"scene.element_size=11 mm", "rail.length=2.6 m", "rail.origin=0.65 m", "fastenings.count=4",
                  "hammer.position=1.3 m", "output.fastening_forces=true"}));
  std::vector<MeasuredChannel> channels;
  MeasuredRows::Kept kept;
  for (int i = 0; i < 4; ++i) {
    kept.names.push_back("fastening_0" + std::to_string(i + 1) + "_force");
    kept.values.push_back(1e3 * i);
    channels.push_back({.channel = {kept.names.back(), "N", "force"}, .at = model.scene.fastening_x(i)});
  }
  RunResults r;
  r.samples.resize(1);
  r.measured = MeasuredRows(channels, kept, 1);
  const Chapter chapter = measurement_chapter(model, r);
  ASSERT_EQ(chapter.blocks.size(), 1U);
  const std::vector<Series>& shown = std::get<Figure>(chapter.blocks.front()).panels.front().series;
  ASSERT_EQ(shown.size(), 2U);
  EXPECT_EQ(shown[0].label, "x = 0.975 m");
  EXPECT_DOUBLE_EQ(shown[1].y.front(), 3);
}

TEST(MeshDrawings, NameTheBodiesThatTheyShow) {
  const auto labels = [](const Drawing& drawing) {
    std::vector<std::string> names;
    for (const Layer& layer : drawing.layers) names.push_back(layer.label);
    return names;
  };
  Model model = zoned_model();
  EXPECT_EQ(labels(section_drawings(model).drawings.front()), (std::vector<std::string>{"rail", "tyre"}));
  const Drawing track = side_drawings(model).drawings.back();
  EXPECT_EQ(labels(track), std::vector<std::string>{"rail"});
  EXPECT_EQ(section_drawings(model).drawings.front().title, "Cross-section under the wheel");
  EXPECT_NEAR(track.window->low[0] + 0.2, zone_span(model.scene).first, 1e-12);
  model.scene.motion.reset();
  EXPECT_NEAR(side_drawings(model).drawings.back().window->low[0] + 0.2, zone_span(model.scene).first, 1e-12);
  model.index.base_body = 0;
  model.mesh.bodies.resize(1);
  const Drawing bodiless = section_drawings(model).drawings.front();
  EXPECT_EQ(labels(bodiless), (std::vector<std::string>{"rail head", "tyre"}));
  EXPECT_EQ(bodiless.title, "Cross-section under the wheel, without bodies from files");
}

TEST(PatchMovie, StatesTheMeanCreepage) {
  const Model model(samples::tyre_scene({"scene.element_size=12 mm"}));
  RunResults results;
  results.samples.resize(1);
  results.samples.front().creepage_node = 0.5;
  results.samples.front().creepage_mean = 0.0025;
  const std::size_t nodes = model.contact->nodes().grid().y.size();  // of one station
  PatchSample sample;
  sample.fields.resize(patch_fields().size() * nodes);
  sample.state.resize(nodes);
  results.movie = {sample};
  const std::string note = patch_movie(model, results).frames.front().note;
  EXPECT_NE(note.find("creepage 0.250 %"), std::string::npos) << note;
}

TEST(EnergyError, NamesTheLossesOfTheScene) {
  const auto text = [](const Scene& scene) { return energy_error_text(Model(scene), RunResults()); };
  const std::vector<std::string> coarse = {"scene.element_size=12 mm"};
  const auto names = [](const std::string& sentence, const char* loss) {
    return sentence.find(loss) != std::string::npos;
  };
  const std::string elastic = text(samples::tyre_scene(coarse));
  EXPECT_FALSE(names(elastic, "losses in materials") || names(elastic, "plastic work")) << elastic;
  const std::string damped = text(samples::tyre_with_maxwell_branches(coarse));
  EXPECT_TRUE(names(damped, "losses in dampers, losses in materials and range")) << damped;
  const std::string yielding = text(samples::tyre_scene(
      {"scene.element_size=12 mm", "material.steel.law=j2", "material.steel.yield_stress=500 MPa"}));
  EXPECT_TRUE(names(yielding, "losses in dampers, plastic work and range")) << yielding;
}

TEST(Warnings, NameTheDampingWhoseLossNoEnergyCounts) {
  const auto loss = [](std::initializer_list<const char*> settings) {
    std::vector<std::string> all = {"scene.element_size=12 mm"};
    all.insert(all.end(), settings.begin(), settings.end());
    return uncounted_loss(Model(samples::tyre_scene(all)));
  };
  EXPECT_EQ(loss({}), "");
  EXPECT_EQ(loss({"material.steel.damping={ kind = \"high_frequency_fraction\", value = 0.1 }"}),
            "; the loss of material.steel.damping, which no energy counts, is part of the miss");
  EXPECT_EQ(loss({"material.steel.damping={ kind = \"rayleigh_beta\", value = \"1e-5 s\" }",
                  "material.steel.damping_up_to=10 kHz"}),
            "");
}

}  // namespace
}  // namespace tread
