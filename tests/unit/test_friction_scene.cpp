// Keys of the friction laws: what is read, what is refused and with which words.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "drivers/engine/model/model.hpp"
#include "io/scene/schema.hpp"
#include "tests/refusal.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

std::string file(const std::string& name, const std::string& text) {
  static const samples::TemporaryFolder folder;
  std::string path = (folder.path / name).string();
  std::ofstream(path) << text;
  return path;
}

/// The message with which the scene is refused; empty if it is accepted.
std::string refusal(const std::vector<std::string>& overrides) {
  return samples::refusal<InputError>([&] { samples::tyre_scene(overrides); });
}

void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) samples::expect_part(message, part);
}

std::vector<std::string> table(const std::string& text) {
  return {"contact.friction_law=table", "contact.friction_file=" + file("f.txt", text)};
}

TEST(FrictionScene, CoulombIsTheDefault) {
  const Scene scene = samples::tyre_scene();
  EXPECT_EQ(scene.contact->friction_law, "coulomb");
  EXPECT_EQ(scene.contact->largest_friction(), 0.5);
  EXPECT_EQ(scene.contact->least_friction(), 0.5);
}

/// A name in the schema without a law, or without its range, would be another law's.
TEST(FrictionScene, EveryNameHasItsOwnLawAndARange) {
  Scene scene = samples::tyre_scene({"scene.element_size=14 mm"});
  scene.contact->friction_x = {0};
  scene.contact->friction_at_x = {0.3};
  scene.contact->friction_memory = 1e-4;
  const std::vector<std::string> names = find_key("contact.friction_law")->allowed;
  std::set<std::size_t> laws;
  for (const std::string& name : names) {
    scene.contact->friction_law = name;
    EXPECT_LE(scene.contact->least_friction(), scene.contact->largest_friction()) << name;
    laws.insert(Model(scene).contact->options().friction.index());
  }
  EXPECT_EQ(laws.size(), names.size());
  EXPECT_EQ(laws.size(), std::variant_size_v<FrictionLaw>);
  scene.contact->friction_law = "unknown";
  EXPECT_THROW(scene.contact->largest_friction(), InputError);
  EXPECT_THROW(Model{scene}, InputError);
}

TEST(FrictionScene, ATableIsReadInItsUnits) {
  std::vector<std::string> overrides = table("# x [mm]  f [-]\n0 0.4\n50 0.1\n");
  overrides.push_back("contact.friction_start=20 mm");
  const Scene scene = samples::tyre_scene(overrides);
  EXPECT_EQ(scene.contact->friction_x, (std::vector<double>{0, 0.05}));
  EXPECT_EQ(scene.contact->friction_at_x, (std::vector<double>{0.4, 0.1}));
  EXPECT_EQ(scene.contact->friction_start, 0.02);
  EXPECT_EQ(scene.contact->largest_friction(), 0.4);
  EXPECT_EQ(scene.contact->least_friction(), 0.1);
}

TEST(FrictionScene, APathBehindALinkLeadsWhereTheFileSystemLeads) {
  const samples::TemporaryFolder folder;
  const std::filesystem::path real = std::filesystem::canonical(folder.path) / "real";
  std::filesystem::create_directories(real / "below");
  std::filesystem::create_directory_symlink(real / "below", folder.path / "link");
  std::ofstream(real / "f.txt") << "# x [m]  f [-]\n0 0.4\n1 0.3\n";
  for (const std::filesystem::path& place :
       {folder.path / "link/../f.txt", real / "none/.././below/../f.txt"}) {
    const Scene scene =
        samples::tyre_scene({"contact.friction_law=table", "contact.friction_file=" + place.string()});
    EXPECT_EQ(scene.contact->friction_file, (real / "f.txt").string());
  }
}

TEST(FrictionScene, BadTablesAreRefused) {
  expect_parts(refusal(table("0 0.4\n1 0.3\n")), {"the units are missing", "f [-]"});
  expect_parts(refusal(table("# x [m]  f [mm]\n0 0.4\n1 0.3\n")), {"[mm] is not [-]"});
  expect_parts(refusal(table("# x [m]  f [-]\n0 0.4\n0 0.3\n")), {"must grow"});
  expect_parts(refusal(table("# x [m]  f [-]\n0 0.4\n1 -0.3\n")),
               {"contact.friction_file", "f = -0.3 at x = 1 m", "from 0 to 2"});
  expect_parts(refusal({"contact.friction_law=table"}), {"contact.friction_file"});
}

TEST(FrictionScene, KeysOfAnotherLawAreRefused) {
  expect_parts(refusal({"contact.friction_memory=20 um"}),
               {"contact.friction_memory", "only with contact.friction_law"});
  std::vector<std::string> overrides = table("# x [m]  f [-]\n0 0.4\n1 0.3\n");
  overrides.push_back("contact.friction_fast=0.1");
  expect_parts(refusal(overrides), {"contact.friction_fast", "only with contact.friction_law"});
}

TEST(FrictionScene, FallingFrictionNeedsAMemory) {
  expect_parts(refusal({"contact.friction_law=falling"}), {"contact.friction_memory"});
  expect_parts(refusal({"contact.friction_law=falling", "contact.friction_memory=0 um"}),
               {"contact.friction_memory", "ill-posed", "state the sliding length"});
  EXPECT_EQ(refusal({"contact.friction_law=falling", "contact.friction_memory=20 um"}), "");
}

TEST(FrictionScene, FallingFrictionFalls) {
  expect_parts(
      refusal({"contact.friction_law=falling", "contact.friction_memory=20 um", "contact.friction=0.3",
               "contact.friction_fast=0.4"}),
      {"contact.friction_fast", "0.4", "0.3", "would not fall", "state a smaller contact.friction_fast"});
}

TEST(FrictionScene, TractionBeyondTheLargestCoefficientIsRefused) {
  std::vector<std::string> overrides = table("# x [m]  f [-]\n0 0.2\n1 0.1\n");
  overrides.emplace_back("motion.traction.mu=0.25");
  expect_parts(refusal(overrides), {"traction coefficient of 0.25", "0.2"});
}

}  // namespace
}  // namespace tread
