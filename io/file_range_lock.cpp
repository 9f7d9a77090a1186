#include "io/file_range_lock.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <limits>
#include <utility>

#include "core/error.hpp"

namespace tread {

std::optional<FileRangeLock> FileRangeLock::try_take(const std::filesystem::path& file,
                                                     std::uint64_t number) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor < 0)
    throw ResourceError(fmt::format("cannot open {}: {}", file.string(), std::strerror(errno)));
  struct flock range {};
  range.l_type = F_WRLCK;
  range.l_whence = SEEK_SET;
  range.l_start = static_cast<off_t>(number % static_cast<std::uint64_t>(std::numeric_limits<off_t>::max()));
  range.l_len = 1;
  // Of the open file, not of the process: two locks of one process exclude one another, too.
  if (::fcntl(descriptor, F_OFD_SETLK, &range) == 0) return FileRangeLock(descriptor);
  const int error = errno;
  ::close(descriptor);
  if (error == EACCES || error == EAGAIN) return std::nullopt;
  throw ResourceError(fmt::format("cannot lock {}: {}; choose a folder on another file system", file.string(),
                                  std::strerror(error)));
}

FileRangeLock::FileRangeLock(FileRangeLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileRangeLock::~FileRangeLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace tread
