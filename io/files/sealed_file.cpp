#include "io/files/sealed_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <sstream>
#include <string_view>

#include "core/error.hpp"
#include "core/math/hash.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/files/output_file.hpp"

namespace tread {

namespace {

constexpr std::uint64_t kHeader = 512;   ///< size of the header, after which HDF5 looks for its part [B]
constexpr std::size_t kBlock = 1 << 20;  ///< bytes read at once, whole words [B]

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

/// Reads bytes and returns their number: less than `size` at the end of the file, -1 for an error.
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

/// Checksum of all bytes after the header, up to `size`. Returns false for an error.
bool checksum(int file, std::uint64_t size, Hash& hash) {
  std::vector<char> block(kBlock);
  for (std::uint64_t place = kHeader; place < size; place += kBlock) {
    const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, size - place));
    if (read_at(file, block.data(), part, place) != static_cast<ssize_t>(part)) return false;
    hash.add(std::as_bytes(std::span(block.data(), part)));
  }
  return true;
}

/// Statements of the header besides kind and version.
struct Seal {
  std::uint64_t bytes = 0;  ///< length of the file
  std::uint64_t index = 0;  ///< start of the list of entries [B]
  std::uint64_t sum = 0;    ///< checksum of all bytes after the header
};

std::string header(const std::string& kind, int version, const Seal& seal) {
  std::string text = fmt::format("tread {}\nversion {}\nbytes {}\nindex {}\nchecksum {:016x}\n", kind,
                                 version, seal.bytes, seal.index, seal.sum);
  text.resize(kHeader, '\0');
  return text;
}

/// Forces the file to the disk and drops it from memory, so that the next read comes from the disk.
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
  if (program != "tread" || found_kind != kind)
    refuse(path, fmt::format("it is not a {} file of tread", kind));
  if (!words || found_version != version)
    refuse(path,
           fmt::format("it is a {} file of version {}, this program reads version {}; go on with the program "
                       "that wrote it",
                       kind, found_version, version));
}

/// Number behind the word; 0 if there is none.
std::uint64_t number_after(const std::string& word, const std::string& text) {
  const std::size_t at = text.find(word);
  std::uint64_t number = 0;
  if (at != std::string::npos)
    std::from_chars(text.data() + at + word.size(), text.data() + text.size(), number);
  return number;
}

/// Checks the bytes of the file and returns the seal. Throws InputError for any damage.
Seal check_bytes(const std::filesystem::path& path, int file, const std::string& kind, int version) {
  struct stat status {};
  if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) refuse(path, "it is not a regular file");
  std::string found(kHeader, '\0');
  if (read_at(file, found.data(), kHeader, 0) != static_cast<ssize_t>(kHeader))
    refuse(path, fmt::format("it is not a {} file of tread, or cut short", kind));
  check_header(path, found, kind, version);
  Seal seal{static_cast<std::uint64_t>(status.st_size), number_after("index ", found), 0};
  const std::uint64_t stated = number_after("bytes ", found);
  if (stated != seal.bytes) refuse(path, fmt::format("it has {} of {} bytes", seal.bytes, stated));
  Hash hash;
  if (!checksum(file, seal.bytes, hash)) refuse(path, std::strerror(errno));
  seal.sum = hash.value();
  if (found != header(kind, version, seal)) refuse(path, "it is damaged: its checksum differs");
  return seal;
}

constexpr std::array<std::string_view, 4> kTypes = {"f64", "f32", "i64", "byte"};  ///< as in SealedValues

/// A line of the index.
struct IndexLine {
  std::size_t type = 0;     ///< index in kTypes
  std::uint64_t count = 0;  ///< number of values
  std::uint64_t place = 0;  ///< place of the first value in the file [B]
  std::string name;
};

std::string text_of(const IndexLine& line) {
  return fmt::format("{} {} {} {}\n", kTypes[line.type], line.count, line.place, line.name);
}

/// Parses a line of the index. Returns nullopt unless text_of() would write the same line.
std::optional<IndexLine> parse_line(const std::string& text) {
  std::istringstream words(text);
  std::string type;
  IndexLine line;
  words >> type >> line.count >> line.place >> std::ws;
  std::getline(words, line.name);  // names may hold blanks
  const auto known = std::find(kTypes.begin(), kTypes.end(), type);
  if (!words || known == kTypes.end()) return std::nullopt;
  line.type = static_cast<std::size_t>(known - kTypes.begin());
  return text_of(line) == text + "\n" ? std::optional(line) : std::nullopt;
}

/// Takes the values of the entries out of a file whose bytes are sound. The index is not trusted: all entries
/// together take no more memory than the file has bytes.
class SealedReader {
 public:
  SealedReader(const std::filesystem::path& path, int file, const Seal& seal)
      : path_(path), file_(file), size_(seal.bytes), left_(seal.bytes), index_(seal.index) {}

  SealedContent content() {
    if (index_ < kHeader || index_ > size_) refuse(path_, "its list of entries lies outside of it");
    std::istringstream lines(values<std::string>(size_ - index_, index_, 1));
    SealedContent all;
    int number = 0;
    for (std::string text; std::getline(lines, text);) {
      ++number;
      const std::optional<IndexLine> line = parse_line(text);
      if (!line || !all.emplace(line->name, entry(*line)).second)
        refuse(path_, fmt::format("line {} of its list of entries is broken", number));
    }
    return all;
  }

 private:
  SealedValues entry(const IndexLine& line) {
    switch (line.type) {
      case 0:
        return values<std::vector<double>>(line.count, line.place, sizeof(double));
      case 1:
        return values<std::vector<float>>(line.count, line.place, sizeof(float));
      case 2:
        return values<std::vector<std::int64_t>>(line.count, line.place, sizeof(std::int64_t));
      default:
        return values<std::string>(line.count, line.place, 1);
    }
  }

  template <class Values>
  Values values(std::uint64_t count, std::uint64_t place, std::uint64_t width) {
    if (count > left_ / width || place > size_ || count * width > size_ - place)
      refuse(path_, fmt::format("an entry of {} values does not fit into its {} bytes", count, size_));
    left_ -= count * width;
    Values read(count, typename Values::value_type{});
    if (read_at(file_, reinterpret_cast<char*>(read.data()), count * width, place) !=
        static_cast<ssize_t>(count * width))
      refuse(path_, "it ended early");
    return read;
  }

  const std::filesystem::path& path_;
  int file_;
  std::uint64_t size_;
  std::uint64_t left_;  ///< bytes that further entries may take
  std::uint64_t index_;
};

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

/// HDF5 part of the file. `index` receives the places of the entries in a file in which this part follows the
/// header. HDF5 never writes to the disk, because it recovers badly from a disk's errors.
Hdf5File hdf5_part(SealedContent content, std::string& index) {
  Hdf5File file = Hdf5File::create_in_memory();
  for (auto entry = content.begin(); entry != content.end(); entry = content.erase(entry)) {
    const auto& [name, values] = *entry;
    std::visit(WriteEntry{file, name}, values);
    const std::uint64_t count = std::visit([](const auto& v) { return v.size(); }, values);
    index += text_of({values.index(), count, count == 0 ? kHeader : kHeader + file.place(name), name});
  }
  return file;
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
  std::string index;
  const Hdf5File file = hdf5_part(std::move(content), index);
  const std::string_view image = file.image();
  constexpr std::size_t kWord = 8;  // checksums go over whole words [B]
  const std::string filler((kWord - image.size() % kWord) % kWord, '\0');
  Seal seal;
  seal.index = kHeader + image.size() + filler.size();
  seal.bytes = seal.index + index.size();
  Hash hash;
  hash.add(std::as_bytes(std::span(image)));  // as if the filler followed
  hash.add(std::as_bytes(std::span(index)));
  seal.sum = hash.value();
  GrowingFile out(path);
  out.append(header(kind, version, seal));
  for (const std::string_view piece : {image, std::string_view(filler), std::string_view(index)})
    out.append(piece);
  out.close();
  drop_from_memory(path);
}

SealedContent read_sealed(const std::filesystem::path& path, const std::string& kind, int version) {
  const Descriptor file(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
  if (file < 0) refuse(path, errno == ELOOP ? "it is a symbolic link" : std::strerror(errno));
  const Seal seal = check_bytes(path, file, kind, version);
  return SealedReader(path, file, seal).content();
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
