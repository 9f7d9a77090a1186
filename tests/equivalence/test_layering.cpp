// What the folders may include: core <- kernels, core <- io, both <- drivers; some libraries in one place
// only.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace tread {
namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file;  ///< relative to the repository
  std::string target;
};

std::vector<Include> includes_of(const std::string& folder) {
  std::vector<Include> includes;
  const fs::path root = TREAD_SOURCE_DIR;
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".cpp" && extension != ".hpp" && extension != ".in") continue;
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

TEST(Layering, FoldersIncludeOnlyWhatStandsBelowThem) {
  const std::map<std::string, std::set<std::string>> allowed = {
      {"core", {"core"}},
      {"kernels", {"core", "kernels"}},
      {"io", {"core", "io"}},
      {"drivers", {"core", "kernels", "io", "drivers"}},
  };
  for (const auto& [folder, below] : allowed) {
    const auto includes = includes_of(folder);
    EXPECT_GT(includes.size(), 10U) << folder;
    for (const Include& include : includes) {
      const std::string target = first_folder(include.target);
      if (kFolders.count(target) > 0) {
        EXPECT_TRUE(below.count(target) > 0) << include.file << " includes " << include.target;
      }
    }
  }
}

TEST(Layering, OwnHeadersAreNamedFromTheRoot) {
  const fs::path root = TREAD_SOURCE_DIR;
  for (const std::string folder : {"core", "kernels", "io", "drivers", "tests"})
    for (const Include& include : includes_of(folder))
      if (kFolders.count(first_folder(include.target)) > 0) {
        EXPECT_TRUE(fs::exists(root / include.target)) << include.file << " includes " << include.target;
      }
}

TEST(Layering, LibrariesStayInTheirFolders) {
  const std::map<std::string, std::set<std::string>> homes = {
      {"hdf5.h", {"io"}},
      {"toml++/toml.h", {"io"}},
      {"CLI/CLI.hpp", {"drivers"}},
  };
  for (const std::string folder : {"core", "kernels", "io", "drivers"})
    for (const Include& include : includes_of(folder)) {
      const auto home = homes.find(include.target);
      if (home != homes.end()) {
        EXPECT_TRUE(home->second.count(folder) > 0) << include.file << " includes " << include.target;
      }
      if (first_folder(include.target) == "Eigen") {
        EXPECT_EQ(folder, "kernels") << include.file << " includes " << include.target;
      }
    }
}

TEST(Layering, ThreadLibrariesStandBehindTheOneInterface) {
  const std::string interface = "core/parallel_";
  for (const std::string folder : {"core", "kernels", "io", "drivers"})
    for (const Include& include : includes_of(folder)) {
      const bool inside = include.file.compare(0, interface.size(), interface) == 0;
      const std::string top = first_folder(include.target);
      if (include.target == "omp.h" || top == "oneapi" || top == "tbb") {
        EXPECT_TRUE(inside) << include.file << " includes " << include.target;
      }
      if (include.target == "core/parallel_backend.hpp") {
        EXPECT_TRUE(inside || include.file == "core/parallel.cpp") << include.file;
      }
    }
}

TEST(Layering, PragmasForThreadsStandInTheOneInterface) {
  const fs::path root = TREAD_SOURCE_DIR;
  for (const std::string folder : {"core", "kernels", "io", "drivers"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      if (entry.path() == root / "core/parallel_openmp.cpp") continue;
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);)
        EXPECT_FALSE(line.find("#pragma omp") != std::string::npos && line.find("simd") == std::string::npos)
            << entry.path() << ": " << line;
    }
}

}  // namespace
}  // namespace tread
