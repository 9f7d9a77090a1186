#pragma once
// Tests that run the program as users do, and compare the results of its runs.

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "io/files/hdf5_file.hpp"
#include "tests/program.hpp"

namespace tread::samples {

namespace fs = std::filesystem;

/// Values of the summary besides times and the origin of the start.
inline std::string figures(const fs::path& folder) {
  std::istringstream lines(content_of(folder / "summary.json"));
  std::string kept;
  bool origin = false;
  for (std::string line; std::getline(lines, line);) {
    origin = has(line, "\"fork\": {") || (origin && !has(line, "}"));
    const bool of_start = origin || line == "  }," || has(line, "\"preload_cached\"");
    const bool of_process = (has(line, "_s\": ") && !has(line, "dt_s")) || has(line, "\"threads\"") ||
                            has(line, "\"commit\"");  // runs within a test state none
    if (!of_start && !of_process) kept += line + "\n";
  }
  return kept;
}

inline void expect_same_file(const fs::path& a, const fs::path& b) {
  const Hdf5File one = Hdf5File::open_to_read(a);
  const Hdf5File other = Hdf5File::open_to_read(b);
  auto attributes = one.attributes("/"), others = other.attributes("/");
  for (auto* of : {&attributes, &others}) of->erase("commit");  // runs within a test state none
  EXPECT_EQ(attributes, others);
  ASSERT_EQ(one.datasets(), other.datasets());
  for (const std::string& name : one.datasets()) {
    ASSERT_EQ(one.shape(name), other.shape(name)) << name;
    EXPECT_EQ(one.read<double>(name), other.read<double>(name)) << name;
  }
}

/// Frames in a folder; none without a folder of frames.
inline std::vector<std::string> frames_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "frames", none))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

inline void expect_same_run(const fs::path& a, const fs::path& b) {
  for (const char* name : {"histories.csv", "surface_axis.csv", "deflection.csv", "frames.hdf.series"})
    EXPECT_TRUE(content_of(a / name) == content_of(b / name)) << name;
  for (const char* name : {"run.h5", "patch.h5", "surface.h5"}) expect_same_file(a / name, b / name);
  EXPECT_EQ(frames_in(a), frames_in(b));
  for (const std::string& name : frames_in(a)) expect_same_file(a / "frames" / name, b / "frames" / name);
  EXPECT_EQ(figures(a), figures(b));
  EXPECT_FALSE(fs::exists(b / "checkpoint"));
}

inline const std::string kTyre = fs::path(TREAD_SOURCE_DIR) / "scenes/tyre.toml";

/// A folder for the runs of a test suite, and the program.
class ProgramTest : public testing::Test {
 protected:
  static void TearDownTestSuite() { fs::remove_all(root_); }
  static void make_root() {
    fs::remove_all(root_);  // left by a process of the same number that was killed
    fs::create_directories(root_);
  }
  static std::string errors() { return content_of(root_ / "errors"); }
  static std::string output() { return content_of(root_ / "out"); }

  /// Starts the program; its output goes to files.
  static pid_t start(const std::string& arguments, const std::string& before = "") {
    return start_program(arguments, root_, "export TREAD_CACHE=off; " + before);
  }
  static int call(const std::string& arguments, const std::string& before = "") {
    return wait_for(start(arguments, before));
  }

  static inline fs::path root_ = fs::path(testing::TempDir()) / fmt::format("tread_{}", ::getpid());
};

}  // namespace tread::samples
