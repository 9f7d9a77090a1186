#pragma once
// This program as a child process.

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace tread {

/// How a process ended.
struct ProcessEnd {
  int code = 0;    ///< of exit; meaningless after a signal
  int signal = 0;  ///< that ended it; 0: none
};

/// Runs this program's own file with other arguments, in a process group of its own, so that signals from the
/// terminal reach it through its parent alone. It is sent SIGTERM when its parent dies.
class ChildProcess {
 public:
  /// Starts it; what it prints is added to the file `log`. ResourceError where the system refuses.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& log);

  /// Whether it has ended; fills `end` then, once.
  bool ended(ProcessEnd& end) const;

  /// Has no effect on one that has ended.
  void send(int signal) const;

 private:
  pid_t process_;
};

}  // namespace tread
