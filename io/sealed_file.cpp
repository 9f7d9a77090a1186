#include "io/sealed_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <sstream>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "io/hdf5_file.hpp"
#include "io/output_file.hpp"

namespace tread {

namespace {

constexpr std::uint64_t kHeader = 512;   ///< where HDF5 looks next for its part [B]
constexpr std::size_t kBlock = 1 << 20;  ///< read at once, whole words [B]

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags) : id_(::open(path.c_str(), flags | O_CLOEXEC)) {}
  ~Descriptor() {
    if (id_ >= 0) ::close(id_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return id_; }

 private:
  int id_;
};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw InputError(fmt::format("cannot use {}: {}", path.string(), reason));
}

/// Bytes read, less than `size` at the end of the file; -1: error.
ssize_t read_at(int file, char* out, std::size_t size, std::uint64_t place) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = ::pread(file, out + done, size - done, static_cast<off_t>(place + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return -1;
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  return static_cast<ssize_t>(done);
}

/// Of all that follows the header, up to `size`; false: error.
bool checksum(int file, std::uint64_t size, Hash& hash) {
  std::vector<char> block(kBlock);
  for (std::uint64_t place = kHeader; place < size; place += kBlock) {
    const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, size - place));
    if (read_at(file, block.data(), part, place) != static_cast<ssize_t>(part)) return false;
    hash.add(std::as_bytes(std::span(block.data(), part)));
  }
  return true;
}

std::string header(const std::string& kind, int version, std::uint64_t size, std::uint64_t sum) {
  std::string text =
      fmt::format("tread {}\nversion {}\nbytes {}\nchecksum {:016x}\n", kind, version, size, sum);
  text.resize(kHeader, '\0');
  return text;
}

/// About, of the file.
std::size_t size_of(const SealedContent& content) {
  std::size_t bytes = 1 << 20;
  for (const auto& [name, values] : content)
    bytes += std::visit([](const auto& v) { return v.size() * sizeof(v[0]); }, values);
  return bytes;
}

/// Forces the file to the disk; what is read of it next comes from there.
void drop_from_memory(const std::filesystem::path& path) {
  const Descriptor file(path, O_RDONLY);
  if (file < 0 || ::fsync(file) != 0)
    throw ResourceError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
  ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
}

void check_header(const std::filesystem::path& path, const std::string& text, const std::string& kind,
                  int version) {
  std::istringstream words(text.substr(0, text.find('\0')));
  std::string program, found_kind, name;
  int found_version = 0;
  words >> program >> found_kind >> name >> found_version;
  if (program != "tread" || found_kind != kind) refuse(path, fmt::format("it is not a {} of tread", kind));
  if (!words || found_version != version)
    refuse(path,
           fmt::format("it is a {} of version {}, this program reads version {}; go on with the program "
                       "that wrote it",
                       kind, found_version, version));
}

/// Everything that can be wrong with the bytes.
void check_bytes(const std::filesystem::path& path, const std::string& kind, int version) {
  const Descriptor file(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
  if (file < 0) refuse(path, errno == ELOOP ? "it is a symbolic link" : std::strerror(errno));
  struct stat status {};
  if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) refuse(path, "it is not a regular file");
  std::string found(kHeader, '\0');
  if (read_at(file, found.data(), kHeader, 0) != static_cast<ssize_t>(kHeader))
    refuse(path, fmt::format("it is not a {} of tread, or cut short", kind));
  check_header(path, found, kind, version);
  const auto size = static_cast<std::uint64_t>(status.st_size);
  const std::string mark = "bytes ";
  const std::size_t at = found.find(mark);
  std::uint64_t stated = 0;
  if (at != std::string::npos)
    std::from_chars(found.data() + at + mark.size(), found.data() + found.size(), stated);
  if (stated != size) refuse(path, fmt::format("it has {} of {} bytes", size, stated));
  Hash hash;
  if (!checksum(file, size, hash)) refuse(path, std::strerror(errno));
  if (found != header(kind, version, size, hash.value())) refuse(path, "it is damaged: its checksum differs");
}

struct WriteEntry {
  Hdf5File& file;
  const std::string& name;

  void operator()(const std::vector<double>& values) const { file.write<double>(name, values); }
  void operator()(const std::vector<float>& values) const { file.write<float>(name, values); }
  void operator()(const std::vector<std::int64_t>& values) const { file.write<std::int64_t>(name, values); }
  void operator()(const std::string& text) const {
    file.write<std::uint8_t>(name, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
};

SealedValues read_entry(const Hdf5File& file, const std::string& name) {
  if (file.holds<double>(name)) return file.read<double>(name);
  if (file.holds<float>(name)) return file.read<float>(name);
  if (file.holds<std::int64_t>(name)) return file.read<std::int64_t>(name);
  const std::vector<std::uint8_t> bytes = file.read<std::uint8_t>(name);
  return std::string(bytes.begin(), bytes.end());
}

/// The HDF5 part of the file. HDF5 never sees the disk: of what that refuses it recovers badly.
std::string image_of(SealedContent content) {
  Hdf5File file = Hdf5File::create_in_memory(size_of(content));
  for (auto entry = content.begin(); entry != content.end(); entry = content.erase(entry))
    std::visit(WriteEntry{file, entry->first}, entry->second);
  return file.image();
}

}  // namespace

std::map<std::string, std::uint64_t> digests_of(const SealedContent& content) {
  std::map<std::string, std::uint64_t> digests;
  for (const auto& [name, values] : content) {
    Hash hash;
    hash.add(static_cast<std::uint64_t>(values.index()));
    std::visit(
        [&](const auto& v) {
          hash.add(static_cast<std::uint64_t>(v.size()));
          hash.add(std::as_bytes(std::span(v)));
        },
        values);
    digests[name] = hash.value();
  }
  return digests;
}

void write_sealed(const std::filesystem::path& path, const std::string& kind, int version,
                  SealedContent content) {
  const std::string image = image_of(std::move(content));
  Hash hash;
  hash.add(std::as_bytes(std::span(image)));
  GrowingFile out(path);
  out.append(header(kind, version, kHeader + image.size(), hash.value()));
  out.append(image);
  out.close();
  drop_from_memory(path);
}

SealedContent read_sealed(const std::filesystem::path& path, const std::string& kind, int version) {
  check_bytes(path, kind, version);
  const Hdf5File file = Hdf5File::open_to_read(path);
  SealedContent content;
  for (const std::string& name : file.datasets()) {
    if (!file.is_plain(name)) refuse(path, fmt::format("'{}' is stored in a form that it never has", name));
    content.emplace(name, read_entry(file, name));
  }
  return content;
}

template <class T>
const T& sealed_entry(const SealedContent& content, const std::string& name) {
  const auto found = content.find(name);
  if (found == content.end()) throw InputError(fmt::format("'{}' is missing", name));
  const T* values = std::get_if<T>(&found->second);
  if (!values) throw InputError(fmt::format("'{}' is of another type", name));
  return *values;
}

template <class T>
T sealed_value(const SealedContent& content, const std::string& name) {
  const auto& values = sealed_entry<std::vector<T>>(content, name);
  if (values.size() != 1) throw InputError(fmt::format("'{}' is not one number", name));
  return values.front();
}

template double sealed_value(const SealedContent&, const std::string&);
template std::int64_t sealed_value(const SealedContent&, const std::string&);
template const std::vector<double>& sealed_entry(const SealedContent&, const std::string&);
template const std::vector<float>& sealed_entry(const SealedContent&, const std::string&);
template const std::vector<std::int64_t>& sealed_entry(const SealedContent&, const std::string&);
template const std::string& sealed_entry(const SealedContent&, const std::string&);

}  // namespace tread
