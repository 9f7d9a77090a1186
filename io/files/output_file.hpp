#pragma once
// Files on disk that hold whole pieces only, whatever happens while they are written.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>

namespace tread {

/// Calls `write` with the path of a fresh neighbour (`path` + ".part"), forces what it wrote to the disk and
/// renames it to `path`, on the disk too. If anything fails the neighbour is removed, `path` stays as it was,
/// and the error leaves: that of `write`, or ResourceError.
void replace_file(const std::filesystem::path& path,
                  const std::function<void(const std::filesystem::path& part)>& write);

/// Replaces the file by `text`. Throws ResourceError.
void write_text_file(const std::filesystem::path& path, std::string_view text);

/// The same without waiting for the disk: a status that the next one soon replaces.
void show_text_file(const std::filesystem::path& path, std::string_view text);

/// A text file that grows by whole pieces: one that does not fit is taken back before the ResourceError
/// leaves.
class GrowingFile {
 public:
  /// Starts an empty file.
  explicit GrowingFile(std::filesystem::path path);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  /// Hands the piece to the operating system.
  void append(std::string_view piece);
  /// Closes the file and reports what the system could not keep.
  void close();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::int64_t size_ = 0;  ///< [B]
};

}  // namespace tread
