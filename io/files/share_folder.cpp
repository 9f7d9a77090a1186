#include "io/files/share_folder.hpp"

#include <cstdlib>
#include <system_error>

namespace tread {

namespace fs = std::filesystem;

std::vector<fs::path> share_folders() {
  if (const char* stated = std::getenv("TREAD_SHARE"); stated && *stated != '\0') return {stated};
  std::vector<fs::path> folders;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) folders.push_back(program.parent_path().parent_path() / "share" / "tread");
  folders.emplace_back(TREAD_SOURCE_SHARE);
  return folders;
}

fs::path find_share_file(const fs::path& name) {
  for (const fs::path& folder : share_folders()) {
    std::error_code ignored;
    if (fs::is_regular_file(folder / name, ignored)) return folder / name;
  }
  return {};
}

}  // namespace tread
