// Steps on an emulated device are those of the processor, whatever the order of teams and threads. The host's
// copies of what moves on the device are NaN: whoever reads them without fetching them is found out.

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/engine/device/device_movers.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/run/rolling.hpp"
#include "drivers/run/run_model.hpp"
#include "drivers/run/run_scene.hpp"
#include "drivers/run/run_session.hpp"
#include "io/report/plain_text.hpp"
#include "kernels/device/contact_layout.hpp"
#include "tests/device_cases.hpp"
#include "tests/program_test.hpp"
#include "tests/refusal.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

using namespace samples;
using Case = PreloadedScene;

/// Teams of few quads and tiles, some of them smaller than the others. `shared`: of each of the 3 to 7 teams
/// of a patch [B].
std::shared_ptr<Device> device(std::uint64_t order, MarchCut cut = {64, 7, 2},
                               std::size_t shared = 200 << 10) {
  const int teams = 3 + static_cast<int>(order % 5);
  return emulated_device(
      {.cut = cut, .order = order, .spoils_copies = true, .teams = teams, .shared = shared});
}

/// Rolls to `steps`. Returns the vertical contact force at every tenth [N].
std::vector<double> forces_of(Simulation& simulation, std::int64_t steps) {
  std::vector<double> forces;
  simulation.set_sampling_interval(10);
  while (simulation.steps() < steps) {
    simulation.step();
    if (simulation.sampled()) forces.push_back(simulation.sample().vertical_force);
  }
  return forces;
}

std::vector<double> measured(const Simulation& simulation) {
  const std::span<const double> values = simulation.measurements().values();
  return {values.begin(), values.end()};
}

/// Runs of `scene` in double on the processor and in these precisions on devices.
template <class SceneOf>
void expect_same_steps(const SceneOf& scene, std::int64_t steps,
                       const std::vector<std::string>& precisions = {"double"}) {
  Case exact(scene("double"));
  const auto in_double = roll(exact.start(nullptr), steps);
  Case at(scene("double"));
  for (const std::string& precision : precisions) {
    SCOPED_TRACE(precision);
    at.set_precision(precision);
    const auto on_device = roll(at.start(device(0)), steps);
    const StateBytes state = bytes(on_device->state());
    expect_same_fields(*in_double, at, *on_device, precision);
    for (const double value : history_row(at.model(), on_device->sample())) EXPECT_TRUE(std::isfinite(value));

    set_threads(3);
    constexpr std::size_t kFew = 6400;  // less than a patch needs
    const auto shuffled = roll(at.start(device(12345, {64, 7, 5}, kFew)), steps);
    set_threads(1);
    EXPECT_EQ(history_row(at.model(), on_device->sample()), history_row(at.model(), shuffled->sample()));
    EXPECT_EQ(measured(*on_device), measured(*shuffled));
    EXPECT_EQ(differences(state, bytes(shuffled->state())), "");
    if (precision != "double") continue;
    const auto cut_otherwise = roll(at.start(device(8, {64, 40, 5})), steps);
    EXPECT_EQ(differences(state, bytes(cut_otherwise->state())), "");
  }
}

TEST(FieldDifferences, FindAValueThatIsNotFinite) {
  const std::vector<double> whole = {1, 2, 3, 0};
  std::vector<double> broken = whole;
  broken[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isinf(samples::difference(whole, broken)));
  EXPECT_TRUE(std::isinf(samples::difference(4, whole.data(), broken.data())));
  EXPECT_TRUE(std::isinf(samples::relative_difference(broken, whole)));
  EXPECT_NONFATAL_FAILURE(samples::largest(broken), "not finite");
}

TEST(Device, ThousandStepsOfTractionOverCorrugation) {
  std::vector<std::string> overrides = corrugated(kTraction);
  overrides.insert(overrides.end(), {"corrugation.apply=gap", "scene.element_size=8 mm"});
  expect_same_steps(tyre(overrides), 1000, kPrecisions);
}

TEST(Device, TractionsThatDoNotSettleEndTheRun) {
  const Scene scene = samples::tyre_scene();
  Model model(scene);
  const Preload preload = solve_preload(model, steady_motion(model), [](const std::string& /*text*/) {});
  const double dt = scene.motion->step_safety * step_limit(model).stable_step;
  ContactOptions stiff = model.contact->options();
  stiff.penalty *= 1000;  // a hundred times what a scene may state
  model.contact = std::make_unique<Contact>(model.mesh, stiff, Corrugation{});
  for (const bool on_device : {false, true}) {
    SCOPED_TRACE(on_device);
    model.contact->find_static({preload.displacement.data(), nullptr, &preload.wheel});
    model.contact->begin();
    choose_device(on_device ? device(0) : std::shared_ptr<Device>());
    Simulation simulation(model, preload, dt);
    choose_device(std::shared_ptr<Device>());
    samples::expect_part(samples::refusal<NumericalError>([&] { roll_on(simulation, 5); }), "do not settle");
  }
}

TEST(Device, MovedNodesAndFacets) {
  expect_same_steps(tyre(corrugated({"contact.surface=facets", "corrugation.apply=nodes"})), 300,
                    kPrecisions);
}

TEST(Device, DepthsOfEveryKind) {
  std::vector<std::string> overrides = {
      "surface.flat.kind=flat",          "surface.flat.at=10 mm",        "surface.flat.length=30 mm",
      "surface.round.kind=polygon",      "surface.round.order=40",       "surface.round.at=0 mm",
      "surface.round.depth=0.02 mm",     "surface.weld.kind=dip",        "surface.weld.at=2 mm",
      "surface.weld.length=80 mm",       "surface.weld.depth=0.05 mm",   "surface.joint.kind=dip",
      "surface.joint.shape=pointed",     "surface.joint.at=5 mm",        "surface.joint.length=60 mm",
      "surface.joint.depth=0.05 mm",     "surface.squat.kind=dent",      "surface.squat.at=4 mm",
      "surface.squat.length=20 mm",      "surface.squat.width=10 mm",    "surface.squat.depth=0.02 mm",
      "surface.ripple.kind=waves",       "surface.ripple.at=-10 mm",     "surface.ripple.length=40 mm",
      "surface.ripple.wavelength=20 mm", "surface.ripple.depth=0.005 mm"};
  expect_same_steps(tyre(overrides), 300, kPrecisions);
}

TEST(Device, MeasuredDepths) {
  const samples::TemporaryFolder folder;
  const std::string map = (folder.path / "map.txt").string();
  std::ofstream(map) << "# x [mm]  y [mm]  d [um]\n"
                        "-20 -5 0\n0 -5 30\n30 -5 0\n-20 2 0\n0 2 60\n30 2 10\n-20 9 0\n0 9 20\n30 9 0\n";
  const std::string wheel = (folder.path / "wheel.txt").string();
  std::ofstream(wheel) << "# angle [deg]  d [um]\n0 0\n90 20\n180 -10\n270 5\n";
  expect_same_steps(tyre({"surface.squat.kind=map", "surface.squat.at=4 mm", "surface.squat.file=" + map,
                          "surface.round.kind=profile", "surface.round.on=wheel", "surface.round.at=0 mm",
                          "surface.round.file=" + wheel, "corrugation.kind=map", "corrugation.file=" + map,
                          "corrugation.start=25 mm", "corrugation.apply=gap"}),
                    600, {"mixed"});
}

TEST(Device, MaxwellBranches) {
  const auto scene = [](const std::string& precision) {
    return samples::tyre_with_maxwell_branches(
        {"scene.element_size=10 mm", "motion.duration=0.5 ms", "scene.precision=" + precision});
  };
  expect_same_steps(scene, 300, kPrecisions);
}

TEST(Device, PlasticMaterial) {
  expect_same_steps(tyre({"material.steel.law=j2", "material.steel.yield_stress=300 MPa",
                          "material.steel.isotropic_hardening=20 GPa",
                          "material.steel.damping={ kind = \"rayleigh_beta\", value = \"1e-8 s\" }"}),
                    300, kPrecisions);
}

TEST(Device, GuidedBoreAndFallingFriction) {
  expect_same_steps(
      tyre({"wheel.bore=guided", "motion.traction.torque=5 kN m", "motion.traction.ramp=0.05 ms",
            "contact.friction_law=falling", "contact.friction_memory=0.2 mm"}),
      600);
}

TEST(Device, FrictionAlongTheRail) {
  const samples::TemporaryFolder folder;
  const std::string table = (folder.path / "spot.txt").string();
  std::ofstream(table) << "# x [mm]  f [-]\n0 0.5\n20 0.1\n";
  std::vector<std::string> overrides = kTraction;
  overrides.insert(overrides.end(), {"contact.friction_law=table", "contact.friction_file=" + table,
                                     "contact.friction_start=-5 mm"});
  expect_same_steps(tyre(overrides), 300);
}

TEST(Device, ContactIsLostAndFoundAgain) {
  const auto scene = tyre({"load.wheel_load=20 kN", "corrugation.kind=sine", "corrugation.wavelength=40 mm",
                           "corrugation.depth=0.6 mm", "corrugation.width=30 mm", "corrugation.start=5 mm",
                           "corrugation.length=40 mm", "corrugation.apply=gap"});
  Case of(scene("double"));
  const std::vector<double> forces = forces_of(*of.start(device(3)), 700);
  const auto lost = std::find(forces.begin(), forces.end(), 0.0);
  EXPECT_GT(std::count_if(lost, forces.end(), [](double force) { return force > 0; }), 0);
  EXPECT_GT(std::count(forces.begin(), forces.end(), 0.0), 0);
  expect_same_steps(scene, 700, {"double", "mixed"});
}

/// Between looks at the energies only motion and forces of the host's nodes are copied, and the contact's
/// force.
TEST(Device, AStepCopiesFewValues) {
  Case of(file("smooth", kHalfWheelset)("double"));
  const std::shared_ptr<Device> counted = device(0);
  const auto simulation = of.start(counted);
  simulation->set_sampling_interval(1000);
  roll_on(*simulation, 3);
  const DeviceTraffic before = counted->traffic();
  roll_on(*simulation, 4);
  const DeviceTraffic after = counted->traffic();
  const std::int64_t hosts = device_need(of.model()).host_nodes;
  EXPECT_LT(20 * hosts, of.model().nodes());
  EXPECT_EQ(after.to_device - before.to_device, 48 * hosts);
  EXPECT_EQ(after.from_device - before.from_device, 24 * hosts + 56);
  // A kernel for each of 6 blocks, another about the patch for two, and for three by teams that await the
  // host; three of ties, restraints of tied nodes; host, search, patch, tractions, two of their outcome.
  EXPECT_EQ(after.launches - before.launches, 21);
}

/// Probes, forces of fastenings and the stress under the patch read the device's motion.
TEST(Device, MeasurementsOnSleepersOverASoftSupport) {
  const auto scene = tyre(samples::on_sleepers(
      {"motion.start=rigid", "motion.traction.torque=5 kN m", "motion.traction.ramp=0.05 ms",
       "fastenings.damping=20 kN s/m", "support.soft.fastening=2", "support.soft.stiffness=0.5",
       "probe.head.x=20 mm", "probe.head.quantity=all", "probe.box.body=axle_box",
       "output.fastening_forces=true", "output.stress_depth=20 mm"}));
  expect_same_steps(scene, 140, {"mixed"});
  Case at(scene("mixed"));
  const std::vector<double> expected = measured(*roll(at.start(nullptr), 140));
  const std::vector<double> found = measured(*roll(at.start(device(0)), 140));
  ASSERT_EQ(found.size(), expected.size());
  ASSERT_GT(found.size(), 10U);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-3 * std::abs(expected[i])) << i;
}

/// The host moves the struck nodes of the running surface, so that contact runs there too.
TEST(Device, HammerBesideAWheel) {
  const auto scene = tyre({"hammer.position=40 mm", "hammer.force=5 kN", "hammer.duration=0.05 ms"});
  EXPECT_FALSE(movers_of(Case(scene("double")).model()).contact);
  expect_same_steps(scene, 300, {"double", "mixed"});
}

TEST(Device, HammerOnARailOnFastenings) {
  expect_same_steps(file("hammer", {}), 300);
}

TEST(Device, WheelsetWithAVehicleOnASlab) {
  expect_same_steps(file("smooth", kHalfWheelset), 300, kPrecisions);
}

/// From the processor to a device and back; each run has a model of its own, which holds the contact's state.
TEST(Device, ARunGoesOnElsewhere) {
  const Scene scene = tyre(kTraction)("double");
  Case of_whole(scene);
  Case of_begun(scene);
  Case of_device(scene);
  Case of_same(scene);
  Case of_back(scene);
  const auto whole = roll(of_whole.start(nullptr), 500);
  const auto begun = roll(of_begun.start(nullptr), 201);
  const auto on_device = of_device.start(device(3));
  const auto same = of_same.start(device(5));
  samples::copy(begun->state(), on_device->state());
  samples::copy(begun->state(), same->state());
  roll_on(*on_device, 403);
  roll_on(*same, 403);
  EXPECT_EQ(samples::differences(on_device->state(), same->state()), "");

  const auto back = of_back.start(nullptr);
  samples::copy(on_device->state(), back->state());
  roll_on(*back, 500);
  const Apart between = apart(of_whole.values(), *whole, *back);
  EXPECT_LT(between.displacement, 1e-9);
  EXPECT_LT(between.velocity, 1e-9);
}

TEST(Device, IsLostAndTheRunGoesOnFromItsCheckpoint) {
  const samples::TemporaryFolder folder;
  const ResolvedScene resolved =
      resolve_scene(std::string(TREAD_SOURCE_DIR) + "/scenes/tyre.toml",
                    {"scene.element_size=12 mm", "motion.duration=0.1 ms", "motion.traction.ramp=0.05 ms",
                     "solution_zone.start=1 mm", "solution_zone.length=5 mm"});
  RunOptions options;
  options.output = folder.path / "whole";
  options.threads.number = 1;
  options.device = "emulated";
  options.quiet = true;
  run_scene(resolved, options);
  options.output = folder.path / "lost";
  {
    RunSession session(options);
    session.order = {resolved.source, resolved.overrides, {}, resolved_toml(resolved), "", {}};
    session.resolved = resolved;
    RunResults results;
    Model model = run_model(resolved, nullptr, results);
    results.preload = solve_preload(model, steady_motion(model), [](const std::string& /*text*/) {});
    find_step(model, results);
    constexpr std::int64_t kCopies = 300;  // more than a beginning takes
    choose_device(emulated_device({.copies = kCopies}));
    Rolling rolling(session, model, results);
    rolling.begin();
    const std::string text = samples::refusal<ResourceError>([&] { rolling.to_the_end(); });
    samples::expect_part(text, "the device emulated is lost");
    samples::expect_part(text, resume_text(options.output, "--device emulated") + " goes on from there");
  }
  choose_device("cpu");
  resume_run(options);
  samples::expect_same_run(folder.path / "whole", options.output);
  choose_device("cpu");
}

TEST(Device, ASceneThatNeedsMoreMemoryIsRefused) {
  const Progress quiet(true);
  for (const std::string precision : {"double", "mixed"}) {
    const Model model(tyre({})(precision));
    const std::int64_t needed = device_need(model).bytes;
    choose_device(emulated_device({.free_bytes = needed}));
    EXPECT_NO_THROW(settle_device(model, "emulated", quiet));
    choose_device(emulated_device({.free_bytes = needed - 1}));
    const std::string text =
        samples::refusal<ResourceError>([&] { settle_device(model, "emulated", quiet); });
    samples::expect_part(text, "emulated has " + bytes_text(needed - 1) + " free");
    EXPECT_EQ(text.find("scene.precision") != std::string::npos, precision == "double") << text;
    settle_device(model, "auto", quiet);
    EXPECT_EQ(chosen_device(), nullptr);
  }
}

TEST(Device, TakesTheMemoryThatIsStated) {
  for (const Scene& scene : {tyre({})("double"), file("smooth", kHalfWheelset)("mixed")}) {
    const Case of(scene);
    const std::shared_ptr<Device> counted = emulated_device();
    const std::int64_t before = counted->free_bytes();
    const auto simulation = of.start(counted);
    const auto taken = static_cast<double>(before - counted->free_bytes());
    const auto stated = static_cast<double>(device_need(of.model()).bytes);
    EXPECT_GE(stated, taken);
    EXPECT_LT(stated, 1.1 * taken);
  }
}

TEST(Device, OnlyCodeThatKnowsClustersHasTeamsOfThem) {
  EXPECT_EQ(teams_of_code(800), 1);
  EXPECT_EQ(teams_of_code(890), 1);
  EXPECT_EQ(teams_of_code(900), 8);
  EXPECT_EQ(teams_of_code(1200), 8);
}

TEST(Device, NamesThatAreNoDeviceAreRefused) {
  for (const char* name : {"cuda", "gpu:", "gpu:-1", "gpu:1x", "emulate"})
    EXPECT_THROW(missing_device(name), InputError) << name;
  if (gpus().empty()) {
    EXPECT_THROW(choose_device("gpu"), ResourceError);
    EXPECT_THROW(choose_device("gpu:3"), ResourceError);
    choose_device("auto");
    EXPECT_EQ(chosen_device(), nullptr);
  }
  choose_device("emulated");
  EXPECT_EQ(chosen_device()->name(), "emulated");
  choose_device("cpu");
  EXPECT_EQ(chosen_device(), nullptr);
}

}  // namespace
}  // namespace tread
