#include "io/files/file_identity.hpp"

#include <fcntl.h>
#include <sys/stat.h>

namespace tread {

namespace {

std::optional<std::pair<std::uint64_t, std::uint64_t>> device_and_number(const std::filesystem::path& path) {
  struct stat found = {};
  if (::stat(path.c_str(), &found) != 0) return std::nullopt;
  return std::pair<std::uint64_t, std::uint64_t>(found.st_dev, found.st_ino);
}

}  // namespace

FileIdentity::FileIdentity(std::filesystem::path path)
    : path_(std::move(path)), known_(device_and_number(path_)) {}

bool FileIdentity::in_place() const {
  return known_ && device_and_number(path_) == known_;
}

bool leads_to(int folder, const char* path, int descriptor) {
  struct stat open = {}, named = {};
  return ::fstat(descriptor, &open) == 0 && ::fstatat(folder, path, &named, AT_SYMLINK_NOFOLLOW) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

}  // namespace tread
