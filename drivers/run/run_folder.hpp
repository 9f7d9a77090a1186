#pragma once
// The folder of a run: one process owns it, others look into it.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/files/file_identity.hpp"
#include "io/files/file_lock.hpp"

namespace tread {

inline constexpr const char* kCheckpointFolder = "checkpoint";  ///< checkpoint folder within a run's folder

/// Last part of the path: "run" of "out/run" and of "out/run/".
std::string folder_name(const std::filesystem::path& folder);

/// Size of all files in a folder [B].
std::int64_t folder_bytes(const std::filesystem::path& folder);

/// InputError where there is no such folder; `option` begins its text, "--from: ".
void require_run_folder(const std::filesystem::path& folder, std::string_view option = "");

/// Sentence on a folder in which no run has begun.
std::string no_run_text(const std::filesystem::path& folder);

/// Sentence on a run's folder whose path leads to it no more.
std::string moved_text(const std::filesystem::path& folder);

/// Returns true if a process works on the folder.
bool is_taken(const std::filesystem::path& folder);

/// Returns true if the folder holds results of `command`, "sweep". Throws InputError if it holds those of
/// another one, which files of equal names would overwrite.
bool require_folder_of(const std::filesystem::path& folder, std::string_view command);

/// "`tread resume FOLDER MORE`", words as a shell takes them.
std::string resume_text(const std::filesystem::path& folder, const std::string& more = "");

/// Request of another process to the one that works on the folder.
enum class RunRequest { checkpoint, frame, stop };

/// Leaves the request for take_request(). Throws ResourceError if it cannot be written.
void leave_request(const std::filesystem::path& folder, RunRequest request);
/// Removes a request that nothing has answered.
void withdraw_request(const std::filesystem::path& folder);
/// Returns true if the last request has no answer yet.
bool is_pending(const std::filesystem::path& folder);

/// Ownership of the folder by one process, until the process ends in any way.
class RunFolder {
 public:
  /// Takes the folder. Throws ResourceError if another process owns it.
  explicit RunFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return identity_.path(); }
  std::filesystem::path operator/(const char* name) const { return path() / name; }

  /// Returns true while the path leads to this folder.
  bool in_place() const { return identity_.in_place(); }

  /// Request of another process, once. That to stop is answered by the end of this process, others by
  /// answer_request().
  std::optional<RunRequest> take_request() const;
  /// Says that what take_request() returned is done.
  void answer_request() const;
  /// Returns true if another process asks to stop, once. Other requests stay in the folder.
  bool take_stop() const;

  /// Replaces status.json; a status that cannot be written is left out, as is that of a folder without its
  /// name.
  void show_status(const std::string& json) const;

 private:
  FileIdentity identity_;
  FileLock lock_;
};

}  // namespace tread
