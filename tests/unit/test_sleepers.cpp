// Sleepers under the fastenings: as finite elements in a scene, and as rigid masses under the beam.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/engine/beam/track_beam.hpp"
#include "drivers/engine/model/attachments.hpp"
#include "drivers/engine/model/rail_foot.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/results/run_warnings.hpp"
#include "tests/program.hpp"
#include "tests/refusal.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

constexpr double kPad = 100e6;                            // [N/m]
constexpr BeamSleeper kSleeper{160, 50e6, 0};             // [kg], [N/m]
constexpr BeamProperties kRail{.bending_stiffness = 6e6,  // [N m2]
                               .shear_stiffness = 2e8,
                               .mass = 60};

/// A beam on five supports, with or without sleepers.
template <class Support>
TrackBeam supported(bool sleepers, const Support& support) {
  TrackBeam beam(kRail, 0, 3, BeamEnds::free, 0.05, sleepers);
  for (int i = 0; i < 5; ++i) support(beam, 0.3 + 0.6 * i);
  return beam;
}

TrackBeam on_sleepers() {
  return supported(true, [](TrackBeam& beam, double x) { beam.support_on_sleeper({x, kPad, 0, kSleeper}); });
}

/// Stiffness of pad, sleeper and bed at a frequency [N/m].
double dynamic_stiffness(double frequency) {
  const double omega = 2 * std::numbers::pi * frequency;
  const double below = kSleeper.stiffness - omega * omega * kSleeper.mass;
  return kPad * below / (kPad + below);
}

TEST(BeamOnSleepers, RespondsAsOnTheirDynamicStiffness) {
  for (const double frequency : {0.0, 60.0, 300.0, 1200.0}) {
    const TrackBeam condensed = supported(
        false, [&](TrackBeam& beam, double x) { beam.support(x, dynamic_stiffness(frequency), 0); });
    for (const double x : {0.9, 1.23}) {
      const double ours = on_sleepers().receptance(1.23, x, frequency).real();
      const double theirs = condensed.receptance(1.23, x, frequency).real();
      EXPECT_NEAR(ours / theirs, 1, 1e-8) << frequency << " Hz, x = " << x;
    }
  }
}

TEST(BeamOnSleepers, APadIsAsLongAsItsSpringDampers) {
  const std::vector<double> columns = {-0.12, 0, 0.07};
  BeamSleeper heavy = kSleeper;
  heavy.mass = 1e9;  // stands still
  const TrackBeam ours = supported(true, [&](TrackBeam& beam, double x) {
    beam.support_on_sleeper({x, 3 * kPad, 60e3, heavy, columns});
  });
  const TrackBeam theirs = supported(false, [&](TrackBeam& beam, double x) {
    for (const double offset : columns) beam.support(x + offset, kPad, 20e3);
  });
  for (const double frequency : {60.0, 1200.0})
    EXPECT_NEAR(
        std::abs(ours.receptance(1.23, 0.9, frequency) / theirs.receptance(1.23, 0.9, frequency) - 1.0), 0,
        1e-5)
        << frequency << " Hz";
}

TEST(BeamOnSleepers, ASleeperTakesItsShareOfTheDeflection) {
  const TrackBeam beam = on_sleepers();
  const std::vector<double> state = beam.static_state(1.5, 1e5);
  const double rail = beam.deflection(state, 1.5);
  EXPECT_NEAR(beam.sleeper(state, 1.4), rail * kPad / (kPad + kSleeper.stiffness), 1e-9);
}

std::vector<std::string> ballasted(std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"scene.element_size=8 mm", "fastenings.damping=1 kN s/m"});
  return samples::on_sleepers(more);
}

/// Static forces of the beds, along x, upwards [N].
std::vector<double> bed_forces(const Model& model, const Preload& preload) {
  const std::vector<SpringDampers::Element>& elements = model.fastenings->elements();
  const ConstNodeField u = preload.displacement.data();
  std::size_t at = elements_of_fastening(*model.scene.fastenings) * model.index.sleepers.size();
  const std::size_t beds = model.index.sleepers.size();
  const std::size_t group = (elements.size() - at) / beds;
  std::vector<double> forces(beds);
  for (double& force : forces)
    for (std::size_t k = 0; k < group; ++k, ++at) force -= elements[at].stiffness * elements[at].stretch(u);
  return forces;
}

Preload at_rest(Model& model) {
  return solve_preload(model, SteadyMotion{}, [](const std::string& /*text*/) {});
}

double mass_of(const Model& model, const std::vector<int>& blocks) {
  double mass = 0;
  for (const int b : blocks) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(b)];
    for (std::int64_t slot = block.base; slot < block.base + block.slots(); ++slot)
      mass += model.mass[static_cast<std::size_t>(slot)];
  }
  return mass;
}

TEST(Sleepers, BedsCarryWheelRailAndSleepers) {
  Model model(samples::tyre_scene(ballasted()));
  ASSERT_EQ(model.index.sleepers.size(), 3);
  EXPECT_NEAR(mass_of(model, model.index.sleepers), 3 * 2400 * 0.26 * 1.3 * 0.2, 1e-6);
  const std::vector<double> forces = bed_forces(model, at_rest(model));
  const double weight =
      model.scene.gravity * (mass_of(model, model.index.sleepers) + mass_of(model, model.index.rail()));
  EXPECT_NEAR(forces[0] + forces[1] + forces[2], model.wheel_load() + weight, 1e-3 * model.wheel_load());
  EXPECT_NEAR(forces[0], forces[2], 5e-3 * forces[1]);
  EXPECT_GT(forces[1], forces[0]);
}

TEST(Sleepers, TheirBendingNeedsNoFinerMesh) {
  const Model model(samples::tyre_scene(ballasted()));
  RunResults results;
  results.samples.resize(1);
  results.part_energy.assign(model.mesh.blocks.size(), {.strain = 3, .hourglass = 1});
  const std::vector<std::string> warnings = run_warnings(model, results);
  const auto of_energy = [](const std::string& warning) { return samples::has(warning, "hourglass"); };
  EXPECT_EQ(std::ranges::count_if(warnings, of_energy),
            std::ssize(model.mesh.blocks) - std::ssize(model.index.sleepers));
}

TEST(Sleepers, AHangingOneLeavesTheLoadToItsNeighbours) {
  Model whole(samples::tyre_scene(ballasted()));
  Model hanging(samples::tyre_scene(ballasted({"support.hanging.fastening=2", "support.hanging.bed=0"})));
  const Preload before = at_rest(whole);
  const Preload after = at_rest(hanging);
  EXPECT_GT(after.rail_deflection, 1.2 * before.rail_deflection);
  EXPECT_GT(bed_forces(hanging, after)[0], 1.2 * bed_forces(whole, before)[0]);
  EXPECT_EQ(bed_forces(hanging, after)[1], 0);
}

TEST(Supports, ABrokenOneLeavesTheRailToItsNeighbours) {
  const std::vector<std::string> broken = {"support.clip.fastening=2", "support.clip.stiffness=0",
                                           "support.clip.holds=false"};
  Model model(samples::tyre_scene(ballasted(broken)));
  Model whole(samples::tyre_scene(ballasted()));
  const Preload after = at_rest(model);
  const std::vector<double> forces = bed_forces(model, after);
  EXPECT_NEAR(forces[1], model.scene.gravity * mass_of(model, {model.index.sleepers[1]}), 1e-3 * forces[0]);
  EXPECT_GT(after.rail_deflection, 1.2 * at_rest(whole).rail_deflection);
  const auto held = [](const Model& of) {
    return held_foot_nodes(of.scene, foot_of_rail(of.scene, of.mesh, of.index)).size();
  };
  EXPECT_LT(held(model), held(whole));
}

/// A damper that the scene states stays.
TEST(Supports, ABrokenOneHasNoDamper) {
  const auto share = [](std::vector<std::string> more) {
    more.emplace_back("support.clip.fastening=2");
    return samples::tyre_scene(ballasted(more)).support(1).damping_share();
  };
  EXPECT_EQ(share({}), 1);
  EXPECT_EQ(share({"support.clip.stiffness=0"}), 0);
  EXPECT_EQ(share({"support.clip.stiffness=0", "support.clip.damping=0.5"}), 0.5);
}

TEST(Supports, AShiftedOneTakesItsSleeperAlong) {
  const Model model(
      samples::tyre_scene(ballasted({"support.moved.fastening=1", "support.moved.shift=60 mm"})));
  const double place = -0.75 + 0.15 + 0.06;
  const SweptBlock& sleeper = model.mesh.blocks[static_cast<std::size_t>(model.index.sleepers[0])];
  EXPECT_NEAR(0.5 * (sleeper.stations.front() + sleeper.stations.back()), place, 1e-12);
  // Its held nodes lie on the shifted pad.
  double left = 0;
  double right = -1;
  for (const FootNode& node :
       held_foot_nodes(model.scene, foot_of_rail(model.scene, model.mesh, model.index))) {
    const double x = node.x;
    if (x > place + 0.3) continue;
    left = std::min(left, x);
    right = std::max(right, x);
  }
  const double half = 0.5 * model.scene.fastenings->pad_length;
  EXPECT_GE(left, place - half - 1e-9);
  EXPECT_GT(right, place);
  EXPECT_LE(right, place + half + 1e-9);
}

TEST(SupportKeys, AreCheckedAgainstTheFastenings) {
  const auto problem = [](std::vector<std::string> more) {
    more.emplace_back("support.one.fastening=2");
    return samples::refusal<InputError>([&] { samples::tyre_scene(ballasted(more)); });
  };
  const auto says = [&](const std::vector<std::string>& more, const char* text) {
    samples::expect_part(problem(more), text);
  };
  EXPECT_EQ(problem({}), "");
  says({"support.far.fastening=4"}, "there is no fastening 4");
  says({"support.two.fastening=2"}, "alters fastening 2 too");
  says({"support.one.shift=0.5 m"}, "it overlaps its neighbour");
  says({"support.end.fastening=1", "support.end.shift=-0.2 m"}, "reaches beyond the rail");
  says({"support.one.stiffness=0", "support.one.bed=0"}, "nothing carries its sleeper");
  says({"support.one.bed=0", "support.a.fastening=1", "support.a.bed=0", "support.b.fastening=3",
        "support.b.stiffness=0"},
       "nothing carries the rail");
  says({"support.one.holds=false", "support.a.fastening=1", "support.a.holds=false", "support.b.fastening=3",
        "support.b.holds=false"},
       "nothing holds the rail's foot");
}

/// Name of a file with this text.
std::string support_file(const std::string& text) {
  static const samples::TemporaryFolder folder;
  const std::filesystem::path path = folder.path / "supports.txt";
  std::ofstream(path) << text;
  return path.string();
}

TEST(SupportFile, IsTheSameAsTables) {
  const std::vector<std::string> tables = {
      "support.a.fastening=1", "support.a.shift=20 mm", "support.a.stiffness=0.5", "support.a.damping=1",
      "support.b.fastening=3", "support.b.damping=2",   "support.b.holds=false",   "support.b.bed=0.25"};
  const Scene by_tables = samples::tyre_scene(ballasted(tables));
  const Scene by_file = samples::tyre_scene(ballasted(
      {"fastenings.supports=" + support_file("# measured [in May]\n"
                                             "# fastening [-], shift [mm], stiffness [-], damping [-], "
                                             "bed [-], holds [-]\n"
                                             "3; 0; 1; 2; 0.25; 0 # hangs\n1 20 0.5 1 1 1\n")}));
  EXPECT_FALSE(by_file.alike_supports());
  for (int i = -2; i < by_file.fastenings->count; ++i) {
    EXPECT_EQ(by_file.support(i), by_tables.support(i)) << i;
    EXPECT_EQ(by_file.fastening_x(i), by_tables.fastening_x(i)) << i;
  }
}

TEST(SupportFile, MayRepeatItsHeader) {
  const std::string file = support_file(
      "# fastening [-]  bed [-]\n1 0.5\n# fastening [-]  bed [-]\n# fastening [2] hangs [nearly]\n2 0.1\n");
  EXPECT_EQ(samples::tyre_scene(ballasted({"fastenings.supports=" + file})).support(1).bed, 0.1);
}

TEST(SupportFile, NamesWhatIsWrong) {
  const auto says = [](const std::string& text, const std::string& expected,
                       const std::vector<std::string>& more = {}) {
    std::vector<std::string> keys = more;
    keys.push_back("fastenings.supports=" + support_file(text));
    samples::expect_part(samples::refusal<InputError>([&] { samples::tyre_scene(ballasted(keys)); }),
                         expected);
  };
  says("1 0.5\n", ":1: the columns have no names");
  says("", "expected a row of numbers");
  says("# fastening [-]  stiffnes [-]\n1 1\n",
       "the column \"stiffnes\" is unknown; choose from: fastening, shift");
  says("# fastening [-]  bed [-]  bed [-]\n1 1 1\n", "the column bed stands twice");
  says("# fastening [-]  bed [N/m]\n1 1\n", "[N/m] is not [-]");
  says("# fastening [-]  shift [kg]\n1 1\n", "expected a length");
  says("# fastening [-]  bed [-]\n1 1\n2 1 1\n", ":3: expected 2 numbers, found 3 columns");
  says("# fastening [-]  bed [-]\n1 -1\n", ":2: bed = -1 is not a number from 0 to 1000");
  says("# fastening [-]  bed [-]\n1.5 1\n", "fastening = 1.5 is not a whole number from 1");
  says("# fastening [-]  holds [-]\n1 0.5\n", "holds = 0.5 is not a whole number from 0 to 1");
  says("# fastening [-]  shift [mm]\n2 20000\n",
       ":2: shift = 20000 mm is not a number from -10000 mm to 10000 mm");
  says(
      "# fastening [-]  bed [-]\n1 0.5\n# fastening [-]  stiffness [-]\n2 0.5\n",
      ":3: the columns are fastening [-], stiffness [-] here and fastening [-], bed [-] on line 1; leave one "
      "of the lines out");
  says("# fastening [-]  shift [mm]\n1 2\n# fastening [-]  shift [m]\n2 0.002\n",
       ":3: the columns are fastening [-], shift [m] here and");
  says("# fastening [-]  bed [-]\n1 1\n1 2\n", "fastening 1 stands twice");
  says("# fastening [-]  bed [-]\n7 1\n", "there is no fastening 7: they count 3");
  says("# fastening [-]  shift [m]\n2 0.5\n", "fastening 2: at x = ");
  says("# fastening [-]  bed [-]\n2 0\n", "alters fastening 2 too", {"support.one.fastening=2"});
  says("# fastening [-]  bed [-]\n1 0\n2 0\n3 0\n", "nothing carries the rail");
}

TEST(SleeperKeys, AreCheckedAgainstTheFastenings) {
  const auto problem = [](const std::vector<std::string>& more) {
    return samples::refusal<InputError>([&] { samples::tyre_scene(ballasted(more)); });
  };
  EXPECT_EQ(problem({}), "");
  EXPECT_NE(problem({"sleepers.width=0.7 m"}).find("neighbouring sleepers overlap"), std::string::npos);
  EXPECT_NE(problem({"sleepers.width=0.1 m"}).find("is longer than the sleeper is wide"), std::string::npos);
  EXPECT_NE(problem({"sleepers.offset=2 m"}).find("the pad does not lie on the sleeper"), std::string::npos);
}

}  // namespace
}  // namespace tread
