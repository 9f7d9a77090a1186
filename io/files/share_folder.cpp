#include "io/files/share_folder.hpp"

#include <algorithm>
#include <cstdlib>
#include <system_error>

namespace tread {

namespace fs = std::filesystem;

std::string stated_share() {
  const char* stated = std::getenv("TREAD_SHARE");
  return stated != nullptr ? stated : "";
}

std::vector<fs::path> share_folders() {
  if (const std::string stated = stated_share(); !stated.empty()) return {stated};
  std::vector<fs::path> folders;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) folders.push_back(program.parent_path().parent_path() / "share" / "tread");
  if (const fs::path source = TREAD_SOURCE_SHARE; !source.empty()) folders.push_back(source);
  return folders;
}

namespace {

std::vector<fs::path> scene_folders() {
  std::vector<fs::path> folders;
  for (const fs::path& folder : share_folders()) folders.push_back(folder / "scenes");
  if (!stated_share().empty()) {  // an installed folder, or share/ of a source tree
    folders.push_back((fs::absolute(stated_share()) / ".." / "scenes").lexically_normal());
    return folders;
  }
  if (const fs::path source = TREAD_SOURCE_SHARE; !source.empty())
    folders.push_back(source.parent_path() / "scenes");
  return folders;
}

/// Names of the TOML files in a folder beneath those of the scenes, in alphabetical order.
std::vector<std::string> shipped_in(const fs::path& below) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::path& folder : scene_folders())
    for (const fs::directory_entry& file : fs::directory_iterator(folder / below, ignored))
      if (file.path().extension() == ".toml") names.push_back((below / file.path().stem()).string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::vector<std::string> shipped_scenes() {
  return shipped_in({});
}

std::vector<std::string> shipped_studies() {
  return shipped_in("studies");
}

fs::path find_scene(const fs::path& stated) {
  std::error_code ignored;
  const bool there = fs::exists(stated, ignored) && !fs::is_directory(stated, ignored);
  if (there || stated.empty() || stated.is_absolute()) return stated;
  for (const fs::path& folder : scene_folders())
    for (const char* ending : {"", ".toml"})
      if (fs::path file = folder / (stated.string() + ending); fs::is_regular_file(file, ignored))
        return file;
  return stated;
}

fs::path find_share_file(const fs::path& name) {
  for (const fs::path& folder : share_folders()) {
    std::error_code ignored;
    if (fs::is_regular_file(folder / name, ignored)) return folder / name;
  }
  return {};
}

}  // namespace tread
