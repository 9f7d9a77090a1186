// `tread compare` beside a run, and `tread export` of its scene, as users call them.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "io/files/history_reader.hpp"
#include "tests/program_test.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using namespace samples;
using nlohmann::json;

class CompareCommand : public ProgramTest {
 protected:
  static void SetUpTestSuite() {
    make_root();
    ASSERT_EQ(call(fmt::format("run {} -t 1 --quiet -o {} --set \"scene.element_size=8 mm\" --set "
                               "output.frames=0 --set \"motion.duration=1 ms\"",
                               shell_word(kTyre), folder().string())),
              0)
        << errors();
  }
  static fs::path folder() { return root_ / "run"; }
  static fs::path curve() { return root_ / "curve.txt"; }

  /// The run's own F_N, 2 kN higher.
  static void write_curve() {
    const auto columns =
        read_history(folder() / "histories.csv", {{"wheel_x", "m"}, {"vertical_force", "N"}});
    std::ofstream file(curve());
    file << "# x [m]  F_N [kN]\n";
    for (std::size_t i = 0; i < columns[0].size(); ++i)
      file << fmt::format("{} {}\n", columns[0][i], 1e-3 * columns[1][i] + 2);
  }
};

TEST_F(CompareCommand, SetsACurveBesideARun) {
  write_curve();
  ASSERT_EQ(call(fmt::format("compare {} {} --json", folder().string(), curve().string())), 0) << errors();
  const json found = json::parse(output());
  EXPECT_EQ(found["run_done"], true);
  EXPECT_NEAR(found["rms_difference_N"].get<double>(), 2000, 0.01);
  EXPECT_NEAR(found["curve_N"]["mean"].get<double>() - found["run_N"]["mean"].get<double>(), 2000, 0.01);
  EXPECT_EQ(json::parse(content_of(folder() / "compare.json")), found);
  EXPECT_TRUE(has(content_of(folder() / "compare.html"), "Root mean square of the difference"));
  EXPECT_TRUE(fs::exists(folder() / "figures/compare.svg"));
  EXPECT_EQ(call(fmt::format("results {}", folder().string())), 0) << errors();
}

TEST_F(CompareCommand, SetsTheLongitudinalForceBesideARun) {
  const auto columns =
      read_history(folder() / "histories.csv", {{"wheel_x", "m"}, {"longitudinal_force", "N"}});
  const fs::path pull = root_ / "pull.txt";
  std::ofstream file(pull);
  file << "# x [m]  F_L [N]\n";
  for (std::size_t i = 0; i < columns[0].size(); ++i)
    file << fmt::format("{} {}\n", columns[0][i], columns[1][i] - 300);
  file.close();
  const std::string command = fmt::format("compare {} {}", folder().string(), pull.string());
  ASSERT_EQ(call(command + " --force F_L --json"), 0) << errors();
  const json found = json::parse(output());
  EXPECT_EQ(found["force"], "F_L");
  EXPECT_NEAR(found["rms_difference_N"].get<double>(), 300, 0.01);
  EXPECT_TRUE(has(content_of(folder() / "compare.html"), "Mean F<sub>L</sub>"));
  EXPECT_EQ(call(command), 2);
  EXPECT_TRUE(has(errors(), "pull.txt: the file holds F_L, the run's F_N is compared; state --force F_L"))
      << errors();
}

TEST_F(CompareCommand, WritesElsewhereIfTold) {
  write_curve();
  const fs::path other = root_ / "other";
  ASSERT_EQ(call(fmt::format("compare {} {} --mean 7mm -o {}", folder().string(), curve().string(),
                             other.string())),
            0)
      << errors();
  EXPECT_TRUE(has(output(), "averaged over 7 mm"));
  EXPECT_TRUE(fs::exists(other / "compare.html"));
}

/// An order to go on, as a killed run leaves it.
TEST_F(CompareCommand, SaysThatARunIsNotDone) {
  write_curve();
  const fs::path killed = root_ / "killed";
  fs::copy(folder(), killed, fs::copy_options::recursive);
  fs::create_directory(killed / "checkpoint");
  std::ofstream(killed / "checkpoint/order.h5") << "order";
  const std::string command = fmt::format("compare {} {}", killed.string(), curve().string());
  ASSERT_EQ(call(command), 0) << errors();
  EXPECT_TRUE(has(output(), " samples of a run that is not done\n")) << output();
  EXPECT_EQ(json::parse(content_of(killed / "compare.json"))["run_done"], false);
  EXPECT_EQ(call(command + " --from 5m"), 2);
  EXPECT_TRUE(has(errors(), "; the run is not done: `tread resume ")) << errors();
  fs::remove(killed / "histories.csv");
  EXPECT_EQ(call(command), 2);
  EXPECT_TRUE(has(errors(), "it has not rolled yet; the run is not done: `tread resume ")) << errors();
}

TEST_F(CompareCommand, NamesWhatIsWrong) {
  write_curve();
  const auto refused = [&](const std::string& arguments, const std::string& reason) {
    EXPECT_EQ(call(fmt::format("compare {} {}", folder().string(), arguments)), 2) << arguments;
    EXPECT_TRUE(has(errors(), reason)) << errors();
  };
  refused(curve().string() + " --offset 1s", "--offset \"1s\"");
  refused(curve().string() + " --offset 5m", "move the curve by --offset");
  refused(curve().string() + " --mean -1mm", "--mean \"-1mm\" is negative");
  refused(curve().string() + " --from 5m", "--from 5 m leaves too little");
  refused(curve().string() + " --mean 10m", "--mean 10 m leaves too little");
  refused(curve().string() + " --from 2mm --to 1mm", "--from \"2mm\" is not before --to \"1mm\"");
  refused((root_ / "none.txt").string(), "cannot read");
  refused((folder() / "histories.csv").string(), "columns; leave the others out");
  EXPECT_EQ(call(fmt::format("compare {} {}", (root_ / "absent").string(), curve().string())), 2);
  EXPECT_TRUE(has(errors(), "there is no folder")) << errors();
  EXPECT_EQ(call(fmt::format("compare {} {}", root_.string(), curve().string())), 2);
  EXPECT_TRUE(has(errors(), root_.string() + ": it is no run's folder")) << errors();

  const fs::path still = root_ / "static";
  ASSERT_EQ(call(fmt::format("run {} -t 1 --quiet -o {} --set \"scene.element_size=8 mm\"",
                             scene_word("sphere-on-block.toml"), still.string())),
            0)
      << errors();
  EXPECT_EQ(call(fmt::format("compare {} {}", still.string(), curve().string())), 2);
  EXPECT_TRUE(has(errors(), still.string() + ": a run without [motion] has no histories")) << errors();
}

TEST_F(CompareCommand, AndExportStatesUnitsAndDifferences) {
  const fs::path deck = root_ / "tyre.k";
  ASSERT_EQ(call(fmt::format("export {} -t 1 -o {} --set \"scene.element_size=8 mm\"", shell_word(kTyre),
                             deck.string())),
            0)
      << errors();
  EXPECT_TRUE(has(output(), "mm, ms, kg, kN, GPa"));
  EXPECT_TRUE(has(output(), "Preload: none."));
  EXPECT_TRUE(has(content_of(deck), "$ Units: mm, ms, kg, kN, GPa."));
  EXPECT_EQ(call(fmt::format("export {} -o {} --ramp 3kg", shell_word(kTyre), deck.string())), 2);
  EXPECT_TRUE(has(errors(), "--ramp 3kg: \"3kg\" is a mass")) << errors();
  EXPECT_EQ(call(fmt::format("export {} -o {}", shell_word(kTyre), (root_ / "none" / "tyre.k").string())), 4);
}

}  // namespace
}  // namespace tread
