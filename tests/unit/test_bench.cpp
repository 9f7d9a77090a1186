// Counts, measurements and files of `tread bench`.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/bench/counted.hpp"
#include "drivers/bench/limits.hpp"
#include "drivers/bench/made_up_blocks.hpp"
#include "drivers/bench/measurement.hpp"
#include "drivers/bench/work.hpp"
#include "drivers/process/core_watch.hpp"
#include "io/text/json.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/element/element_body.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

std::int64_t operations(const std::function<void()>& body) {
  const std::int64_t before = Counted::operations();
  body();
  return Counted::operations() - before;
}

TEST(Counted, CountsWhatTheElementBodyDoes) {
  // Differences of the quad's diagonals, their sums, and those of both diagonals.
  Counted s[4] = {1, 2, 3, 4};
  Counted d[4] = {5, 6, 7, 8};
  Counted a[kModes] = {};
  EXPECT_EQ(operations([&] { to_modes(s, d, a); }), 4 + 4 + 3);
  EXPECT_EQ(operations([&] { from_modes(a, s, d); }), 4 + 2 + 4);
  // Each of four values that turn needs two products and a sum.
  Counted x[3] = {1, 2, 3};
  Counted y[3] = {4, 5, 6};
  EXPECT_EQ(operations([&] { turn_to_middle(Counted(0.8), Counted(0.6), x, y); }), 12);
}

TEST(ElementWork, GrowsWithWhatTheElementDoes) {
  const Mesh mesh = made_up_mesh(Sweep::extruded, false, 8000);
  const SweptBlock& block = mesh.blocks.front();
  const Work plain = element_work({}, block, {8, 8});
  const Work damped = element_work({Sweep::extruded, true, false, false}, block, {8, 8});
  const Work turning = element_work({Sweep::revolved, false, true, false}, block, {8, 8});
  const Work perturbed = element_work({Sweep::extruded, false, false, true}, block, {8, 8});
  const Work vertical = element_work({.vertical_only = true}, block, {8, 8});
  EXPECT_GT(plain.flops, 200);
  EXPECT_LT(plain.flops, 350);
  EXPECT_GT(turning.flops, plain.flops);
  EXPECT_GT(perturbed.flops, 1.5 * plain.flops);
  // A slot moves 24 B each: displacement in, force fetched, force out, with damping velocity in. A node moves
  // a shift and its index, a quad a mark.
  const double slots = static_cast<double>(block.slots()) / static_cast<double>(block.elements());
  EXPECT_DOUBLE_EQ(plain.bytes, 72 * slots);
  EXPECT_DOUBLE_EQ(damped.bytes, 96 * slots);
  // A third of the displacement in, all forces out.
  EXPECT_DOUBLE_EQ(vertical.bytes, 56 * slots);
  EXPECT_LT(vertical.flops, 0.4 * plain.flops);
  EXPECT_DOUBLE_EQ(perturbed.bytes - plain.bytes, 24.5 * slots + 0.125);
  EXPECT_DOUBLE_EQ(element_work({}, block, {4, 4}).bytes, 36 * slots);
}

TEST(MadeUpBlocks, HaveTheWantedSize) {
  for (const std::int64_t elements : {2000, 30000})
    for (const Sweep sweep : {Sweep::extruded, Sweep::revolved})
      EXPECT_NEAR(static_cast<double>(made_up_mesh(sweep, false, elements).blocks.front().elements()),
                  static_cast<double>(elements), 300);
  const MadeUpTie tied = made_up_tie(10000);
  EXPECT_GT(Ties(tied.mesh, {tied.tie}).secondary_count(), 400);
}

TEST(Measurement, TakesTheMedianAndTheSpread) {
  const Measurement odd = summarise({3, 1, 2}, 1);
  EXPECT_EQ(odd.seconds, 2);
  EXPECT_EQ(odd.spread, 1);
  EXPECT_EQ(odd.fastest, 1);
  EXPECT_EQ(summarise({4, 1, 2, 3}, 1).seconds, 2.5);
  int calls = 0;
  int resets = 0;
  const Measurement measured = measure({[&] { ++calls; }, [&] { ++resets; }}, {3, 0});
  EXPECT_EQ(calls, 4);
  EXPECT_EQ(resets, 4);
  EXPECT_EQ(measured.repetitions, 3);
}

TEST(CoreWatch, SeesThreadsThatWait) {
  set_threads(2);
  const CoreWatch cores;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_LT(cores.share(), 0.6);
  EXPECT_EQ(busy_cores_text(0.7), "");
  EXPECT_EQ(busy_cores_text(0.4), "2 threads work 40 % of the time: other programs use the cores");
  set_threads(1);
  EXPECT_EQ(busy_cores_text(0.4), "the thread works 40 % of the time: other programs use the cores");
}

TEST(Limits, AreThoseOfTheFasterBackend) {
  set_threads(2);
  const std::string_view chosen = backend(), widest = InternalForce::instruction_sets().front();
  Limits limits({1, 0});
  const double limit = limits.of({1, 0, 0}, true, widest).seconds;
  EXPECT_EQ(backend(), chosen);
  std::vector<double> seconds;
  for (const std::string_view name : backends()) {
    set_backend(name);
    seconds.push_back(limits.operation(true, widest).seconds);
  }
  EXPECT_EQ(limit, std::ranges::min(seconds));
  set_backend(chosen);
  set_threads(1);
}

class JsonLines : public testing::Test {
 protected:
  std::vector<JsonRecord> read(const std::string& text) {
    std::ofstream(path_) << text;
    return read_json_lines(path_);
  }
  samples::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path / "lines.json";
};

TEST_F(JsonLines, ReadsWhatTheCommandsPrint) {
  const auto records = read("{\"a\": 1.5e-3, \"b\": \"x\\\"y\", \"c\": true, \"d\": null}\n\n{}\n");
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(std::get<double>(records[0].at("a")), 1.5e-3);
  EXPECT_EQ(std::get<std::string>(records[0].at("b")), "x\"y");
  EXPECT_TRUE(std::get<bool>(records[0].at("c")));
  EXPECT_EQ(records[0].count("d"), 0U);
}

TEST_F(JsonLines, NamesTheLineThatItCannotRead) {
  for (const char* wrong : {"{\"a\": 1", "{\"a\" 1}", "{\"a\": [1]}", "{\"a\": 1} x", "[1]", "{\"a\": \"x}",
                            "{\"a\": 1,}", "{\"a\": nul}"}) {
    try {
      read(fmt::format("{{}}\n{}\n", wrong));
      ADD_FAILURE() << wrong;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(":2:"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace tread
