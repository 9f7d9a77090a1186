#include "io/files/absolute_path.hpp"

#include <system_error>

namespace tread {

namespace fs = std::filesystem;

fs::path absolute_path(const fs::path& path) {
  const fs::path stated = fs::absolute(path);
  fs::path result;
  for (const fs::path& part : stated) {
    std::error_code ignored;
    if (part == ".." && fs::is_symlink(result, ignored) && fs::is_directory(result, ignored))
      result = fs::canonical(result);
    if (part == "..")
      result = result.parent_path();
    else if (part != "." && !part.empty())
      result /= part;
  }
  return result;
}

}  // namespace tread
