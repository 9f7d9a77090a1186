// Content that distinguishes a run of a scene from that of another.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "drivers/run/scene_content.hpp"
#include "tests/program.hpp"
#include "tests/refusal.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

class SceneOnATable : public testing::Test {
 protected:
  void SetUp() override { write("0.02 mm"); }
  void write(const std::string& depth) const {
    std::ofstream(folder_.path / "depth.txt")
        << "# x [mm] d [mm]\n0 0\n40 " << depth.substr(0, 4) << "\n80 0\n";
  }
  ResolvedScene resolved() const { return resolve_scene(SceneSource{"test", kText, folder_.path}); }

  static constexpr const char* kText =
      "[scene]\ntitle = \"t\"\nbased_on = \"highspeed-slab-2014\"\n[corrugation]\nkind = \"table\"\n"
      "file = \"depth.txt\"\n";
  samples::TemporaryFolder folder_;
};

TEST_F(SceneOnATable, IsKeptAsItWas) {
  const SceneContent before = scene_content(resolved());
  keep_scene(folder_.path, resolved());
  EXPECT_EQ(difference(before, kept_scene(folder_.path).content), "");
  write("0.03 mm");
  EXPECT_EQ(difference(before, kept_scene(folder_.path).content), "");
  const std::string apart = difference(scene_content(resolved()), kept_scene(folder_.path).content);
  EXPECT_TRUE(samples::has(apart, "corrugation.file is a .txt file of checksum ")) << apart;
}

TEST_F(SceneOnATable, IsTheSameWhereItHasMoved) {
  const std::filesystem::path old = folder_.path / "old", now = folder_.path / "now";
  std::filesystem::create_directories(old / "runs/one");
  std::filesystem::rename(folder_.path / "depth.txt", old / "depth.txt");
  const auto at = [](const std::filesystem::path& place) {
    return resolve_scene(SceneSource{"test", kText, place});
  };
  const SceneContent before = scene_content(at(old));
  keep_scene(old / "runs/one", at(old));
  std::filesystem::rename(old, now);
  const KeptScene kept = kept_scene(now / "runs/one");  // the file lies above the folder, as before
  EXPECT_EQ(difference(before, kept.content), "");
  EXPECT_EQ(difference(scene_content(at(now)), kept.content), "");
  EXPECT_EQ(kept.resolved.scene.corrugation->table_x.size(), 3U);
}

TEST_F(SceneOnATable, AFileThatIsNotThereIsKnownByItsChecksum) {
  const std::filesystem::path run = folder_.path / "run", other = folder_.path / "other.txt";
  std::filesystem::create_directories(run);
  keep_scene(run, resolved());
  const SceneFiles files = resolved().source.files;
  std::filesystem::rename(folder_.path / "depth.txt", other);
  EXPECT_EQ(kept_scene(run, files).resolved.scene.corrugation->table_x.size(), 3U);
  const std::string place = (folder_.path / "depth.txt").string();
  samples::expect_part(samples::refusal<InputError>([&] { kept_scene(run); }),
                       "put them back, or into " + run.string() + ":\n" + place + " of checksum ");
  std::filesystem::rename(other, run / "depth.txt");
  EXPECT_EQ(
      difference(scene_content(resolve_scene(SceneSource{"test", kText, run})), kept_scene(run).content), "");
}

TEST(SceneContent, TellsMaterialsApart) {
  const std::string text = "[scene]\ntitle = \"t\"\nbased_on = \"highspeed-slab-2014\"\n";
  const std::string table =
      "[material.wheel_steel]\npoissons_ratio = 0.3\ndensity = \"7790 kg/m3\"\nyoungs_modulus";
  const std::string part = "[wheel]\nmaterial = \"wheel_steel\"\n";
  const auto content = [&](const std::string& more) {
    return scene_content(resolve_scene(SceneSource{"test", text + more, "."}));
  };
  const SceneContent of_steel = content("");
  const SceneContent of_own = content(table + " = \"205.9 GPa\"\n" + part);
  const SceneContent of_soft = content(table + " = \"70 GPa\"\n" + part);
  EXPECT_EQ(difference(of_soft, content(part + table + " = \"70 GPa\"\n")), "");
  EXPECT_NE(difference(of_steel, of_own), "");
  EXPECT_EQ(difference(of_own, of_soft),
            "material.wheel_steel.youngs_modulus is 205900000000 Pa here and 70000000000 Pa there");
}

TEST(PreloadContent, HasTheTractionOfAStartWithoutRamp) {
  const auto content = [](double mu, const char* ramp) {
    const std::string text = "[scene]\ntitle = \"t\"\nbased_on = \"highspeed-slab-2014\"\n";
    return preload_content(resolve_scene(
        SceneSource{"test", text, "."},
        {"motion.traction.mu=" + std::to_string(mu), std::string("motion.traction.ramp=") + ramp,
         "vehicle.longitudinal=free", "motion.duration=1 ms"}));
  };
  EXPECT_EQ(difference(content(0.1, "5 ms"), content(0.1, "4 ms")), "");
  EXPECT_TRUE(samples::has(difference(content(0.1, "0 ms"), content(0.2, "0 ms")), "motion.traction.mu"));
  EXPECT_NE(difference(content(0.1, "0 ms"), content(0.1, "1 us")), "");
}

TEST_F(SceneOnATable, AnotherWithoutFilesLeavesNoChecksums) {
  keep_scene(folder_.path, resolved());
  const SceneSource plain{"test", "[scene]\ntitle = \"t\"\nbased_on = \"highspeed-slab-2014\"\n", "."};
  keep_scene(folder_.path, resolve_scene(plain));
  EXPECT_FALSE(std::filesystem::exists(folder_.path / "scene.files.json"));
}

/// Where it stands, away from the solution zone, the track is fine under it.
TEST(PreloadContent, TellsAWheelThatStandsFromOneThatMoves) {
  const auto content = [](const char* mu) {
    const std::string text = "[scene]\ntitle = \"t\"\nbased_on = \"highspeed-slab-2014\"\n";
    return preload_content(
        resolve_scene(SceneSource{"test", text, "."},
                      {"motion.speed=0 km/h", "motion.duration=20 ms", "motion.traction.ramp=1 ms",
                       "vehicle.longitudinal=free", std::string("motion.traction.mu=") + mu}));
  };
  EXPECT_EQ(difference(content("0.01"), content("0.02")), "");
  EXPECT_EQ(difference(content("0.25"), content("0.3")), "");
  EXPECT_TRUE(samples::has(difference(content("0.01"), content("0.3")), "zone is "));
}

TEST_F(SceneOnATable, NeedsNoChecksums) {
  // Folders without kept contents of files: the file in its present state counts.
  keep_scene(folder_.path, resolved());
  std::filesystem::remove(folder_.path / "scene.files.json");
  EXPECT_EQ(difference(scene_content(resolved()), kept_scene(folder_.path).content), "");
}

}  // namespace
}  // namespace tread
