// Values from the literature beside a run's results: which scenes they are shown for, and where the files
// lie.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/report/report_references.hpp"
#include "io/files/share_folder.hpp"
#include "io/scene/scene_library.hpp"
#include "io/scene/scene_reader.hpp"
#include "tests/refusal.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = R"(
title = "Beside a book"
column = "Book"
[scenes.steel]
"material.steel.youngs_modulus" = "205.9 GPa"
[scenes.rolling]
"motion.speed" = "300 km/h"
"wheel.profile" = "LMA"
[scenes.track]
slab = true
[[reference]]
label = "Load"
unit = "kN"
value = 87.56
result = "static_wheel_load_N"
scale = 1e-3
scenes = ["steel", "rolling"]
[[reference]]
label = "Bending"
unit = "mm"
value = 1
result = "rail_deflection_m"
scenes = ["track"]
after = "ramp"
)";

class ReferenceFile : public testing::Test {
 protected:
  Scene scene(const std::string& name, const std::vector<std::string>& overrides = {}) const {
    return read_scene(fs::path(TREAD_SOURCE_DIR) / "scenes" / name, overrides);
  }
  References read(const std::string& text, const Scene& of) const {
    std::ofstream(path_) << text;
    return read_references(path_, of);
  }
  std::vector<std::string> labels(const Scene& of) const {
    std::vector<std::string> names;
    for (const Reference& one : read(kFile, of).rows) names.push_back(one.label);
    return names;
  }
  std::string refusal(const std::string& text) const {
    return samples::refusal<InputError>([&] { read(text, scene("smooth.toml")); });
  }
  samples::TemporaryFolder folder_;
  fs::path path_ = folder_.path / "book.toml";
};

using Names = std::vector<std::string>;

TEST_F(ReferenceFile, ShowsRowsWhoseScenesHold) {
  EXPECT_EQ(labels(scene("smooth.toml")), (Names{"Load", "Bending"}));
  EXPECT_EQ(labels(scene("smooth.toml", {"motion.speed=200 km/h"})), Names{"Bending"});
  EXPECT_EQ(labels(scene("smooth.toml", {"slab.present=false"})), Names{"Load"});
  EXPECT_EQ(labels(scene("bar-wave.toml")), Names{});  // no wheel, no motion.speed, no slab
  const References read_back = read(kFile, scene("smooth.toml"));
  EXPECT_EQ(read_back.title, "Beside a book");
  EXPECT_EQ(read_back.column, "Book");
  EXPECT_EQ(read_back.rows[0].scale, 1e-3);
  EXPECT_EQ(read_back.rows[1].value, 1);
  EXPECT_EQ(read_back.rows[1].after, Reference::After::ramp);
}

TEST_F(ReferenceFile, SaysWhatIsWrong) {
  const std::string row = "[[reference]]\nlabel = \"a\"\nunit = \"-\"\nvalue = 1\nresult = \"steps\"\n";
  for (const auto& [text, part] : std::vector<std::pair<std::string, std::string>>{
           {"title = \"x\"\n", "there is no [[reference]]"},
           {"[[reference]]\nlabel = \"a\"\n", "a reference lacks `unit`"},
           {row, "a reference lacks `scenes`"},
           {row + "scenes = [\"x\"]\n", "there is no table [scenes] of the string \"x\""},
           {row + "scenes = [\"x\"]\n[scenes.x]\n\"motion.sped\" = 1\n", "motion.sped: no such key"},
           {row + "scenes = [\"x\"]\n[scenes.x]\n\"motion.speed\" = 1\n", "motion.speed: 1 has no unit"},
           {row + "scenes = []\nafter = \"lunch\"\n", "after = \"lunch\""},
           {row + "scenes = []\nranges = { steps = [1] }\n", "ranges.steps: expected [low, high]"},
           {"x = [", "book.toml"}}) {
    const std::string message = refusal(text);
    EXPECT_NE(message.find(part), std::string::npos) << part << ": " << message;
    EXPECT_NE(message.find("book.toml"), std::string::npos) << message;
  }
}

TEST_F(ReferenceFile, ACoarseMeshIsBlamedBeforeTheProfiles) {
  const Model coarse(scene("smooth.toml", {"scene.element_size=11 mm"}));
  const std::vector<Comparison> rows = hertz_comparisons(coarse, {});
  ASSERT_EQ(rows.size(), 2U);
  for (const Comparison& row : rows) {
    EXPECT_NE(row.remark.find("1.0 elements across the patch do not resolve it"), std::string::npos)
        << row.remark;
    EXPECT_EQ(row.remark.find("not Hertzian"), std::string::npos) << row.remark;
  }
}

class ShareFolder : public ReferenceFile {
 protected:
  ~ShareFolder() override { ::unsetenv("TREAD_SHARE"); }
};

TEST_F(ShareFolder, HoldsTheReferencesOfTheLibrary) {
  const auto count = [&](const Scene& of) {
    std::size_t rows = 0;
    for (const References& file : library_references(of)) rows += file.rows.size();
    return rows;
  };
  EXPECT_EQ(count(scene("corrugation-d.toml")), 8U);
  EXPECT_EQ(count(scene("corrugation-d.toml", {"corrugation.depth=0.1 mm"})), 5U);
  EXPECT_EQ(count(scene("corrugation-d.toml", {"motion.speed=200 km/h"})), 1U);
  for (const LibraryEntry& entry : scene_library()) {
    if (!entry.name.starts_with("highspeed-slab-2014")) continue;
    EXPECT_EQ(count(scene("corrugation-d.toml", {fmt::format("scene.based_on={}", entry.name)})), 8U)
        << entry.name;
  }
  EXPECT_EQ(count(scene("corrugation-d.toml", {"fastenings.damping=150 kN s/m"})), 2U);
  EXPECT_EQ(count(scene("bar-wave.toml")), 0U);
  EXPECT_EQ(count(scene("tyre.toml")), 1U);
  EXPECT_EQ(count(scene("tyre.toml", {"wheel.crown_radius=0.4 m"})), 0U);
  EXPECT_EQ(count(scene("corrugation-d.toml", {"wheel.lateral_offset=2.85 mm"})), 7U);
  // The vehicle's load, step and elements stay.
  for (const char* other : {"surface.a={ kind = 'dip', at = '1 m', depth = '0.1 mm', length = '0.2 m' }",
                            "support.a={ fastening = 12, stiffness = 0 }"})
    EXPECT_EQ(count(scene("corrugation-d.toml", {other})), 3U) << other;
  const std::vector<Marker> levels = creepage_levels(library_references(scene("smooth.toml")));
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_EQ(levels[0].at, 0.276);
}

TEST_F(ShareFolder, ScenesAreOnlyWhereTheEnvironmentSays) {
  const fs::path share = folder_.path / "share";
  fs::create_directories(folder_.path / "scenes");
  ::setenv("TREAD_SHARE", share.c_str(), 1);
  EXPECT_EQ(find_scene("tyre"), "tyre");
  EXPECT_TRUE(shipped_scenes().empty());
  std::ofstream(folder_.path / "scenes/beside.toml") << "";
  EXPECT_EQ(shipped_scenes(), std::vector<std::string>{"beside"});
  fs::create_directories(share / "scenes");
  std::ofstream(share / "scenes/own.toml") << "";
  EXPECT_EQ(find_scene("own"), share / "scenes/own.toml");
  ::setenv("TREAD_SHARE", TREAD_SOURCE_DIR "/share", 1);
  EXPECT_NE(find_scene("tyre"), "tyre");
}

TEST_F(ShareFolder, IsWhereTheEnvironmentSays) {
  fs::create_directories(folder_.path / "references");
  ::setenv("TREAD_SHARE", folder_.path.c_str(), 1);
  EXPECT_EQ(share_folders(), std::vector<fs::path>{folder_.path});
  EXPECT_EQ(find_share_file("references/highspeed-slab-2014.toml"), fs::path());
  EXPECT_TRUE(library_references(scene("smooth.toml")).empty());  // a plain absence
  std::ofstream(folder_.path / "references/highspeed-slab-2014.toml") << kFile;
  EXPECT_EQ(library_references(scene("smooth.toml")).at(0).title, "Beside a book");
}

}  // namespace
}  // namespace tread
