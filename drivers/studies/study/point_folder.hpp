#pragma once
// The folder of one run of a study: what stands in it, and what has to be done.

#include <filesystem>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "drivers/process/child_process.hpp"
#include "drivers/run/scene_content.hpp"

namespace tread {

enum class PointState {
  waiting,      ///< nothing done, or nothing of use
  interrupted,  ///< a checkpoint or an order to go on from
  running,
  done,
  failed  ///< its last process ended with an error
};

/// For readers: "done".
const char* name_of(PointState state);

struct PointStatus {
  PointState state = PointState::waiting;
  std::string why;                      ///< of one that failed
  ExitCode code = ExitCode::resources;  ///< of one that failed
  bool anew = false;                    ///< of one that failed: its checkpoint leads to the same end
  bool foreign = false;                 ///< a run of another scene: `why` says what differs
  std::optional<double> keeps_at = {};  ///< forks.at of the run that stands there [s]
  double room = 0;                      ///< for a corrugation of its forks [m]
};

/// Looks into the folder, which need not exist. A run that stands in it counts whoever began it, if its scene
/// is this one.
PointStatus look_into(const std::filesystem::path& folder, const SceneContent& scene);

/// After the folder's process has ended: keeps why it failed, or forgets why it once did. ResourceError.
void note_end(const std::filesystem::path& folder, const ProcessEnd& end);

/// Keeps why it failed before it began. ResourceError.
void note_failure(const std::filesystem::path& folder, ExitCode code, const std::string& why);

/// Where the processes of the folder print.
std::filesystem::path log_of(const std::filesystem::path& folder);

}  // namespace tread
