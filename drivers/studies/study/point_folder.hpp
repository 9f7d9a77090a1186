#pragma once
// The folder of one run of a study: its content and the work left to do.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "drivers/process/child_process.hpp"
#include "drivers/run/point_state.hpp"
#include "drivers/run/scene_content.hpp"

namespace tread {

/// Exit code of a process that failed; a code that is not the program's own counts as the machine's.
ExitCode failed_exit_code(std::optional<double> code);

struct PointStatus {
  PointState state = PointState::waiting;
  std::string why;                      ///< reason, for a failed point
  ExitCode code = ExitCode::resources;  ///< exit code, for a failed point
  bool anew = false;                    ///< true for a failed point whose checkpoint leads to the same end
  bool foreign = false;                 ///< true for a run of another scene: `why` says what differs
  std::optional<double> keeps_at = {};  ///< forks.at of the run in the folder [s]
  double room = 0;                      ///< room for a corrugation of its forks [m]
  SceneContent process = {};            ///< process_values() of the run in the folder
};

/// Values that a run takes anew when it goes on and that make no other run of it: [stop], the disk's limit
/// and the intervals of progress and checkpoints.
SceneContent process_values(const ResolvedScene& scene);

/// Status of the folder, which need not exist. A run in it counts whoever began it, if its scene is this one,
/// which names `files`.
PointStatus look_into(const std::filesystem::path& folder, const SceneContent& scene,
                      const SceneFiles& files = {});

/// Text of the folder's status.json; empty if there is none.
std::string shown_status(const std::filesystem::path& folder);

/// A process of the folder, which a launcher may have started and ended in place of the run.
struct PointProcess {
  ProcessEnd end;
  bool told_to_stop = false;       ///< true if the study itself was being stopped
  std::string status_before = {};  ///< shown_status() at its start
  std::int64_t log_before = 0;     ///< log_bytes() at its start [B]
};

/// Returns true if the run was stopped and can go on: by the process's end or, whatever a launcher made of
/// the exit code, by the folder.
bool was_stopped(const std::filesystem::path& folder, const PointProcess& process);

/// Notes the end of the folder's process: keeps the reason of a failure, or removes an older one. Throws
/// ResourceError, which states the reason, where the folder cannot keep it.
void note_end(const std::filesystem::path& folder, const PointProcess& process);

/// Keeps the reason of a failure before the start. Throws as note_end().
void note_failure(const std::filesystem::path& folder, ExitCode code, const std::string& why);

/// Path of the output of the folder's processes, each of which appends to it.
std::filesystem::path log_of(const std::filesystem::path& folder);
/// Size of that file; 0: there is none [B].
std::int64_t log_bytes(const std::filesystem::path& folder);

}  // namespace tread
