#pragma once
// The operating system's locks: they go with the process, however that ends.

#include <cstdint>
#include <filesystem>
#include <optional>

namespace tread {

class FileLock {
 public:
  /// On a folder. Nothing where somebody else holds the lock. ResourceError where the folder cannot be
  /// opened, or its file system has no locks.
  static std::optional<FileLock> try_folder(const std::filesystem::path& folder);

  /// On a number: one file, one lock for each. The file is created empty where it is missing and never grows.
  /// Nothing and ResourceError as above.
  static std::optional<FileLock> try_number(const std::filesystem::path& file, std::uint64_t number);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace tread
