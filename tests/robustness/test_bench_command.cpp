// `tread bench` as a user calls it. Nothing here judges a time: machines that run tests are busy.

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "io/text/json.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;

class Bench : public testing::Test {
 protected:
  /// Exit code; what it prints is left in `file`.
  int call(const std::string& arguments, const std::string& file = "out") const {
    const std::string command = fmt::format("{} bench {} >{} 2>/dev/null", shell_word(TREAD_EXECUTABLE),
                                            arguments, (folder_ / file).string());
    return WEXITSTATUS(std::system(command.c_str()));
  }
  std::vector<JsonRecord> records(const std::string& file = "out") const {
    return read_json_lines(folder_ / file);
  }
  std::string path(const char* name) const { return (folder_ / name).string(); }

  samples::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path;
};

double number(const JsonRecord& record, const char* name) {
  return std::get<double>(record.at(name));
}
std::string text(const JsonRecord& record, const char* name) {
  return std::get<std::string>(record.at(name));
}

constexpr const char* kSmoke = "--repetitions 2 --run-seconds 0 --json";

constexpr const char* kAllButStream =
    "--kernel empty multiply_add internal_force force_and_motion hexahedra update tie_hand_over tie_follow "
    "contact_search contact_resolve "
    "surface_fields";

TEST_F(Bench, KernelsStateEveryKey) {
  ASSERT_EQ(call(fmt::format("kernels -t 1 --elements 3000 {} {}", kSmoke, kAllButStream)), 0);
  std::set<std::string> kernels;
  for (const JsonRecord& row : records()) {
    const std::string name = text(row, "kernel") + ", " + text(row, "path");
    kernels.insert(text(row, "kernel"));
    const std::string precision = text(row, "precision");
    EXPECT_TRUE(precision == "double" || precision == "mixed" || precision == "single") << name;
    EXPECT_EQ(text(row, "backend"), "tbb");
    EXPECT_FALSE(text(row, "lanes").empty());
    EXPECT_EQ(number(row, "threads"), 1);
    EXPECT_GT(number(row, "elements"), 0) << name;
    EXPECT_GT(number(row, "element_steps_per_s"), 0) << name;
    EXPECT_GE(number(row, "spread"), 0) << name;
    EXPECT_GT(number(row, "processor_share"), 0) << name;
    EXPECT_EQ(row.contains("counted_calls"), text(row, "kernel") != "multiply_add") << name;
    if (text(row, "kernel") == "empty") continue;
    EXPECT_GT(number(row, "gb_per_s") + number(row, "gflops"), 0) << name;
    EXPECT_GT(number(row, "fraction_of_limit"), 0) << name;
    EXPECT_LT(number(row, "fraction_of_limit"), 3) << name;
  }
  EXPECT_EQ(kernels.size(), 11U);
}

TEST_F(Bench, SeveralThreadsAreMeasuredByEveryBackend) {
  ASSERT_EQ(call(fmt::format("kernels -t 2 --elements 3000 {} --kernel update tie_follow", kSmoke)), 0);
  std::set<std::string> backends;
  for (const JsonRecord& row : records()) {
    backends.insert(text(row, "backend"));
    EXPECT_EQ(number(row, "threads"), 2);
  }
  EXPECT_EQ(backends, (std::set<std::string>{"openmp", "tbb"}));
}

TEST_F(Bench, KernelsRefuseUnknownNames) {
  EXPECT_EQ(call("kernels --kernel internal_forse"), 2);
  EXPECT_EQ(call("kernels --lanes avx1024"), 2);
  EXPECT_EQ(call("kernels --precision half"), 2);
  EXPECT_EQ(call("kernels --backend pthreads"), 2);
  EXPECT_EQ(call("kernels --elements 0"), 2);
}

TEST_F(Bench, CompareFindsWhatIsSlowerBeyondTheSpread) {
  const auto write = [&](const char* name, double rate, double spread, double of_limit = 0.4,
                         double instructions = 100) {
    std::ofstream(folder_ / name) << fmt::format(
        "{{\"kernel\": \"k\", \"path\": \"p\", \"precision\": \"double\", \"backend\": \"openmp\", "
        "\"lanes\": \"avx2\", \"threads\": 2, \"elements\": 10, \"element_steps_per_s\": {}, \"spread\": "
        "{}, \"fraction_of_limit\": {}, \"instructions_per_element_step\": {}}}\n",
        rate, spread, of_limit, instructions);
  };
  write("before", 100, 0.05);
  write("same", 96, 0.02);
  write("slow", 94, 0.02);
  write("noisy", 94, 0.1);
  write("wild", 85, 0.5);
  write("fast", 200, 0.01);
  write("wasteful", 200, 0.01, 0.3);
  write("uncounted", 100, 0.01, 0);
  for (const auto& [after, code] :
       {std::pair{"same", 0}, {"slow", 3}, {"noisy", 0}, {"wild", 3}, {"fast", 0}})
    EXPECT_EQ(call(fmt::format("compare {} {}", path("before"), path(after))), code) << after;
  for (const auto& [after, code] : {std::pair{"slow", 0}, {"wasteful", 3}, {"uncounted", 2}})
    EXPECT_EQ(call(fmt::format("compare --by limit {} {}", path("before"), path(after))), code) << after;
  write("longer", 200, 0.01, 0.4, 105);
  write("shorter", 50, 0.01, 0.1, 90);
  for (const auto& [after, code] : {std::pair{"slow", 0}, {"shorter", 0}, {"longer", 3}})
    EXPECT_EQ(call(fmt::format("compare --by instructions {} {}", path("before"), path(after))), code)
        << after;
  // Rows without rates, as perf/count_instructions.sh prints them.
  std::ofstream(folder_ / "counted")
      << R"({"kernel": "k", "path": "p", "precision": "double", "backend": "openmp", "lanes": "avx2", )"
      << R"("threads": 2, "elements": 10, "instructions_per_element_step": 102})" << '\n';
  EXPECT_EQ(call(fmt::format("compare --by instructions {} {}", path("before"), path("counted"))), 0);
  EXPECT_EQ(call(fmt::format("compare {} {}", path("counted"), path("before"))), 2);
  EXPECT_EQ(call(fmt::format("compare --by time {} {}", path("before"), path("same"))), 2);
  std::ofstream(folder_ / "other") << "{\"kernel\": \"k\"}\n";
  EXPECT_EQ(call(fmt::format("compare {} {}", path("before"), path("other"))), 2);
  EXPECT_EQ(call(fmt::format("compare {} {}", path("before"), path("none"))), 2);
}

TEST_F(Bench, CompareMissesKernelsThatAreGone) {
  const auto row = [](const char* kernel) {
    return fmt::format(
        "{{\"kernel\": \"{}\", \"path\": \"p\", \"precision\": \"double\", \"backend\": \"openmp\", "
        "\"lanes\": \"avx2\", \"threads\": 2, \"elements\": 10, \"element_steps_per_s\": 100, "
        "\"spread\": 0.02}}\n",
        kernel);
  };
  std::ofstream(folder_ / "both") << row("here") << row("gone");
  std::ofstream(folder_ / "one") << row("here");
  EXPECT_EQ(call(fmt::format("compare {} {}", path("both"), path("one"))), 3);
  EXPECT_EQ(call(fmt::format("compare --common {} {}", path("both"), path("one"))), 0);
  EXPECT_EQ(call(fmt::format("compare {} {}", path("one"), path("both"))), 0);
}

TEST_F(Bench, ScalingTellsWhereEfficiencyIsLost) {
  ASSERT_EQ(call(fmt::format("scaling -t 2 --elements 2000 {}", kSmoke)), 0);
  const auto rows = records();
  ASSERT_EQ(rows.size(), 6U);  // strong and weak: one thread, two by either backend
  for (const JsonRecord& row : rows) {
    const double lost = number(row, "lost_serial") + number(row, "lost_waiting") + number(row, "lost_slower");
    EXPECT_NEAR(number(row, "efficiency") + lost, 1, 1e-9);
    EXPECT_GT(number(row, "triad_ratio"), 0);
    EXPECT_GT(number(row, "processor_share"), 0);
    const bool weak = text(row, "kind") == "weak";
    const double alone = number(rows[weak ? 3 : 0], "seconds_per_step");
    const double ideal = alone / (weak ? 1 : number(row, "threads"));
    EXPECT_NEAR(number(row, "efficiency"), ideal / number(row, "seconds_per_step"), 1e-9);
  }
  EXPECT_EQ(number(rows[4], "elements"), 2 * number(rows[3], "elements"));
}

TEST_F(Bench, ScalingRefusesWhatChangesASceneWithoutOne) {
  for (const char* wrong : {"-q paper", "--precision single", "--set scene.quality=paper"})
    EXPECT_EQ(call(fmt::format("scaling -t 1 --elements 2000 {} {}", kSmoke, wrong)), 2) << wrong;
}

TEST_F(Bench, HotspotsCoverTheWholeStep) {
  ASSERT_EQ(call(fmt::format("hotspots {} -t 2 --quiet --steps 40 --set "
                             "\"scene.element_size=8 mm\" --set \"motion.duration=0.05 ms\" {}",
                             samples::scene_word("tyre.toml"), kSmoke)),
            0);
  double shares = 0;
  std::set<std::string> phases;
  for (const JsonRecord& row : records()) {
    phases.insert(text(row, "phase"));
    EXPECT_EQ(number(row, "repetitions"), 2);
    EXPECT_GT(number(row, "processor_share"), 0);
    EXPECT_GT(number(row, "seconds_per_step"), 0) << text(row, "phase");
    if (text(row, "phase") != "whole step") shares += number(row, "share");
    if (text(row, "phase") != "internal force") continue;
    EXPECT_GT(number(row, "bytes_per_step"), 0);
    EXPECT_GE(number(row, "imbalance"), 1);
    EXPECT_LE(number(row, "imbalance"), 2);
  }
  EXPECT_NEAR(shares, 1, 1e-9);
  EXPECT_EQ(phases.count("internal force"), 1U);
  EXPECT_EQ(phases.count("contact tractions"), 1U);
  EXPECT_EQ(phases.count("whole step"), 1U);
}

TEST_F(Bench, HotspotsOfADeviceAreNotJudgedByTheProcessor) {
  ASSERT_EQ(call(fmt::format("hotspots {} -t 2 --quiet --steps 20 --device emulated --set "
                             "\"scene.element_size=12 mm\" --set \"motion.duration=0.05 ms\" {}",
                             samples::scene_word("tyre.toml"), kSmoke)),
            0);
  const std::vector<JsonRecord> rows = records();
  for (const JsonRecord& row : rows) {
    if (row.count("phase") == 0) continue;  // copies and kernels
    EXPECT_EQ(text(row, "device"), "emulated");
    EXPECT_EQ(row.count("fraction_of_limit"), text(row, "phase") == "whole step" ? 1U : 0U);
  }
  EXPECT_GT(number(rows.at(rows.size() - 2), "fraction_of_limit"), 0);
}

TEST_F(Bench, RanksHoldEachElementOnceAndWhatIsSentIsReceived) {
  const auto ranks = [this](int count, const std::string& more) {
    return call(fmt::format("ranks {} -t 1 --ranks {} --set \"scene.element_size=8 mm\" {} {}",
                            samples::scene_word("tyre.toml"), count, more, kSmoke));
  };
  ASSERT_EQ(ranks(1, ""), 0);
  const double elements = number(records().front(), "elements");
  ASSERT_EQ(ranks(3, "--parts 2 0"), 0);
  double sum = 0, sent = 0, received = 0;
  for (const JsonRecord& row : records()) {
    sum += number(row, "elements");
    sent += number(row, "sent_B");
    received += number(row, "received_B");
    EXPECT_GT(number(row, "node_slots_of_others"), 0);
    EXPECT_EQ(number(row, "ranks_beside"), 2);
    EXPECT_GT(number(row, "predicted_seconds_per_step"), 0);
    EXPECT_EQ(row.count("seconds_per_step"), number(row, "rank") == 1 ? 0U : 1U);
  }
  EXPECT_EQ(records().size(), 3U);
  EXPECT_EQ(sum, elements);
  EXPECT_EQ(sent, received);
  EXPECT_GT(sent, 0);
  EXPECT_EQ(ranks(3, "--parts 3"), 2);
  EXPECT_EQ(ranks(1000, ""), 2);  // more than the mesh has pieces
}

TEST_F(Bench, TheMeanOfTimedPartsPredictsAllRanks) {
  ASSERT_EQ(call(fmt::format("ranks {} -t 1 --ranks 3 --parts 1 0 2 --set \"scene.element_size=8 mm\" {}",
                             samples::scene_word("tyre.toml"), kSmoke)),
            0);
  const auto rows = records();
  ASSERT_EQ(rows.size(), 3U);
  double mean = 0;  // of the ranks without contact
  for (const std::size_t rank : {1U, 2U}) {
    const double ratio =
        number(rows[rank], "seconds_per_step") / number(rows[rank], "predicted_seconds_per_step");
    EXPECT_NEAR(number(rows[rank], "deviation"), ratio - 1, 1e-9);
    mean += 0.5 * ratio;
  }
  EXPECT_NEAR(mean, 1, 1e-9);
}

TEST_F(Bench, RanksTakeTheRailWithItsCorrugation) {
  const auto cost = [this](const char* apply) {
    const std::string sine =
        "--set corrugation.kind=sine --set \"corrugation.wavelength=20 mm\" "
        "--set \"corrugation.depth=0.04 mm\" --set \"corrugation.width=30 mm\" "
        "--set \"corrugation.start=150 mm\" --set \"corrugation.length=40 mm\"";
    EXPECT_EQ(call(fmt::format("ranks {} -t 1 --ranks 1 --set \"scene.element_size=8 mm\" {} "
                               "--set corrugation.apply={} {}",
                               samples::scene_word("tyre.toml"), sine, apply, kSmoke)),
              0);
    return number(records().front(), "cost");
  };
  EXPECT_GT(cost("nodes"), cost("gap"));  // quads at moved nodes cost twice as much
}

}  // namespace
}  // namespace tread
