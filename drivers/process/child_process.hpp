#pragma once
// This program as a child process.

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace tread {

/// The end of a process.
struct ProcessEnd {
  int code = 0;    ///< exit code; meaningless after a signal
  int signal = 0;  ///< signal that ended the process; 0: none
};

/// Path of this program's own file.
std::filesystem::path own_program();

/// Runs this program's own file with other arguments. The process has a group of its own, so that signals
/// from the terminal reach it through its parent alone. It receives SIGTERM when its parent dies.
class ChildProcess {
 public:
  /// Starts the process and appends its output to the file `log`. `launcher`: a program, and its own
  /// arguments, that starts this one, somewhere; empty: this machine. `beside`: others run on this machine at
  /// the same time, so that OpenMP must not keep the threads of each on the same first cores. Throws
  /// ResourceError if the system refuses.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& log,
               const std::vector<std::string>& launcher = {}, bool beside = false);

  /// Returns true if the process has ended; fills `end` then, once.
  bool ended(ProcessEnd& end) const;

  /// Sends a signal. It has no effect on a process that has ended.
  void send(int signal) const;
  /// Sends a signal to the process and to those that it has started.
  void send_to_group(int signal) const;

 private:
  pid_t process_;
};

}  // namespace tread
