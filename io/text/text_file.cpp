#include "io/text/text_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>

#include "core/error.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw InputError(fmt::format("cannot read {}: {}", path.string(), reason));
}

}  // namespace

std::string read_bytes(const fs::path& path, std::size_t limit) {
  std::error_code error;
  if (path.empty()) throw InputError("the name of a file to read is empty; state one");
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) refuse(path, error ? error.message() : "no such file");
  if (fs::is_directory(status)) refuse(path, "it is a directory, not a file");
  if (!fs::is_regular_file(status)) refuse(path, "it is not a regular file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) refuse(path, error.message());
  if (size > limit) refuse(path, fmt::format("it has {} bytes, more than the limit of {}", size, limit));

  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(path, std::strerror(errno));
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (stream.bad() || static_cast<std::uintmax_t>(stream.gcount()) != size) refuse(path, "it ended early");
  return text;
}

std::string read_text_file(const fs::path& path, std::size_t limit) {
  std::string text = read_bytes(path, limit);
  if (text.find('\0') != std::string::npos) refuse(path, "it is a binary file, not text");
  return text;
}

std::string without_mark(std::string text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark)) text.erase(0, kMark.size());
  return text;
}

}  // namespace tread
