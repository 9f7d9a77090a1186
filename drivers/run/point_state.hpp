#pragma once
// Progress of the run in the folder of a study's point.

#include <filesystem>

namespace tread {

inline constexpr const char* kFailure = "failed.json";  ///< keeps why the last process of a point failed

enum class PointState {
  waiting,      ///< nothing done, or nothing of use
  interrupted,  ///< a checkpoint or an order to go on from
  running,
  done,
  failed  ///< last process ended with an error
};

/// Name for readers, such as "done".
const char* name_of(PointState state);

/// Removes kFailure: of a run that goes on, or has ended in another way.
void forget_failure(const std::filesystem::path& folder);

/// State of a folder that no process works on, and that need not exist.
PointState state_left_in(const std::filesystem::path& folder);

}  // namespace tread
