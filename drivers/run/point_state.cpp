#include "drivers/run/point_state.hpp"

#include <system_error>

#include "drivers/run/run_folder.hpp"
#include "io/files/checkpoint_folder.hpp"

namespace tread {

const char* name_of(PointState state) {
  switch (state) {
    case PointState::interrupted:
      return "interrupted";
    case PointState::running:
      return "running";
    case PointState::done:
      return "done";
    case PointState::failed:
      return "failed";
    default:
      return "waiting";
  }
}

void forget_failure(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::filesystem::remove(folder / kFailure, ignored);
}

PointState state_left_in(const std::filesystem::path& folder) {
  const bool begun = CheckpointFolder(folder / kCheckpointFolder).holds_run();
  if (!begun && std::filesystem::exists(folder / "summary.json")) return PointState::done;
  if (std::filesystem::exists(folder / kFailure)) return PointState::failed;
  return begun ? PointState::interrupted : PointState::waiting;
}

}  // namespace tread
