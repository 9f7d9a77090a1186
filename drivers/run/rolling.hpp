#pragma once
// Step 2 as a process carries it out: stepping, samples, checkpoints, frames, what others ask for, what ends
// it.

#include <cstdint>
#include <optional>
#include <string>

#include "core/parallel/background_task.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/results/frame_files.hpp"
#include "drivers/results/growing_files.hpp"
#include "drivers/results/run_results.hpp"
#include "drivers/run/run_session.hpp"

namespace tread {

class Rolling {
 public:
  Rolling(RunSession& session, Model& model, RunResults& results);

  /// From the preload in the results.
  void begin();
  /// From a checkpoint whose results have been unpacked.
  void go_on(const SealedContent& checkpoint);

  /// Steps to the end and fills the results. NumericalError and ResourceError say what is left; Interrupted
  /// after a signal, a request or stop.wall_time.
  void to_the_end();

 private:
  /// Of a checkpoint.
  struct Mark {
    std::int64_t steps;
    double time;  ///< [s]
  };
  void step_to_the_end();
  void look();
  void check_penetration();
  void check_disk();
  void keep_for_forks();
  void write_checkpoint();
  void write_frame();
  void wait_for_writer();
  void leave(const std::string& why);
  template <class E>
  [[noreturn]] void end(const std::string& why);
  template <class E>
  [[noreturn]] void end_with_what_is_left(const std::string& why);
  template <class E>
  std::string way_on() const;
  void close_quietly();
  std::string progress_line() const;
  std::string status() const;
  double seconds() const;  ///< of rolling, earlier processes included
  void fill_results();

  RunSession* session_;
  Model* model_;
  RunResults* results_;
  std::optional<Simulation> simulation_;
  std::optional<GrowingFiles> files_;
  std::optional<FrameFiles> frames_;
  std::int64_t end_ = 0;                   ///< steps of the whole run
  std::optional<std::int64_t> fork_step_;  ///< whose state is kept for other runs
  double started_ = 0;                     ///< on the session's clock [s]
  std::int64_t started_steps_ = 0;
  double seconds_before_ = 0;    ///< rolled by earlier processes [s]
  double looked_at_ = 0;         ///< on the session's clock [s]
  double checkpoint_at_ = 0;     ///< the last one, on the session's clock [s]
  std::optional<Mark> written_;  ///< the last checkpoint that is safe
  std::optional<Mark> being_written_;
  BackgroundTask writer_;  ///< of checkpoints and frames, one after another: a checkpoint's frames are safe
};

}  // namespace tread
