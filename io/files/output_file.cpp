#include "io/files/output_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "io/files/file_identity.hpp"

namespace tread {

namespace {

/// "; make room there, or choose another disk"; empty for an error without a known remedy.
const char* remedy_of(int error) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return "; make its folder, or choose another";
    case EACCES:
    case EPERM:
    case EROFS:
      return "; change the permissions of its folder, or choose another";
    case ENOSPC:
    case EDQUOT:
      return "; make room there, or choose another disk";
    case EFBIG:
      return "; a larger `ulimit -f` allows it";
    case EMFILE:
      return "; a larger `ulimit -n` allows it";
    case ENAMETOOLONG:
      return "; choose a shorter name";
    case EISDIR:
      return "; choose the name of a file";
    default:
      return "";
  }
}

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw ResourceError(
      fmt::format("cannot write {}: {}{}", path.string(), std::strerror(error), remedy_of(error)));
}

void require_created(const std::filesystem::path& folder, const std::error_code& error) {
  std::error_code ignored;
  const std::filesystem::file_status there = std::filesystem::status(folder, ignored);
  if (std::filesystem::exists(there) && !std::filesystem::is_directory(there))
    throw ResourceError(fmt::format("cannot create {0}: a file of that name is there; remove or rename {0}",
                                    folder.string()));
  if (error)
    throw ResourceError(
        fmt::format("cannot create {}: {}{}", folder.string(), error.message(), remedy_of(error.value())));
}

/// Opens the file; an error names `shown`.
int open_or_fail(const std::filesystem::path& path, int flags, const std::filesystem::path& shown) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(shown, errno);
  return descriptor;
}

/// Writes all bytes; returns 0 or the errno of the write that failed.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Result of fsync for a file or folder: 0 or an errno.
int sync(const std::filesystem::path& path) {
  const int descriptor = open_or_fail(path, O_RDONLY, path);
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  return error;
}

/// Neighbour of a file in a folder whose files are all the program's.
std::filesystem::path part_of(std::filesystem::path path) {
  path += ".part";
  return path;
}

/// "NAME.tread.part", "NAME.tread-2.part": NAME is cut so that each name that the folder bears has a
/// neighbour.
std::filesystem::path neighbour_of(const std::filesystem::path& path, int number) {
  const std::string ending = number > 1 ? fmt::format(".tread-{}.part", number) : ".tread.part";
  const std::filesystem::path folder = path.parent_path();
  const long limit = ::pathconf(folder.empty() ? "." : folder.c_str(), _PC_NAME_MAX);  // [B]
  std::string name = path.filename().string();
  if (std::size_t room = static_cast<std::size_t>(limit) - ending.size(); limit > 0 && name.size() > room) {
    // Not within a character:
    while (room > 0 && (static_cast<unsigned char>(name[room]) & 0xC0U) == 0x80) --room;
    name.resize(room);
  }
  return folder / (name + ending);
}

/// Calls `write` with the path of the neighbour and renames that file to `path`. Removes the neighbour if
/// either fails.
void rename_finished(const std::filesystem::path& path, const std::filesystem::path& part,
                     const std::function<void(const std::filesystem::path& part)>& write) {
  try {
    write(part);
    if (::rename(part.c_str(), path.c_str()) != 0) fail(path, errno);
  } catch (...) {
    ::unlink(part.c_str());
    throw;
  }
}

}  // namespace

void replace_file(const std::filesystem::path& path,
                  const std::function<void(const std::filesystem::path& part)>& write) {
  replace_file(path, part_of(path), write);
}

void replace_file(const std::filesystem::path& path, const std::filesystem::path& part,
                  const std::function<void(const std::filesystem::path& part)>& write) {
  rename_finished(path, part, [&](const std::filesystem::path& written) {
    write(written);
    if (const int error = sync(written)) fail(path, error);
  });
  const std::filesystem::path folder = path.parent_path();
  if (const int error = sync(folder.empty() ? "." : folder)) fail(path, error);
}

Neighbour::Neighbour(const std::filesystem::path& path) {
  std::error_code ignored;
  for (int number = 1;;) {
    path_ = neighbour_of(path, number);
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) fail(path, errno);
    const bool made = descriptor_ >= 0;
    if (!made) descriptor_ = ::open(path_.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    const bool locked = descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
    // On a file system without locks nobody takes a new file for one that was left.
    const bool lockless = made && !locked && errno != EWOULDBLOCK;
    const bool here = (locked || lockless) && leads_to(AT_FDCWD, path_.c_str(), descriptor_) &&
                      std::filesystem::is_regular_file(path_, ignored);
    if (made && here) return;
    const bool removed = here && ::unlink(path_.c_str()) == 0;
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
    if (!made && !removed) ++number;
  }
}

Neighbour::~Neighbour() {
  ::close(descriptor_);
}

void force_to_disk(const std::filesystem::path& path) {
  if (const int error = sync(path)) fail(path, error);
}

void create_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  require_created(folder, error);
}

void make_directory(const std::filesystem::path& directory) {
  try {
    create_folder(directory);
  } catch (const ResourceError& error) {
    throw ResourceError(fmt::format("{}; -o names another", error.what()));
  }
}

void create_last_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  require_created(folder, error);
}

void write_text(const std::filesystem::path& path, std::string_view text,
                const std::filesystem::path& shown) {
  GrowingFile file(path, shown);
  file.append(text);
  file.close();
}

void write_text_file(const std::filesystem::path& path, std::string_view text) {
  replace_file(path, [&](const std::filesystem::path& part) { write_text(part, text, path); });
}

void show_text_file(const std::filesystem::path& path, std::string_view text) {
  rename_finished(path, part_of(path),
                  [&](const std::filesystem::path& part) { write_text(part, text, path); });
}

GrowingFile::GrowingFile(const std::filesystem::path& path) : GrowingFile(path, path) {}

GrowingFile::GrowingFile(const std::filesystem::path& path, std::filesystem::path shown)
    : path_(std::move(shown)), descriptor_(open_or_fail(path, O_WRONLY | O_CREAT | O_TRUNC, path_)) {}

GrowingFile::~GrowingFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void GrowingFile::append(std::string_view piece) {
  if (const int error = write_all(descriptor_, piece)) {
    if (::ftruncate(descriptor_, size_) == 0) ::lseek(descriptor_, size_, SEEK_SET);
    fail(path_, error);
  }
  size_ += static_cast<std::int64_t>(piece.size());
}

void GrowingFile::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(path_, errno);
}

}  // namespace tread
