#pragma once
// `tread ctl`: shows the state of a run and sends requests to the run.

#include <filesystem>
#include <string>

namespace tread {

struct CtlOptions {
  std::filesystem::path folder;
  std::string action;    ///< "status", "checkpoint", "frame" or "stop"
  double patience = 60;  ///< for an answer [s]
};

/// Prints status.json with `alive` (a process works on the folder) and `resumable` (none does, and
/// `tread resume` goes on with the run; Interrupted is thrown then), or leaves the request and waits until
/// the run has taken it; after "stop" until the run has ended. InputError where no process works on the
/// folder; ResourceError where none answers.
void control_run(const CtlOptions& options);

}  // namespace tread
