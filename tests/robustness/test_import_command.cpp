// `tread import` as users call it: an exported scene read again, and the refusal of a broken file.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "tests/mesh_files.hpp"
#include "tests/program.hpp"

namespace tread {
namespace {

using namespace samples;
using nlohmann::json;

const std::string kScene = scene_word("tyre.toml") + " --set \"scene.element_size=10 mm\"";

TEST(ImportCommand, ReadsAnExportedScene) {
  const Program program;
  const std::string deck = (program.folder / "tyre.k").string();
  ASSERT_EQ(program.call(fmt::format("export {} --set motion.start=rigid -o {}", kScene, deck)), 0)
      << program.errors();
  ASSERT_EQ(program.call(fmt::format("mesh {} --json", kScene)), 0) << program.errors();
  const json scene = json::parse(program.out());
  ASSERT_EQ(program.call(fmt::format("import {} --unit mm --pieces 2 --json", deck)), 0) << program.errors();
  const json read = json::parse(program.out());
  EXPECT_EQ(read["elements"], scene["elements"]);
  EXPECT_EQ(read["nodes"], scene["nodes"]);
  double mass = 0, step = 1;
  for (const json& body : scene["bodies"]) mass += body["mass_kg"].get<double>();
  for (const json& block : scene["blocks"])
    step = std::min(step, block["stiffest_element_step_s"].get<double>());
  // The deck has 15 digits; elements on the tyre's chords differ from the swept shape of its coefficients.
  EXPECT_NEAR(7790 * read["volume_m3"].get<double>() / mass, 1, 1e-12);
  EXPECT_NEAR(read["element_step_s"]["value"].get<double>() / step, 1, 1e-9);
  EXPECT_GE(read["stable_step_s"], read["element_step_s"]["value"]);
}

TEST(ImportCommand, TakesTheMaterialForMassAndStep) {
  const Program program;
  const std::string file = program.write("bar.inp", abaqus_file()).string();
  const auto step = [&](const std::string& options) {
    EXPECT_EQ(program.call(fmt::format("import {} --unit mm --json {}", file, options)), 0)
        << program.errors();
    const json read = json::parse(program.out());
    return std::pair(read["element_step_s"]["value"].get<double>(), read["stable_step_s"].get<double>());
  };
  const auto steel = step("");
  const auto expect = [&](const std::string& options, double factor, double tolerance) {
    const auto [element, mesh] = step(options);
    EXPECT_NEAR(element / steel.first, factor, tolerance) << options;
    EXPECT_NEAR(mesh / steel.second, factor, tolerance) << options;
  };
  expect("--youngs-modulus \"823.6 GPa\"", 0.5, 1e-9);
  expect("--density \"31160 kg/m3\"", 2, 1e-9);
  // Without it the modulus is 1 / 1.346 of that at 0.3 under strain along one axis, 1 / 2.5 under pressure.
  expect("--poissons-ratio 0", 0.5 * (std::sqrt(1.346) + std::sqrt(2.5)),
         0.5 * (std::sqrt(2.5) - std::sqrt(1.346)));
  ASSERT_EQ(program.call(fmt::format("import {} --unit mm --density \"1000 kg/m3\"", file)), 0);
  EXPECT_TRUE(has(program.out(), "0.0024 kg of 1000 kg/m3")) << program.out();  // 30 by 10 by 8 mm
}

TEST(ImportCommand, RefusesAFaultWithItsLineAndElement) {
  const Program program;
  std::string text = abaqus_file();
  text.replace(text.find("101, 102, 106"), 13, "101, 102, 906");
  const std::string file = program.write("bar.inp", text).string();
  EXPECT_EQ(program.call(fmt::format("import {} --unit mm --json", file)), 2);
  const json answer = json::parse(program.out());
  EXPECT_FALSE(answer["ok"].get<bool>());
  ASSERT_EQ(answer["problems"].size(), 1U);
  EXPECT_EQ(answer["problems"][0]["message"], "element 11: the file has no node 906");
  EXPECT_EQ(answer["problems"][0]["line"], 43);
  EXPECT_TRUE(has(program.errors(), "bar.inp:43: element 11: the file has no node 906")) << program.errors();
}

TEST(ImportCommand, RefusesOptionsThatItCannotUse) {
  const Program program;
  const std::string file = program.write("bar.inp", abaqus_file()).string();
  const auto refusal = [&](const std::string& options) {
    EXPECT_EQ(program.call(fmt::format("import {} {}", file, options)), 2) << options;
    return program.errors();
  };
  EXPECT_TRUE(has(refusal(""), "--unit"));
  EXPECT_TRUE(has(refusal("--unit kg"), "--unit kg: "));
  EXPECT_TRUE(has(refusal("--unit mm --pieces 0"), "--pieces"));
  EXPECT_TRUE(
      has(refusal("--unit mm --part middle"), "there is no part \"middle\" with hexahedra; there are"));
  EXPECT_TRUE(has(refusal("--unit mm --density \"0 kg/m3\""), "--density 0 kg/m3: must be above 0"));
  EXPECT_TRUE(has(refusal("--unit mm --poissons-ratio 0.5"), "--poissons-ratio 0.5"));
}

}  // namespace
}  // namespace tread
