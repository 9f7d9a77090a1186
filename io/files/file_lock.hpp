#pragma once
// The operating system's locks. They end with the process, however it ends.

#include <cstdint>
#include <filesystem>
#include <optional>

namespace tread {

class FileLock {
 public:
  /// Locks a folder, for all machines that share it if this user can write there and its file system has such
  /// locks, else for this machine. The folder then holds an empty file `.lock`; unless it was there before,
  /// it goes with the lock. Returns nullopt while another holder has the lock. Throws ResourceError if the
  /// folder cannot be opened or its file system has no locks.
  static std::optional<FileLock> try_folder(const std::filesystem::path& folder);

  /// Returns true while try_folder() would find another holder. Leaves no file. Throws as try_folder().
  static bool is_held(const std::filesystem::path& folder);

  /// Locks a number: `file` holds one lock for each number. The file is created empty if it is missing and
  /// never grows. Returns nullopt and throws as try_folder().
  static std::optional<FileLock> try_number(const std::filesystem::path& file, std::uint64_t number);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}

  /// Locks a folder for this machine. Returns nullopt and throws as try_folder().
  static std::optional<FileLock> try_directory(const std::filesystem::path& folder);

  /// Extends the lock of a folder to all machines. Returns false while a holder on another one has it.
  bool share();

  int descriptor_;
  int shared_ = -1;    ///< lock file of a folder, for all machines
  bool made_ = false;  ///< true if that file is removed with the lock
};

}  // namespace tread
