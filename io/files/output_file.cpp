#include "io/files/output_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "core/error.hpp"

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

/// Calls `write` with the path of a neighbour and renames that file to `path`. Removes the neighbour if
/// either fails.
void rename_finished(const std::filesystem::path& path,
                     const std::function<void(const std::filesystem::path& part)>& write) {
  std::filesystem::path part = path;
  part += ".part";
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
  const auto forced = [&](const std::filesystem::path& part) {
    write(part);
    if (const int error = sync(part)) fail(part, error);
  };
  rename_finished(path, forced);
  const std::filesystem::path folder = path.parent_path();
  if (const int error = sync(folder.empty() ? "." : folder)) fail(path, error);
}

void create_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  require_created(folder, error);
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
  rename_finished(path, [&](const std::filesystem::path& part) { write_text(part, text, path); });
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
