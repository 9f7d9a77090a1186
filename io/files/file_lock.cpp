#include "io/files/file_lock.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <limits>
#include <utility>

#include "core/error.hpp"

namespace tread {

namespace {

ResourceError refusal(const char* action, const std::filesystem::path& path, int error, const char* way_out) {
  return ResourceError(
      fmt::format("cannot {} {}: {}{}", action, path.string(), std::strerror(error), way_out));
}

int opened(const std::filesystem::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (descriptor < 0) throw refusal("open", path, errno, "");
  return descriptor;
}

/// Returns true if an attempt failed because another holder has the lock. Throws for any other error.
bool is_taken(int error, const std::filesystem::path& path) {
  if (error == EAGAIN || error == EACCES) return true;
  throw refusal("lock", path, error, "; choose a folder on another file system");
}

}  // namespace

std::optional<FileLock> FileLock::try_folder(const std::filesystem::path& folder) {
  FileLock lock(opened(folder, O_RDONLY | O_DIRECTORY));
  if (::flock(lock.descriptor_, LOCK_EX | LOCK_NB) != 0 && is_taken(errno, folder)) return std::nullopt;
  return lock;
}

std::optional<FileLock> FileLock::try_number(const std::filesystem::path& file, std::uint64_t number) {
  FileLock lock(opened(file, O_RDWR | O_CREAT | O_NOFOLLOW));
  struct flock range {};
  range.l_type = F_WRLCK;
  range.l_whence = SEEK_SET;
  range.l_start = static_cast<off_t>(number % static_cast<std::uint64_t>(std::numeric_limits<off_t>::max()));
  range.l_len = 1;
  // The lock belongs to the open file, not to the process: two locks of one process exclude one another, too.
  if (::fcntl(lock.descriptor_, F_OFD_SETLK, &range) != 0 && is_taken(errno, file)) return std::nullopt;
  return lock;
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace tread
