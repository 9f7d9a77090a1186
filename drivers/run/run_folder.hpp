#pragma once
// The folder of a run as one process owns it and others look into it.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "io/files/file_lock.hpp"

namespace tread {

inline constexpr const char* kCheckpointFolder = "checkpoint";  ///< of a run's folder

/// Its last part, "run" of "out/run" and of "out/run/".
std::string folder_name(const std::filesystem::path& folder);

/// Whether a process works on the folder.
bool is_taken(const std::filesystem::path& folder);

/// InputError where a run lies in the folder, whose results other ones of the same names would overwrite.
void require_no_run(const std::filesystem::path& folder);

/// What another process asks of the one that works on the folder.
enum class RunRequest { checkpoint, frame, stop };

/// Leaves the request for take_request(). ResourceError where it cannot be written.
void leave_request(const std::filesystem::path& folder, RunRequest request);
/// Whether the last request still lies there.
bool is_pending(const std::filesystem::path& folder);

/// Owns the folder for one process, until that ends in whatever way.
class RunFolder {
 public:
  /// ResourceError where another process owns the folder.
  explicit RunFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const char* name) const { return path_ / name; }

  /// What another process asks for, once.
  std::optional<RunRequest> take_request() const;
  /// Whether another process asks to stop, once; other requests stay where they are.
  bool take_stop() const;

  /// Replaces status.json; a status that cannot be written is left out.
  void show_status(const std::string& json) const;

  /// Of all files in it [B].
  std::int64_t bytes() const;

 private:
  std::filesystem::path path_;
  FileLock lock_;
};

}  // namespace tread
