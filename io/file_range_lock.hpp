#pragma once
// Locks on numbers: one file, one lock for each. They go with the process, however that ends.

#include <cstdint>
#include <filesystem>
#include <optional>

namespace tread {

class FileRangeLock {
 public:
  /// On the byte `number` of the file, which is created empty where it is missing and never grows. Nothing
  /// where another process holds it. ResourceError where the file cannot be opened, or its file system has no
  /// locks.
  static std::optional<FileRangeLock> try_take(const std::filesystem::path& file, std::uint64_t number);

  FileRangeLock(FileRangeLock&& other) noexcept;
  FileRangeLock& operator=(FileRangeLock&&) = delete;
  ~FileRangeLock();

 private:
  explicit FileRangeLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace tread
