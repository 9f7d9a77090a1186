// Includes of the floors, absence of cycles among them, and libraries that are included in one place only.
// [architecture.md, Floors]

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace tread {
namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file;  ///< path relative to the repository
  std::string target;
};

std::vector<Include> includes_of(const std::string& folder) {
  std::vector<Include> includes;
  const fs::path root = TREAD_SOURCE_DIR;
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".cpp" && extension != ".hpp" && extension != ".cu" && extension != ".in") continue;
    std::ifstream file(entry.path());
    std::smatch match;
    for (std::string line; std::getline(file, line);)
      if (std::regex_search(line, match, pattern))
        includes.push_back({fs::relative(entry.path(), root).string(), match[1].str()});
  }
  return includes;
}

std::string first_folder(const std::string& target) {
  const auto slash = target.find('/');
  return slash == std::string::npos ? "" : target.substr(0, slash);
}

const std::set<std::string> kFolders = {"core", "kernels", "io", "drivers", "tests", "perf"};

/// A floor of the house and the floors that it may include beside itself.
struct Floor {
  std::string folder;
  std::vector<std::string> below;
};

const std::vector<Floor> kFloors = {
    {"core", {}},
    {"kernels", {"core"}},
    {"io", {"core"}},
    {"drivers/engine", {"core", "kernels"}},
    {"drivers/process", {"core"}},
    {"drivers/results", {"core", "kernels", "io", "drivers/engine", "drivers/process"}},
    {"drivers/report", {"core", "kernels", "io", "drivers/engine", "drivers/process", "drivers/results"}},
    {"drivers/run",
     {"core", "kernels", "io", "drivers/engine", "drivers/process", "drivers/results", "drivers/report"}},
    {"drivers/studies",
     {"core", "kernels", "io", "drivers/engine", "drivers/process", "drivers/results", "drivers/report",
      "drivers/run"}},
    {"drivers/verify", {"core", "kernels", "io", "drivers/engine", "drivers/process", "drivers/results"}},
    {"drivers/bench",
     {"core", "kernels", "io", "drivers/engine", "drivers/process", "drivers/results", "drivers/report",
      "drivers/run"}},
    {"drivers/cli",
     {"core", "kernels", "io", "drivers/engine", "drivers/process", "drivers/results", "drivers/report",
      "drivers/run", "drivers/studies", "drivers/verify", "drivers/bench"}},
};

bool lies_in(const std::string& path, const std::string& folder) {
  return path.starts_with(folder + "/");
}

TEST(Layering, FloorsIncludeOnlyWhatStandsBelowThem) {
  for (const Floor& floor : kFloors) {
    const auto includes = includes_of(floor.folder);
    EXPECT_GT(includes.size(), 10U) << floor.folder;
    for (const Include& include : includes) {
      if (kFolders.count(first_folder(include.target)) == 0 || lies_in(include.target, floor.folder))
        continue;
      EXPECT_TRUE(std::any_of(floor.below.begin(), floor.below.end(),
                              [&](const std::string& below) { return lies_in(include.target, below); }))
          << include.file << " includes " << include.target;
    }
  }
}

TEST(Layering, EveryFolderOfDriversIsAFloor) {
  for (const auto& entry : fs::directory_iterator(fs::path(TREAD_SOURCE_DIR) / "drivers")) {
    if (!entry.is_directory()) continue;
    const std::string folder = "drivers/" + entry.path().filename().string();
    EXPECT_TRUE(std::any_of(kFloors.begin(), kFloors.end(), [&](const Floor& floor) {
      return floor.folder == folder;
    })) << folder;
  }
}

/// Includes among the repository's files, by `key` of includer and included.
template <class Key>
std::map<std::string, std::set<std::string>> include_graph(const Key& key) {
  std::map<std::string, std::set<std::string>> graph;
  for (const std::string folder : {"core", "kernels", "io", "drivers"})
    for (const Include& include : includes_of(folder))
      if (kFolders.count(first_folder(include.target)) > 0 && key(include.file) != key(include.target))
        graph[key(include.file)].insert(key(include.target));
  return graph;
}

/// A path that leads back to its start; empty if there is none.
std::vector<std::string> cycle_in(const std::map<std::string, std::set<std::string>>& graph) {
  std::set<std::string> done;
  std::vector<std::string> way;
  const std::function<bool(const std::string&)> visit = [&](const std::string& node) {
    const bool met = std::find(way.begin(), way.end(), node) != way.end();
    way.push_back(node);
    if (met) return true;
    if (done.insert(node).second && graph.count(node) > 0)
      for (const std::string& next : graph.at(node))
        if (visit(next)) return true;
    way.pop_back();
    return false;
  };
  for (const auto& [node, targets] : graph)
    if (visit(node)) return way;
  return {};
}

TEST(Layering, IncludesFormNoCycle) {
  const auto unit = [](const std::string& path) { return fs::path(path).replace_extension().string(); };
  const auto folder = [](const std::string& path) { return fs::path(path).parent_path().string(); };
  EXPECT_EQ(cycle_in(include_graph(unit)), std::vector<std::string>{});
  EXPECT_EQ(cycle_in(include_graph(folder)), std::vector<std::string>{});
}

TEST(Layering, ACycleIsFound) {
  EXPECT_EQ(cycle_in({{"a", {"b"}}, {"b", {"c", "d"}}, {"d", {"b"}}}).size(), 4U);
  EXPECT_TRUE(cycle_in({{"a", {"b", "c"}}, {"b", {"c"}}}).empty());
}

TEST(Layering, StudiesAndVerificationAreSeenByCommandsAlone) {
  for (const std::string own : {"drivers/verify", "drivers/studies/paper", "drivers/bench"})
    for (const Include& include : includes_of("drivers"))
      if (lies_in(include.target, own)) {
        EXPECT_TRUE(lies_in(include.file, own) || lies_in(include.file, "drivers/cli"))
            << include.file << " includes " << include.target;
      }
}

/// Lines of a file without comments.
std::vector<std::string> code_of(const fs::path& path) {
  std::vector<std::string> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) lines.push_back(line.substr(0, line.find("//")));
  return lines;
}

/// Values and names of the paper are data of the library's scene (share/references) and of studies/paper.
TEST(Layering, ThePaperStaysOutOfEngineRunsAndReports) {
  const std::regex paper(R"(paper[^'"]|highspeed|\b(193\.19|87\.56|0\.276|0\.265|8\.9e-8)\b)",
                         std::regex::icase);
  const fs::path root = TREAD_SOURCE_DIR;
  EXPECT_TRUE(std::regex_search("rows.push_back({\"Creepage\", 0.276});", paper));
  for (const std::string floor : {"engine", "results", "report", "run"})
    for (const auto& entry : fs::recursive_directory_iterator(root / "drivers" / floor))
      for (const std::string& line : code_of(entry.path()))
        EXPECT_FALSE(std::regex_search(line, paper)) << entry.path() << ": " << line;
}

TEST(Layering, OwnHeadersAreNamedFromTheRoot) {
  const fs::path root = TREAD_SOURCE_DIR;
  for (const std::string folder : {"core", "kernels", "io", "drivers", "tests"})
    for (const Include& include : includes_of(folder))
      if (kFolders.count(first_folder(include.target)) > 0) {
        EXPECT_TRUE(fs::exists(root / include.target)) << include.file << " includes " << include.target;
      }
}

/// Targets that begin with `target` are included in files whose path begins with one of these alone.
struct Home {
  std::string target;
  std::vector<std::string> files;
};

/// [architecture.md, Dependencies and why]
const std::vector<Home> kHomes = {
    {"CLI/", {"drivers/cli/"}},
    {"Eigen/", {"kernels/", "tests/"}},
    {"core/parallel/parallel_backend.hpp", {"core/parallel/parallel_", "core/parallel/parallel.cpp"}},
    {"cuda", {"kernels/device/"}},
    {"gtest/", {"tests/"}},
    {"hdf5.h", {"io/files/hdf5_", "tests/"}},
    {"metis.h", {"drivers/engine/"}},
    {"mpi.h", {"drivers/process/mpi_ranks.cpp"}},
    {"nlohmann/",  // not in drivers/engine, which has no files
     {"io/", "drivers/results/", "drivers/report/", "drivers/run/", "drivers/studies/", "drivers/verify/",
      "drivers/bench/", "drivers/cli/", "tests/"}},
    {"nlohmann/json_fwd.hpp", {"io/"}},
    {"omp.h", {"core/parallel/parallel_"}},
    {"oneapi/", {"core/parallel/parallel_"}},
    {"tbb/", {"core/parallel/parallel_"}},
    {"toml++/", {"io/scene/"}},
};

TEST(Layering, LibrariesStayInTheirFolders) {
  for (const std::string folder : {"core", "kernels", "io", "drivers", "tests"})
    for (const Include& include : includes_of(folder))
      for (const Home& home : kHomes) {
        if (!include.target.starts_with(home.target)) continue;
        EXPECT_TRUE(std::any_of(home.files.begin(), home.files.end(),
                                [&](const std::string& file) { return include.file.starts_with(file); }))
            << include.file << " includes " << include.target;
      }
}

TEST(Layering, PragmasForThreadsStandInTheOneInterface) {
  const fs::path root = TREAD_SOURCE_DIR;
  for (const std::string folder : {"core", "kernels", "io", "drivers"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      if (entry.path() == root / "core/parallel/parallel_openmp.cpp") continue;
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);)
        EXPECT_FALSE(line.find("#pragma omp") != std::string::npos && line.find("simd") == std::string::npos)
            << entry.path() << ": " << line;
    }
}

}  // namespace
}  // namespace tread
