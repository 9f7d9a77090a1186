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
#include "io/files/file_identity.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

/// Name of a folder's lock file, which stays empty.
constexpr const char* kFolderLock = ".lock";

ResourceError refusal(const char* action, const fs::path& path, int error, const char* way_out) {
  return ResourceError(
      fmt::format("cannot {} {}: {}{}", action, path.string(), std::strerror(error), way_out));
}

int opened(const fs::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (descriptor < 0) throw refusal("open", path, errno, "");
  return descriptor;
}

/// Returns true if an attempt failed because another holder has the lock. Throws for any other error.
bool is_taken(int error, const fs::path& path) {
  if (error == EAGAIN || error == EACCES) return true;
  throw refusal("lock", path, error, "; choose a folder on another file system");
}

/// Opens the lock file in an open folder; -1 where that cannot be.
int open_folder_lock(int folder, int flags) {
  return ::openat(folder, kFolderLock, flags | O_NOFOLLOW | O_CLOEXEC, 0666);
}

/// Returns true if the open lock file of a folder has lost its name: the next holder would lock another file.
bool is_removed(int folder, int descriptor) {
  return !leads_to(folder, kFolderLock, descriptor);
}

/// Request for the lock of one byte. The lock belongs to the open file, not to the process: two locks of one
/// process exclude one another, too.
struct flock byte_lock(std::uint64_t number) {
  struct flock range {};
  range.l_type = F_WRLCK;
  range.l_whence = SEEK_SET;
  range.l_start = static_cast<off_t>(number % static_cast<std::uint64_t>(std::numeric_limits<off_t>::max()));
  range.l_len = 1;
  return range;
}

}  // namespace

std::optional<FileLock> FileLock::try_directory(const fs::path& folder) {
  FileLock lock(opened(folder, O_RDONLY | O_DIRECTORY));
  if (::flock(lock.descriptor_, LOCK_EX | LOCK_NB) != 0 && is_taken(errno, folder)) return std::nullopt;
  return lock;
}

std::optional<FileLock> FileLock::try_folder(const fs::path& folder) {
  std::optional<FileLock> lock = try_directory(folder);
  if (!lock || !lock->share()) return std::nullopt;
  return lock;
}

bool FileLock::share() {
  // Network file systems keep locks of directories for each machine alone, those of files for all machines.
  const bool missing = ::faccessat(descriptor_, kFolderLock, F_OK, AT_SYMLINK_NOFOLLOW) != 0;
  FileLock file(open_folder_lock(descriptor_, O_RDWR | O_CREAT));
  if (file.descriptor_ < 0) return true;
  struct flock byte = byte_lock(0);
  if (::fcntl(file.descriptor_, F_OFD_SETLK, &byte) != 0 && (errno == EAGAIN || errno == EACCES))
    return false;
  if (is_removed(descriptor_, file.descriptor_)) return false;
  shared_ = std::exchange(file.descriptor_, -1);
  made_ = missing;
  return true;
}

bool FileLock::is_held(const fs::path& folder) {
  const FileLock directory(opened(folder, O_RDONLY | O_DIRECTORY));
  const FileLock look(open_folder_lock(directory.descriptor_, O_RDONLY));
  struct flock byte = byte_lock(0);
  const bool on_some_machine = ::fcntl(look.descriptor_, F_OFD_GETLK, &byte) == 0 && byte.l_type != F_UNLCK;
  return on_some_machine || !try_directory(folder);
}

std::optional<FileLock> FileLock::try_number(const fs::path& file, std::uint64_t number) {
  FileLock lock(opened(file, O_RDWR | O_CREAT | O_NOFOLLOW));
  struct flock byte = byte_lock(number);
  if (::fcntl(lock.descriptor_, F_OFD_SETLK, &byte) != 0 && is_taken(errno, file)) return std::nullopt;
  return lock;
}

FileLock::FileLock(FileLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      shared_(std::exchange(other.shared_, -1)),
      made_(std::exchange(other.made_, false)) {}

FileLock::~FileLock() {
  if (made_) ::unlinkat(descriptor_, kFolderLock, 0);
  for (const int descriptor : {descriptor_, shared_})
    if (descriptor >= 0) ::close(descriptor);
}

}  // namespace tread
