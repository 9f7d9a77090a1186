#include "io/files/named_output.hpp"

#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "core/error.hpp"
#include "io/files/output_file.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

/// Number of stdout or stderr if the path leads to the file that it writes, otherwise -1.
int standard_file(const fs::path& path) {
  struct stat named {};
  if (::stat(path.c_str(), &named) != 0) return -1;
  for (const int number : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat own {};
    if (::fstat(number, &own) == 0 && own.st_dev == named.st_dev && own.st_ino == named.st_ino) return number;
  }
  return -1;
}

bool is_pipe_or_device(const fs::path& path) {
  std::error_code error;
  return fs::is_other(fs::status(path, error));
}

/// Path of the file behind links, which need not exist.
fs::path behind_links(fs::path path) {
  constexpr int kMost = 40;  // as the kernel
  std::error_code error;
  for (int i = 0; i < kMost && fs::is_symlink(path, error); ++i)
    path = path.parent_path() / fs::read_symlink(path, error);
  return path;
}

/// Removes the file at the end of its life.
class Removal {
 public:
  explicit Removal(const fs::path& path) : path_(path) {}
  ~Removal() { ::unlink(path_.c_str()); }
  Removal(const Removal&) = delete;
  Removal& operator=(const Removal&) = delete;

 private:
  const fs::path& path_;
};

/// Writes the bytes of a file to an open one.
void pour(std::ifstream& file, int to, const fs::path& shown) {
  std::array<char, 1 << 16> bytes{};
  while (file.read(bytes.data(), bytes.size()), file.gcount() > 0)
    for (std::streamsize done = 0; done < file.gcount();) {
      const ssize_t written =
          ::write(to, bytes.data() + done, static_cast<std::size_t>(file.gcount() - done));
      if (written < 0 && errno != EINTR)
        throw ResourceError(fmt::format("cannot write {}: {}", shown.string(), std::strerror(errno)));
      if (written > 0) done += written;
    }
}

}  // namespace

bool has_neighbours(const fs::path& path) {
  return !is_pipe_or_device(path) && standard_file(path) < 0;
}

void require_other_file(const fs::path& output, const fs::path& input) {
  std::error_code error;
  if (fs::is_regular_file(output, error) && fs::equivalent(output, input, error))
    throw InputError(
        fmt::format("the output {} would replace the input {}, which is the same file; choose another name "
                    "or folder for the output",
                    output.string(), input.string()));
}

void write_named_file(const fs::path& path, const std::function<void(const fs::path& part)>& write) {
  std::fflush(stdout);  // before what goes to the same place
  if (is_pipe_or_device(path)) return write(path);
  const fs::path file = behind_links(path);
  std::error_code error;
  if (const fs::path folder = file.parent_path(); !folder.empty() && !fs::is_directory(folder, error))
    throw ResourceError(fmt::format("cannot write {}: there is no folder {}; make it, or choose another",
                                    path.string(), folder.string()));
  const int standard = standard_file(file);
  const Neighbour neighbour(file);
  const fs::path& beside = neighbour.path();
  if (standard < 0) return replace_file(file, beside, write);
  std::ifstream written;
  {
    const Removal removal(beside);  // its bytes stay until they are read
    write(beside);
    written.open(beside, std::ios::binary);
  }
  pour(written, standard, path);
}

void write_named_text(const fs::path& path, std::string_view text) {
  write_named_file(path, [&](const fs::path& part) { write_text(part, text, path); });
}

}  // namespace tread
