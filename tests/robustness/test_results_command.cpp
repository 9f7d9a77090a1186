// `tread results`, and the attributes by which a file of results says alone where it comes from.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "drivers/process/version.hpp"
#include "tests/program_test.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using namespace samples;
using nlohmann::json;

class ResultsCommand : public ProgramTest {
 protected:
  static void SetUpTestSuite() {
    make_root();
    ASSERT_EQ(call(run("run")), 0) << errors();
    // Warnings are no progress.
    EXPECT_TRUE(has(errors(), "[warning] ") && !has(errors(), "[preload] ")) << errors();
  }
  static std::string run(const std::string& name, const std::string& more = "") {
    return fmt::format("run {} -t 1 --quiet -o {} --set \"scene.element_size=8 mm\" --set output.frames=2 {}",
                       shell_word(kTyre), folder(name).string(), more);
  }
  static fs::path folder(const std::string& name) { return root_ / name; }
  static json listing(const std::string& name) {
    EXPECT_EQ(call(fmt::format("results {} --json", folder(name).string())), 0) << errors();
    return json::parse(output());
  }
  static json file_in(const json& listing, const std::string& name) {
    for (const json& file : listing["files"])
      if (file["name"] == name) return file;
    return {};
  }
  static json dataset_in(const json& file, const std::string& name) {
    for (const json& dataset : file["datasets"])
      if (dataset["name"] == name) return dataset;
    return {};
  }
};

TEST_F(ResultsCommand, EveryHdf5FileAndTheSummarySayWhereTheyComeFrom) {
  const json summary = json::parse(content_of(folder("run") / "summary.json"));
  ASSERT_EQ(call("version --json"), 0) << errors();
  const std::string commit = json::parse(output())["commit"];
  EXPECT_EQ(summary.value("commit", ""), commit);
  int files = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder("run"))) {
    const std::string ending = entry.path().extension();
    if (ending != ".h5" && ending != ".hdf") continue;
    ++files;
    const Hdf5Attributes attributes = Hdf5File::open_to_read(entry.path()).attributes("/");
    EXPECT_EQ(attributes.size(), commit.empty() ? 9U : 10U) << entry.path();
    for (const auto& [name, value] : attributes)
      std::visit([&, key = name](const auto& stated) { EXPECT_EQ(summary.at(key), json(stated)) << key; },
                 value);
  }
  EXPECT_EQ(files, 6);  // run, patch, surface, two frames and their mesh
  EXPECT_EQ(summary.at("version"), program_version());
  EXPECT_NEAR(summary.at("speed_m_per_s").get<double>(), 300 / 3.6, 1e-9);
  EXPECT_EQ(summary.at("friction_coefficient"), 0.5);
  for (const char* name : {"scene.resolved.toml", "status.json", "report.html"})
    EXPECT_TRUE(has(content_of(folder("run") / name), program_version())) << name;
  EXPECT_TRUE(has(content_of(folder("run") / "report.html"), "Provenance"));
}

TEST_F(ResultsCommand, FilesDatasetsAndUnitsAreListed) {
  const json all = listing("run");
  EXPECT_EQ(all["state"], "done");
  EXPECT_EQ(all["complete"], true);
  EXPECT_EQ(all["attributes"]["version"], program_version());
  const json pressure = dataset_in(file_in(all, "patch.h5"), "pressure");
  EXPECT_EQ(pressure["unit"], "Pa");
  EXPECT_EQ(pressure["type"], "float");
  EXPECT_EQ(pressure["shape"].size(), 3U);
  const json force = dataset_in(file_in(all, "histories.csv"), "vertical_force");
  EXPECT_EQ(force["unit"], "N");
  EXPECT_EQ(force["shape"][0], dataset_in(file_in(all, "run.h5"), "histories/vertical_force")["shape"][0]);
  EXPECT_EQ(file_in(all, "frames/")["content"], "2 frames, datasets of the last one");
  EXPECT_EQ(call("results " + folder("run").string()), 0) << errors();
  EXPECT_TRUE(has(output(), "State: done\n")) << output();
  EXPECT_TRUE(has(output(), "  pressure       ")) << output();
}

/// Each figure of the report is a picture and a table with units; --overwrite removes those of the former
/// run.
TEST_F(ResultsCommand, FiguresOfTheReportAreFiles) {
  const fs::path figures = folder("run") / "figures";
  const std::string listed = file_in(listing("run"), "figures/")["content"];
  const auto charts = {"creepage", "energy", "forces", "passage", "patch", "surface"};
  for (const char* name : charts) {
    EXPECT_TRUE(has(listed, name)) << listed;
    const std::string table = content_of(figures / (std::string(name) + ".csv"));
    EXPECT_TRUE(has(table.substr(0, table.find('\n')), " [m]")) << table.substr(0, 200);
    EXPECT_TRUE(content_of(figures / (std::string(name) + ".svg")).starts_with("<svg ")) << name;
  }
  for (const char* name :
       {"deflection", "mesh-sections", "mesh-side", "patch-instants", "patch-movie", "stick-slip"})
    EXPECT_TRUE(has(listed, name) && fs::exists(figures / (std::string(name) + ".csv"))) << listed;
  ASSERT_EQ(call(run("again")), 0) << errors();
  std::ofstream(folder("again") / "figures/old.svg")
      << "<svg></svg>\n<!-- figure old of a report of tread -->\n";
  std::ofstream(folder("again") / "figures/mine.svg") << "mine";
  ASSERT_EQ(call(run("again", "--overwrite")), 0) << errors();
  EXPECT_FALSE(fs::exists(folder("again") / "figures/old.svg"));
  EXPECT_EQ(content_of(folder("again") / "figures/mine.svg"), "mine");
}

/// Every file that a run leaves is listed, and the page of results names it.
TEST_F(ResultsCommand, NothingIsLeftOut) {
  const std::string page = content_of(fs::path(TREAD_SOURCE_DIR) / "docs/reference/results.md");
  std::set<std::string> left, listed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder("run")))
    left.insert(entry.path().filename().string() + (entry.is_directory() ? "/" : ""));
  const json all = listing("run");
  for (const json& file : all["files"]) {
    listed.insert(file["name"].get<std::string>());
    EXPECT_NE(file["content"], "") << file["name"];
    EXPECT_TRUE(has(page, fmt::format("`{}`", file["name"].get<std::string>()))) << file["name"];
  }
  EXPECT_EQ(left, listed);
}

TEST_F(ResultsCommand, AnUnfinishedRunNamesTheWayOn) {
  ASSERT_EQ(call(run("part", "--set stop.steps=700")), 4);
  const json all = listing("part");
  EXPECT_EQ(all["complete"], false);
  EXPECT_TRUE(has(all["state"], "tread resume " + folder("part").string())) << all["state"];
  EXPECT_TRUE(has(file_in(all, "checkpoint/")["content"], "states for `tread resume`"));
}

TEST_F(ResultsCommand, ARunThatIsKilledBehindItsResultsIsDone) {
  fs::copy(folder("run"), folder("killed"), fs::copy_options::recursive);
  const fs::path status = folder("killed") / "status.json";
  std::ofstream(status) << R"({"stage": "rolling", "command": "run", "time_s": 0.004, "duration_s": 0.004})";
  const json all = listing("killed");
  EXPECT_EQ(all["state"], "done");
  EXPECT_EQ(all["complete"], true);
  EXPECT_EQ(call("resume " + folder("killed").string()), 0) << errors();
  EXPECT_EQ(json::parse(content_of(status))["stage"], "done");
}

TEST_F(ResultsCommand, AFileThatCannotBeReadCostsItsDatasetsAlone) {
  fs::create_directory(folder("broken"));
  for (const char* name : {"run.h5", "summary.json", "status.json", "patch.h5"})
    fs::copy_file(folder("run") / name, folder("broken") / name);
  std::ofstream(folder("broken") / "patch.h5") << "no HDF5";
  const json all = listing("broken");
  EXPECT_TRUE(has(file_in(all, "patch.h5")["problem"], "cannot read"));
  EXPECT_FALSE(file_in(all, "run.h5")["datasets"].empty());
}

TEST_F(ResultsCommand, StudiesListTheirRuns) {
  fs::create_directories(folder("study"));
  fs::create_directory_symlink(folder("run"), folder("study") / "point");
  std::ofstream(folder("study") / "status.json")
      << R"({"stage": "ended", "waiting": 0, "interrupted": 0, "running": 0, "done": 1, "failed": 2})";
  const json all = listing("study");
  EXPECT_EQ(all["state"], "ended: 1 done, 2 failed");
  EXPECT_EQ(all["complete"], false);
  EXPECT_EQ(all["runs"][0]["name"], "point");
  EXPECT_EQ(all["runs"][0]["state"], "done");
}

/// `tread compare` and `tread roughness` leave no status.
TEST_F(ResultsCommand, ResultsWithoutAStatusAreDone) {
  for (const char* only : {"compare.json", "levels.csv"}) {
    const std::string name = fmt::format("with-{}", only);
    fs::create_directory(folder(name));
    for (const char* file : {only, "compare.html", "development.json", "dial.jsonl"})
      std::ofstream(folder(name) / file) << "{}\n";
    const json all = listing(name);
    EXPECT_EQ(all["state"], "done") << only;
    EXPECT_EQ(all["complete"], true) << only;
    EXPECT_EQ(all["files"].size(), 4U) << all;
  }
}

TEST_F(ResultsCommand, FoldersWithoutResultsAreRefused) {
  EXPECT_EQ(call("results " + folder("absent").string()), 2);
  EXPECT_TRUE(has(errors(), "there is no folder")) << errors();
  fs::create_directory(folder("empty"));
  std::ofstream(folder("empty") / "notes.txt") << "mine";
  EXPECT_EQ(call("results --json " + folder("empty").string()), 2);
  EXPECT_TRUE(has(errors(), "holds no results: give the folder")) << errors();
  EXPECT_TRUE(has(output(), "\"ok\": false")) << output();
}

}  // namespace
}  // namespace tread
