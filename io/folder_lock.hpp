#pragma once
// The operating system's lock on a folder: it goes with the process, however that ends.

#include <filesystem>
#include <optional>

namespace tread {

class FolderLock {
 public:
  /// Nothing where another process holds the lock. ResourceError where the folder cannot be opened, or its
  /// file system has no locks.
  static std::optional<FolderLock> try_take(const std::filesystem::path& folder);

  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace tread
