// Preloads that are kept between runs: the same bits, and no failure of the cache ends a run.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "drivers/run/run_folder.hpp"
#include "io/files/content_cache.hpp"
#include "io/files/file_lock.hpp"
#include "io/text/json.hpp"
#include "tests/program_test.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using namespace samples;

class PreloadCache : public ProgramTest {
 protected:
  static void SetUpTestSuite() { make_root(); }
  void TearDown() override { fs::remove_all(cache_); }

  std::string run(const char* folder, const std::string& more = "", int threads = 1) const {
    return run_with(cache_, folder, "--set \"motion.duration=0.2 ms\" " + more, threads);
  }
  static std::string run_with(const fs::path& cache, const char* folder, const std::string& more,
                              int threads = 1) {
    return fmt::format("run {} --overwrite -t {} -o {}/{} --cache {} --set \"scene.element_size=8 mm\" {}",
                       shell_word(kTyre), threads, root_.string(), folder, cache.string(), more);
  }
  std::vector<ContentCache::Entry> entries() const { return ContentCache(cache_, 0).entries(); }
  static bool found() { return has(errors(), "[preload] found by an earlier run"); }

  fs::path cache_ = root_ / "cache";
};

TEST_F(PreloadCache, LeavesTheBitsAlone) {
  ASSERT_EQ(call(run_with("off", "without", "--set \"motion.duration=0.2 ms\"")), 0) << errors();
  EXPECT_TRUE(entries().empty());
  ASSERT_EQ(call(run("first", "", 2)), 0) << errors();
  EXPECT_FALSE(found());
  EXPECT_EQ(entries().size(), 1U);
  ASSERT_EQ(call(run("second")), 0) << errors();
  EXPECT_TRUE(found()) << errors();
  EXPECT_TRUE(has(content_of(root_ / "second/summary.json"), "\"preload_cached\": true"));
  // The cost of the scene is that of solving, not that of finding.
  const auto cost = [&](const char* run) {
    return number_in(read_json(root_ / run / "summary.json"), "preload_s");
  };
  EXPECT_GT(cost("first"), 0);
  EXPECT_EQ(cost("second"), cost("first"));
  expect_same_run(root_ / "without", root_ / "first");
  expect_same_run(root_ / "without", root_ / "second");
}

TEST_F(PreloadCache, ServesWhatActsOnRollingAloneAndNothingElse) {
  ASSERT_EQ(call(run("first")), 0) << errors();
  for (const char* same : {"--set contact.friction=0.31", "--set motion.traction.mu=0.1",
                           "--set \"output.history_interval=5 us\"",
                           "--set \"corrugation.start=0.1 m\" --set \"corrugation.length=0.1 m\"",
                           "--set \"forks.at=0.1 ms\""}) {
    EXPECT_EQ(call(run("same", same)), 0) << errors();
    EXPECT_TRUE(found()) << same;
  }
  EXPECT_EQ(entries().size(), 1U);
  for (const char* other :
       {"--set \"motion.speed=299 km/h\"", "--set \"load.wheel_load=87 kN\"",
        "--set \"motion.duration=0.21 ms\"", "--set \"wheel.lateral_offset=1 mm\"",
        "--set wheel.material=soft --set \"material.soft.youngs_modulus=70 GPa\" "
        "--set material.soft.poissons_ratio=0.3 --set \"material.soft.density=7790 kg/m3\"",
        "--set wheel.material=soft --set \"material.soft.youngs_modulus=71 GPa\" "
        "--set material.soft.poissons_ratio=0.3 --set \"material.soft.density=7790 kg/m3\""}) {
    EXPECT_EQ(call(run("other", other)), 0) << errors();
    EXPECT_FALSE(found()) << other;
  }
  EXPECT_EQ(entries().size(), 7U);
}

/// Along which the mesh is fine.
TEST_F(PreloadCache, ServesTractionThatAddsLittleToTheWay) {
  const auto slow = [&](const char* mu) {
    return run_with(cache_, mu,
                    fmt::format("--set \"motion.speed=1 m/s\" --set \"motion.duration=100 ms\" --set "
                                "stop.steps=1 --set motion.traction.mu={}",
                                mu));
  };
  call(slow("0"));
  EXPECT_EQ(entries().size(), 1U) << errors();
  call(slow("0.001"));
  EXPECT_TRUE(found()) << errors();
  call(slow("0.02"));
  EXPECT_FALSE(found()) << errors();
  EXPECT_EQ(entries().size(), 2U);
}

TEST_F(PreloadCache, OfAStaticSceneAndOfAWheelThatHasBeenRolling) {
  const std::string rolling = fmt::format(
      "run {} -t 1 -o {}/{{}} --cache {} --set \"scene.element_size=8 mm\" --set "
      "\"motion.duration=0.05 ms\" --set slab.present=false --set \"rail.length=5.2 m\" --set "
      "\"rail.origin=2.6 m\" "
      "--set fastenings.count=8 --set \"fastenings.first=0.325 m\" --set \"solution_zone.start=20 mm\" --set "
      "\"solution_zone.length=50 mm\" --set \"output.history_interval=5 us\"",
      scene_word("smooth.toml"), root_.string(), cache_.string());
  for (const char* folder : {"still1", "still2"})
    ASSERT_EQ(call(run_with(cache_, folder, "--set motion.present=false")), 0) << errors();
  EXPECT_TRUE(found());
  EXPECT_EQ(figures(root_ / "still1"), figures(root_ / "still2"));
  for (const char* folder : {"roll1", "roll2"})
    ASSERT_EQ(call(fmt::format(fmt::runtime(rolling), folder)), 0) << errors();
  EXPECT_TRUE(found());
  expect_same_run(root_ / "roll1", root_ / "roll2");
}

TEST_F(PreloadCache, ADamagedEntryIsSolvedAgain) {
  ASSERT_EQ(call(run("first")), 0) << errors();
  const fs::path entry = entries().front().path;
  const auto size = fs::file_size(entry);
  std::fstream(entry, std::ios::in | std::ios::out | std::ios::binary).seekp(5000).put('x');
  ASSERT_EQ(call(run("second")), 0) << errors();
  EXPECT_FALSE(found());
  EXPECT_TRUE(has(errors(), "is damaged") && has(errors(), "solved again")) << errors();
  EXPECT_EQ(fs::file_size(entry), size);
  ASSERT_EQ(call(run("third")), 0) << errors();
  EXPECT_TRUE(found());
  expect_same_run(root_ / "first", root_ / "third");
}

TEST_F(PreloadCache, AFolderThatCannotBeWrittenEndsNothing) {
  std::ofstream(root_ / "file") << "no folder\n";
  ASSERT_EQ(call(run_with(root_ / "file/cache", "first", "--set \"motion.duration=0.2 ms\"")), 0) << errors();
  EXPECT_TRUE(has(errors(), "not kept for later runs: cannot create")) << errors();
  ASSERT_EQ(call(run("first"), "export TREAD_CACHE_LIMIT=often;"), 2);
  EXPECT_TRUE(has(errors(), "TREAD_CACHE_LIMIT")) << errors();
}

TEST_F(PreloadCache, ALimitOfNothingEmptiesNothing) {
  ASSERT_EQ(call(run("first")), 0) << errors();
  for (const char* limit : {"-4GB", "-1 GB", "0 GB", "0"}) {
    ASSERT_EQ(call(run("second"), fmt::format("export TREAD_CACHE_LIMIT='{}';", limit)), 2) << limit;
    EXPECT_TRUE(has(errors(), fmt::format("TREAD_CACHE_LIMIT: \"{}\"", limit))) << errors();
  }
  EXPECT_EQ(entries().size(), 1U);
}

TEST_F(PreloadCache, APreloadBeyondTheLimitEmptiesNothing) {
  ASSERT_EQ(call(run("first")), 0) << errors();
  ASSERT_EQ(call(run("second", "--set \"motion.speed=299 km/h\""), "export TREAD_CACHE_LIMIT='10 kB';"), 0);
  EXPECT_TRUE(has(errors(), "not kept for later runs: it has ")) << errors();
  EXPECT_EQ(entries().size(), 1U);
}

TEST_F(PreloadCache, TwoProcessesAtOnce) {
  const pid_t one = start(run("one"));
  const pid_t other = start(run("other"));
  EXPECT_EQ(wait_for(one), 0);
  EXPECT_EQ(wait_for(other), 0);
  expect_same_run(root_ / "one", root_ / "other");
  EXPECT_EQ(entries().size(), 1U);
  for (const fs::directory_entry& file : fs::directory_iterator(cache_))
    EXPECT_NE(file.path().extension(), ".part") << file.path();
  EXPECT_TRUE(has(content_of(root_ / "one/summary.json"), "\"preload_cached\": true") !=
              has(content_of(root_ / "other/summary.json"), "\"preload_cached\": true"));
}

/// The key of another scene is another claim; one that was killed claims nothing any more.
TEST_F(PreloadCache, AProcessWaitsForTheOneThatSolvesItsPreload) {
  ASSERT_EQ(call(run("known")), 0) << errors();
  // The entry's name is the key's hash, which is all that a claim is about.
  const fs::path entry = entries().front().path;
  const std::uint64_t number = std::stoull(entry.stem().string(), nullptr, 16);
  const fs::path hidden = cache_ / "hidden";
  fs::rename(entry, hidden);
  const pid_t holder = child([&] {
    const auto claim = FileLock::try_number(cache_ / "claims.lock", number);
    std::ofstream(root_ / "held") << "x";
    if (claim) ::pause();
  });
  ASSERT_TRUE(wait_until([&] { return fs::exists(root_ / "held"); }));
  EXPECT_FALSE(FileLock::try_number(cache_ / "claims.lock", number));
  EXPECT_TRUE(FileLock::try_number(cache_ / "claims.lock", number + 1));
  EXPECT_EQ(call(run("elsewhere", "--set \"load.wheel_load=87 kN\"")), 0) << errors();
  EXPECT_FALSE(has(errors(), "another process solves it")) << errors();

  const pid_t waiting = start(run("waiting"));
  ASSERT_TRUE(wait_until([&] { return has(errors(), "another process solves it"); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_FALSE(has(errors(), "[step]")) << errors();
  fs::rename(hidden, entry);
  ::kill(holder, SIGKILL);
  wait_for(holder);
  EXPECT_EQ(wait_for(waiting), 0);
  EXPECT_TRUE(found()) << errors();
  expect_same_run(root_ / "known", root_ / "waiting");
}

TEST_F(PreloadCache, AStopIsObeyedWhileAnotherProcessSolves) {
  ASSERT_EQ(call(run("known")), 0) << errors();
  const fs::path entry = entries().front().path;
  const auto claim =
      FileLock::try_number(cache_ / "claims.lock", std::stoull(entry.stem().string(), nullptr, 16));
  ASSERT_TRUE(claim);
  fs::remove(entry);
  const pid_t waiting = start(run("stopped"));
  ASSERT_TRUE(wait_until([&] { return has(errors(), "another process solves it"); }));
  leave_request(root_ / "stopped", RunRequest::stop);
  EXPECT_EQ(wait_for(waiting), 75);
  EXPECT_TRUE(has(errors(), "stopped before the first step")) << errors();
  EXPECT_TRUE(has(content_of(root_ / "stopped/status.json"), "\"stopped\""));
}

TEST_F(PreloadCache, IsShownAndCleared) {
  const std::string at = fmt::format("export XDG_CACHE_HOME={}; unset TREAD_CACHE;", cache_.string());
  ASSERT_EQ(call(fmt::format("run {} -t 1 -o {}/usual --set \"scene.element_size=8 mm\" --set "
                             "\"motion.duration=0.05 ms\"",
                             shell_word(kTyre), root_.string()),
                 at),
            0)
      << errors();
  EXPECT_EQ(call("cache show", at), 0);
  EXPECT_TRUE(has(output(), fmt::format("{}/tread: 1 preloads, ", cache_.string())) &&
              has(output(), "4.00 GB"))
      << output();
  EXPECT_TRUE(has(output(), "  used ") && has(output(), " ago\n")) << output();
  const fs::path entry = ContentCache(cache_ / "tread", 0).entries().front().path;
  fs::last_write_time(entry, fs::file_time_type::clock::now() + std::chrono::hours(1));
  EXPECT_EQ(call("cache show", at), 0);
  EXPECT_TRUE(has(output(), "used when the clock was ahead\n")) << output();
  EXPECT_EQ(call("cache show --json", at), 0);
  EXPECT_TRUE(has(output(), "\"unused_s\": null")) << output();
  EXPECT_EQ(call("cache clear", at), 0);
  EXPECT_TRUE(has(output(), "0 preloads, 0 B")) << output();
  EXPECT_EQ(call("cache show --cache off"), 0);
  EXPECT_TRUE(has(output(), "is off")) << output();
}

TEST(ContentCache, UsesToComeAreTheOldest) {
  const samples::TemporaryFolder temporary;
  const SealedContent content = {{"values", std::vector<double>(1000, 1.5)}};
  const ContentCache unbounded(temporary.path, 1 << 30);
  for (const char* key : {"a", "b"}) unbounded.store(key, content);
  for (const ContentCache::Entry& entry : unbounded.entries())
    fs::last_write_time(entry.path, entry.used + std::chrono::hours(1));
  const std::int64_t bytes = unbounded.entries().front().bytes;
  const ContentCache bounded(temporary.path, 2 * bytes + bytes / 2);
  std::string refused;
  for (const char* key : {"c", "d", "e"}) {
    bounded.store(key, content);
    EXPECT_EQ(bounded.entries().size(), 2U);
    EXPECT_TRUE(bounded.find(key, refused)) << key;
  }
  EXPECT_TRUE(bounded.find("d", refused));
}

TEST(ContentCache, RemovesWhatHasNotBeenUsedForLongest) {
  const samples::TemporaryFolder temporary;
  const fs::path& folder = temporary.path;
  const SealedContent content = {{"values", std::vector<double>(1000, 1.5)}};
  ContentCache unbounded(folder, 1 << 30);
  std::string refused;
  EXPECT_FALSE(unbounded.find("a", refused));
  for (const char* key : {"a", "b", "c"}) unbounded.store(key, content);
  std::ofstream(folder / "notes.txt") << "of somebody else\n";
  std::ofstream(folder / "0123456789abcdef.h5.part") << "of a process that was killed\n";
  ASSERT_EQ(unbounded.entries().size(), 3U);
  const std::int64_t bytes = unbounded.entries().front().bytes;
  for (const ContentCache::Entry& entry : unbounded.entries())
    fs::last_write_time(entry.path, entry.used - std::chrono::hours(1));
  EXPECT_TRUE(unbounded.find("a", refused));  // used now, b and c an hour ago
  ContentCache bounded(folder, 2 * bytes + bytes / 2);
  bounded.store("d", content);
  EXPECT_EQ(bounded.entries().size(), 2U);
  EXPECT_TRUE(bounded.find("a", refused) && bounded.find("d", refused));
  EXPECT_FALSE(bounded.find("b", refused) || bounded.find("c", refused));
  EXPECT_EQ(bounded.find("a", refused), content);
  EXPECT_THROW(ContentCache(folder, bytes / 2).store("e", content), ResourceError);
  EXPECT_EQ(bounded.entries().size(), 2U);
  for (const fs::directory_entry& file : fs::directory_iterator(folder))
    EXPECT_NE(file.path().extension(), ".part") << file.path();
  bounded.clear();
  bounded.store("a", content);
  // Another question with the same hash gets no answer: here by putting the file in its place.
  const fs::path entry = bounded.entries().front().path;
  bounded.store("b", content);
  fs::copy_file(entry, bounded.entries().front().path, fs::copy_options::overwrite_existing);
  EXPECT_FALSE(bounded.find("b", refused));
  EXPECT_EQ(refused, "");
  bounded.clear();
  EXPECT_TRUE(bounded.entries().empty());
  EXPECT_TRUE(fs::exists(folder / "notes.txt"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace tread
