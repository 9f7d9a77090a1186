#pragma once
// Files on disk that hold whole pieces only, even if writing fails.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>

namespace tread {

/// Calls `write` with the path of a fresh neighbour (`path` + ".part"), forces the written data to the disk
/// and renames the neighbour to `path`, on the disk too. If anything fails, the neighbour is removed, `path`
/// stays unchanged, and the error of `write` or a ResourceError is thrown.
void replace_file(const std::filesystem::path& path,
                  const std::function<void(const std::filesystem::path& part)>& write);

/// Does so by way of the neighbour `part`.
void replace_file(const std::filesystem::path& path, const std::filesystem::path& part,
                  const std::function<void(const std::filesystem::path& part)>& write);

/// An empty new file "NAME.tread.part" beside the file NAME, locked until this ends. One that a killed
/// process left is removed; another process's, or what cannot be locked, stays, and the name gets a number.
class Neighbour {
 public:
  /// Throws ResourceError, which names `path`.
  explicit Neighbour(const std::filesystem::path& path);
  ~Neighbour();
  Neighbour(const Neighbour&) = delete;
  Neighbour& operator=(const Neighbour&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Forces the data of a closed file to the disk. Throws ResourceError.
void force_to_disk(const std::filesystem::path& path);

/// Makes the folder and those above it. Throws ResourceError.
void create_folder(const std::filesystem::path& folder);

/// create_folder() of one that option -o can replace, which the error says.
void make_directory(const std::filesystem::path& directory);

/// Makes the folder in one that is there. Throws ResourceError.
void create_last_folder(const std::filesystem::path& folder);

/// Writes the text to the file at the path; an error names `shown`. Throws ResourceError.
void write_text(const std::filesystem::path& path, std::string_view text, const std::filesystem::path& shown);

/// Replaces the file by `text`. Throws ResourceError.
void write_text_file(const std::filesystem::path& path, std::string_view text);

/// Replaces the file by `text` as write_text_file() does, but without waiting for the disk. For a status that
/// the next one soon replaces.
void show_text_file(const std::filesystem::path& path, std::string_view text);

/// A text file that grows by whole pieces. A piece that does not fit is taken back before the ResourceError
/// is thrown.
class GrowingFile {
 public:
  /// Starts an empty file.
  explicit GrowingFile(const std::filesystem::path& path);
  /// Starts an empty file that errors and path() call `shown`.
  GrowingFile(const std::filesystem::path& path, std::filesystem::path shown);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  /// Hands the piece to the operating system.
  void append(std::string_view piece);
  /// Closes the file. Throws ResourceError for data that the system could not keep.
  void close();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::int64_t size_ = 0;  ///< [B]
};

}  // namespace tread
