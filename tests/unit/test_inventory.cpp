// The inventory lists what a scene contains and nothing else, in the order of the step.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/parallel/ranks.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/report/scene_check.hpp"
#include "drivers/results/disk_use.hpp"
#include "drivers/results/inventory.hpp"
#include "drivers/results/memory_need.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/json.hpp"
#include "tests/bar_scene.hpp"
#include "tests/refusal.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

// A short piece of the track and a coarse wheelset.
const std::vector<std::string> kSmall = {
    "scene.element_size=6mm", "rail.length=2.7m",         "rail.origin=1.3m",          "fastenings.count=4",
    "fastenings.first=0.3m",  "solution_zone.start=20mm", "solution_zone.length=40mm", "motion.duration=1ms"};

constexpr const char* kWheelset = R"(
[scene]
title = "wheelset on slab track"
based_on = "highspeed-slab-2014"
[motion]
traction = { mu = 0.3, ramp = "1 ms" }
[corrugation]
start = "20 mm"
wavelength = "20 mm"
length = "40 mm"
)";

Scene static_tyre() {
  Scene scene = samples::tyre_scene();
  scene.motion.reset();
  return scene;
}

Scene scene_of(const char* text, const std::vector<std::string>& overrides = {}) {
  return resolve_scene(SceneSource{"scene.toml", text, "."}, overrides).scene;
}

Scene small_track(std::vector<std::string> more = {}) {
  std::vector<std::string> all = kSmall;
  all.insert(all.end(), more.begin(), more.end());
  return scene_of(kWheelset, all);
}

std::set<std::string> phase_names(const Model& model) {
  std::set<std::string> names;
  for (const PhaseRow& phase : phases(model)) names.insert(phase.name);
  return names;
}

std::set<std::string> field_names(const Model& model) {
  std::set<std::string> names;
  for (const FieldRow& field : fields(model)) names.insert(field.name);
  return names;
}

std::int64_t bytes_of(const Model& model, const std::string& name) {
  std::int64_t sum = 0;
  for (const FieldRow& field : fields(model))
    if (field.name == name) sum += field.bytes;
  return sum;
}

/// Names in `all` that are not in `part`.
std::set<std::string> missing(const std::set<std::string>& all, const std::set<std::string>& part) {
  std::set<std::string> out;
  std::set_difference(all.begin(), all.end(), part.begin(), part.end(), std::inserter(out, out.end()));
  return out;
}

using Names = std::set<std::string>;

/// Part of the model that a phase works on.
std::string body_of(const Model& model, const std::string& name) {
  for (const PhaseRow& phase : phases(model))
    if (phase.name == name) return phase.body;
  return "";
}

void expect_consistent(const Model& model) {
  const Names known = field_names(model);
  Names used;
  for (const PhaseRow& phase : phases(model)) {
    used.insert(phase.reads.begin(), phase.reads.end());
    used.insert(phase.writes.begin(), phase.writes.end());
  }
  EXPECT_EQ(used, known);
  for (const FieldRow& field : fields(model)) EXPECT_GT(field.bytes, 0) << field.name;
}

TEST(Inventory, EveryFieldBelongsToAPhaseAndHasBytes) {
  Model track(small_track());
  expect_consistent(track);
  expect_consistent(Model(static_tyre()));
  expect_consistent(Model(scene_of(samples::kBar)));
}

/// Names of the phases that a simulation enters in a step in which energies are looked at.
std::vector<std::string> entered_phases(const Model& model) {
  Preload preload;
  preload.displacement.assign(static_cast<std::size_t>(3 * model.mesh.slots), 0.0);
  if (model.contact) preload.wheel.origin.z = model.contact->touching_height() - 5e-5;
  Simulation simulation(model, preload, 1e-9);
  PhaseClock clock;
  simulation.observe(&clock);
  simulation.step();
  simulation.observe(nullptr);
  clock.stop();
  std::vector<std::string> names;
  for (const StepPhase phase : clock.phases()) names.emplace_back(name_of(phase));
  return names;
}

/// Names of the inventory's phases that belong to a step.
std::vector<std::string> listed_phases(const Model& model) {
  std::vector<std::string> names;
  for (const PhaseRow& phase : phases(model))
    if (phase.name != "preload" && phase.name != "checkpoint" && phase.name != "frames")
      names.push_back(phase.name);
  return names;
}

TEST(Inventory, ListsThePhasesThatASimulationEntersInTheirOrder) {
  const std::string hammer = std::string(TREAD_SOURCE_DIR) + "/scenes/hammer.toml";
  const std::vector<Scene> scenes = {
      small_track(), read_scene(hammer), samples::tyre_with_maxwell_branches({"scene.element_size=8 mm"}),
      samples::tyre_scene({"scene.element_size=8 mm", "wheel.bore=guided", "motion.traction.torque=5 kN m",
                           "scene.precision=mixed"})};
  std::set<std::string> met;
  for (const Scene& scene : scenes) {
    const Model model(scene, 0.0);
    expect_consistent(model);
    const std::vector<std::string> entered = entered_phases(model);
    EXPECT_EQ(entered, listed_phases(model)) << scene.title;
    met.insert(entered.begin(), entered.end());
  }
  EXPECT_EQ(met.size(), kStepPhases);  // every feature is in one of the scenes
}

TEST(Inventory, BranchLagIsThereWithABranchOnly) {
  const std::vector<std::string> damping = {
      "material.steel.damping={ kind = \"rayleigh_beta\", value = \"1e-4 s\" }",
      "material.steel.damping_up_to=3 kHz"};
  const Model with(scene_of(samples::kBar, damping));
  const Model without(scene_of(samples::kBar));
  expect_consistent(with);
  EXPECT_EQ(missing(phase_names(with), phase_names(without)), Names{"Maxwell branches"});
  EXPECT_EQ(missing(field_names(with), field_names(without)), Names{"branch lag"});
  EXPECT_EQ(bytes_of(with, "branch lag"), bytes_of(with, "velocity"));
  EXPECT_GT(bytes_of(with, "checkpoint"), bytes_of(without, "checkpoint"));
}

TEST(Inventory, WithoutSlabThereIsNoVerticalUpdate) {
  const Model with(small_track());
  const Model without(small_track({"slab.present=false"}));
  EXPECT_EQ(phase_names(with), phase_names(without));
  EXPECT_EQ(body_of(with, "update"), "rail, slab (vertically), wheel");
  EXPECT_EQ(body_of(without, "update"), "rail, wheel");
  EXPECT_EQ(field_names(with), field_names(without));
  EXPECT_EQ(with.mesh.blocks.size(), without.mesh.blocks.size() + 1);
  // Every node field has one block less: no part of the slab is left.
  const std::int64_t slab = with.mesh.blocks[static_cast<std::size_t>(with.index.slab)].slots();
  EXPECT_EQ(with.mesh.slots - without.mesh.slots, slab);
  EXPECT_EQ(bytes_of(with, "displacement") - bytes_of(without, "displacement"),
            3 * slab * static_cast<std::int64_t>(sizeof(double)));
  EXPECT_LT(bytes_of(without, "restrained unknowns"), bytes_of(with, "restrained unknowns"));
}

TEST(Inventory, WithoutTractionThereIsNoTorque) {
  Scene scene = small_track();
  scene.motion->traction_mu.reset();
  const Model without(scene);
  const Model with(small_track());
  EXPECT_EQ(missing(phase_names(with), phase_names(without)), Names{"torque"});
  EXPECT_EQ(missing(field_names(with), field_names(without)), Names{"torque nodes"});
}

TEST(Inventory, SmoothRailMovesNoNodesForACorrugation) {
  Model smooth(small_track({"corrugation.present=false"}));
  Model corrugated(small_track());
  const std::int64_t chords = bytes_of(smooth, "moved nodes");
  EXPECT_EQ(bytes_of(corrugated, "moved nodes"), chords);
  smooth.apply_corrugation(0);
  corrugated.apply_corrugation(0);
  EXPECT_EQ(bytes_of(smooth, "moved nodes"), chords);
  EXPECT_GT(bytes_of(corrugated, "moved nodes"), chords);
  EXPECT_GT(bytes_of(corrugated, "coefficients"), bytes_of(smooth, "coefficients"));
  // Added to the gap, the corrugation moves no node.
  Model gap(small_track({"corrugation.apply=gap"}));
  gap.apply_corrugation(0);
  EXPECT_EQ(bytes_of(gap, "moved nodes"), chords);
}

TEST(Inventory, StaticTyreHasNoStep) {
  const Model model(static_tyre());
  EXPECT_EQ(phase_names(model), Names{"preload"});
  EXPECT_EQ(field_names(model), (Names{"coefficients", "mass", "restrained unknowns", "journal nodes",
                                       "contact points", "wheel frame", "displacement", "solver"}));
}

TEST(Inventory, BarHasNeitherWheelNorContactNorTrack) {
  const Model model(scene_of(samples::kBar));
  const Names expected = {"preload", "internal force", "energies", "update",
                          "samples", "checkpoint",     "frames"};
  EXPECT_EQ(phase_names(model), expected);
  EXPECT_EQ(missing(expected, phase_names(Model(scene_of(samples::kBar, {"output.frames=0"})))),
            Names{"frames"});
  const Names names = field_names(model);
  for (const char* absent :
       {"moved nodes", "tie links", "fastening elements", "journal nodes", "torque nodes", "contact points",
        "surface fields", "wheel frame", "sprung mass", "restrained unknowns"})
    EXPECT_EQ(names.count(absent), 0U) << absent;
  EXPECT_TRUE(model.journal.empty());
  EXPECT_TRUE(model.torque.empty());
  EXPECT_FALSE(model.contact);
}

TEST(Quality, PaperHasThePapersElements) {
  const Scene scene =
      resolve_scene(
          SceneSource{"paper.toml", "[scene]\nbased_on = \"highspeed-slab-2014\"\nquality = \"paper\"\n", {}},
          {})
          .scene;
  const Model model(scene);
  EXPECT_NEAR(static_cast<double>(model.elements()), 1.46e6, 0.05 * 1.46e6);  // [paper, section 2]
  EXPECT_EQ(model.sizes.contact, 1.1e-3);
}

TEST(Memory, TheMeshIsCountedWithoutItsFields) {
  const Scene scene = small_track();
  const Model model(scene);
  MeshCount count;
  const auto refuse = [&](const MeshCount& offered, const MeshSizes& /*sizes*/) {
    count = offered;
    throw ResourceError("too large");
  };
  EXPECT_THROW(Model(scene, {}, refuse), ResourceError);
  EXPECT_EQ(count.elements, model.elements());
  EXPECT_EQ(count.nodes, model.nodes());
}

TEST(Memory, CheckpointsCountInRunsThatLastLongEnough) {
  const Model model(small_track({"output.checkpoint_interval=10min"}));
  EXPECT_EQ(peak_bytes(model, 0), peak_bytes(model, 599));
  EXPECT_LE(peak_bytes(model, 599), peak_bytes(model, 600));
}

TEST(Memory, ASampleAStepIsTheMost) {
  const auto bytes = [](const char* interval) {
    return peak_bytes(Model(samples::tyre_scene(
                          {"scene.element_size=8 mm", std::string("output.history_interval=") + interval})),
                      0);
  };
  EXPECT_EQ(bytes("1 ns"), bytes("1e-30 s"));
  EXPECT_LT(bytes("1 ns"), bytes("1 ms") + (20 << 20));
}

/// The order and each of three states carry the files that the scene names; so does a state for forks.
TEST(Disk, FilesOfTheSceneCount) {
  const std::int64_t files = file_bytes({"scene.toml",
                                         "",
                                         ".",
                                         {{"/a.txt", std::make_shared<const std::string>("12345")},
                                          {"/b.inp", std::make_shared<const std::string>("123")}}});
  EXPECT_EQ(files, 8);
  Scene scene = small_track();
  scene.forks.emplace();
  const Model model(scene);
  constexpr double kStep = 1e-7;
  const DiskUse without = disk_use(model, kStep);
  const DiskUse with = disk_use(model, kStep, files);
  EXPECT_EQ(with.checkpoints - without.checkpoints, 4 * files);
  EXPECT_EQ(with.results - without.results, files);
  EXPECT_EQ(disk_use(model, 0, files).total() - disk_use(model, 0).total(), files);
  EXPECT_GT(peak_bytes(model, 0, files), peak_bytes(model, 0) + files);
}

TEST(Memory, ARunNeedsMoreThanTheLeast) {
  const Scene scene = small_track();
  const Model model(scene);
  const std::int64_t least = least_bytes({model.elements(), model.nodes()});
  EXPECT_LT(least, peak_bytes(model, 0));
  EXPECT_GT(least, peak_bytes(model, 0) / 8);
}

TEST(Memory, CheckWarnsOfAMachineThatIsTooSmall) {
  const Scene scene = small_track();
  const Model model(scene);
  Estimate estimate;
  const std::size_t of_mesh = check_warnings(model, estimate).size();
  EXPECT_EQ(number_in(parse_json(check_json(model, estimate).dump(), "check"), "wheel_load_N"),
            model.wheel_load());
  estimate.memory = machine_memory() + 1;
  estimate.disk.frames = std::int64_t{1} << 60;
  const std::vector<std::string> warnings = check_warnings(model, estimate);
  ASSERT_EQ(warnings.size(), of_mesh + 2);
  EXPECT_TRUE(warnings[of_mesh].starts_with("a run needs about ")) << warnings[of_mesh];
  EXPECT_NE(warnings[of_mesh].find("of memory, this machine has"), std::string::npos) << warnings[of_mesh];
  EXPECT_NE(warnings.back().find("of disk, this folder's has"), std::string::npos) << warnings.back();
}

/// Ranks of one machine.
class RanksOfAMachine final : public Ranks {
 public:
  RanksOfAMachine(int rank, int count) : rank_(rank), count_(count) {}
  int rank() const override { return rank_; }
  int count() const override { return count_; }
  void exchange(std::span<const RankSegment> /*sent*/, std::span<const RankSegment> /*received*/) override {}
  void post(std::span<const RankSegment> /*sent*/) override {}
  void receive(std::span<const RankSegment> /*received*/) override {}
  [[noreturn]] void end_all(int code) override { std::exit(code); }

 private:
  void broadcast_bytes(std::span<std::byte> /*bytes*/) override {}
  void gather_values(std::byte* /*values*/, int /*size*/, std::span<const std::int64_t> /*first*/) override {}
  int rank_, count_;
};

/// Refusal of a mesh of so many nodes; empty: there is none.
template <class Require>
std::string refusal(const Require& require, double nodes) {
  return samples::refusal<ResourceError>([&] {
    require(MeshCount{1000, static_cast<std::int64_t>(nodes)}, MeshSizes{});
  });
}

/// Rank 0 alone solves the preload; each rank has all masses.
TEST(Memory, RanksShareAMachine) {
  const double most = static_cast<double>(machine_memory()) / static_cast<double>(least_bytes({0, 1}));
  const auto on_ranks = [](int rank, int count, double nodes) {
    choose_ranks(std::make_shared<RanksOfAMachine>(rank, count));
    const std::string said = refusal(require_memory, nodes);
    choose_ranks(nullptr);
    return said;
  };
  EXPECT_EQ(refusal(require_memory, 0.9 * most), "");
  EXPECT_NE(refusal(require_memory, 1.1 * most), "");
  EXPECT_EQ(on_ranks(0, 8, 0.9 * most), "");
  EXPECT_NE(on_ranks(0, 8, 1.1 * most), "");
  EXPECT_EQ(on_ranks(1, 8, 1.1 * most), "");  // on a machine without rank 0
  const std::string many = on_ranks(0, 100, 0.9 * most);
  EXPECT_NE(many.find("on 100 ranks; this machine has"), std::string::npos) << many;
  EXPECT_NE(many.find("or start fewer ranks"), std::string::npos) << many;
}

TEST(Memory, AMeshAloneNeedsItsMasses) {
  const double most = static_cast<double>(machine_memory()) / static_cast<double>(mass_bytes({0, 1}));
  EXPECT_LT(mass_bytes({0, 1}), least_bytes({0, 1}));
  EXPECT_EQ(refusal(require_memory_of_mesh, 0.9 * most), "");
  EXPECT_NE(refusal(require_memory_of_mesh, 1.1 * most), "");
}

}  // namespace
}  // namespace tread
