#pragma once
// Signals that ask a run to stop or to leave a checkpoint.

#include <csignal>
#include <string>
#include <utility>
#include <vector>

namespace tread {

/// A signal that asks to stop, and its name.
struct StopSignal {
  int number;
  const char* name;
};
inline constexpr StopSignal kStopSignals[] = {
    {SIGINT, "SIGINT"}, {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"}, {SIGUSR2, "SIGUSR2"}, {SIGXCPU, "SIGXCPU"}};

/// Watches kStopSignals and SIGUSR1 while it lives; one object at a time. Until defer() all but SIGUSR1 end
/// the process at once, with ExitCode::resumable and a sentence. After defer() the first of them only asks,
/// and another one half a second later or more, except SIGXCPU, ends the process. SIGPIPE is ignored: a run
/// outlives the reader of its progress. SIGXFSZ is ignored too: the write that went too far reports the
/// error.
class Interruption {
 public:
  /// `early` and `late`: the sentences, before defer() and after it. `asked`: what the first signal says
  /// then, if anything.
  Interruption(const std::string& early, const std::string& late, const std::string& asked = "");
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Replaces `early`.
  void set_early(const std::string& sentence);
  void defer();

  /// Name of the signal that asked to stop, or null.
  static const char* stop_wanted();
  /// Returns true once for each SIGUSR1.
  static bool take_checkpoint_wanted();

 private:
  void handle(int signal, void (*handler)(int));

  std::vector<std::pair<int, struct sigaction>> before_;
};

}  // namespace tread
