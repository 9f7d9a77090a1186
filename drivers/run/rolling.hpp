#pragma once
// The rolling stage of a run's process: stepping, samples, checkpoints, frames, requests of other processes,
// limits.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "core/parallel/background_task.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/process/core_watch.hpp"
#include "drivers/results/frame_files.hpp"
#include "drivers/results/growing_files.hpp"
#include "drivers/results/run_results.hpp"
#include "drivers/run/followers.hpp"
#include "drivers/run/run_session.hpp"

namespace tread {

class Rolling {
 public:
  Rolling(RunSession& session, Model& model, RunResults& results);

  /// Begins from the preload in the results.
  void begin();
  /// Goes on from a checkpoint whose results have been unpacked.
  void go_on(const SealedContent& checkpoint);

  /// Steps to the end and fills the results. Throws NumericalError and ResourceError whose texts name the
  /// remaining files and the way on. Throws Interrupted after a signal, a request or stop.wall_time.
  void to_the_end();

 private:
  /// Instant of a checkpoint.
  struct Mark {
    std::int64_t steps;
    double time;  ///< [s]
  };
  /// Makes the simulation of a run's content.
  void restore(const SealedContent& run);
  void begin_ranks();
  /// Deals the work out among the ranks anew, where that saves time.
  void even_ranks();
  SealedContent pack_all(std::string patch);
  void step_to_the_end();
  void keep_sample();
  void look();
  void check_penetration();
  void obey_request();
  void check_disk();
  void keep_for_forks();
  bool checkpoint_is_due(double share) const;
  bool write_checkpoint();
  void keep_the_end();
  bool write_frame();
  void wait_for_writer();
  void leave(const std::string& why);
  template <class E>
  [[noreturn]] void end(const std::string& why);
  template <class E>
  [[noreturn]] void end_with_what_is_left(const std::string& why);
  template <class E>
  std::string how_to_go_on() const;
  void close_quietly();
  /// Throws ResourceError where a growing file has lost its name.
  void require_files() const;
  /// Says once if the threads often have to wait for a core.
  void notice_busy_cores();
  std::string progress_line() const;
  std::string status() const;
  double seconds() const;       ///< time of rolling, earlier processes included [s]
  double step_seconds() const;  ///< of a step in the mean [s]
  double seconds_left() const;  ///< that the steps to come take [s]
  void fill_results();

  RunSession* session_;
  Model* model_;
  RunResults* results_;
  std::optional<Simulation> simulation_;
  Followers followers_;
  std::optional<GrowingFiles> files_;
  std::optional<FrameFiles> frames_;
  std::int64_t end_ = 0;                   ///< steps of the whole run
  std::optional<std::int64_t> fork_step_;  ///< step whose state is kept for other runs
  double started_ = 0;                     ///< start on the session's clock [s]
  std::int64_t started_steps_ = 0;
  double stepping_ = 0;  ///< time of the steps and their samples since then [s]
  CoreWatch cores_;      ///< processor time since then
  bool noticed_busy_cores_ = false;
  double seconds_before_ = 0;  ///< time that earlier processes rolled [s]
  /// Last look into the folder on the session's clock; the first one is at once. [s]
  double looked_at_ = -std::numeric_limits<double>::infinity();
  double checkpoint_at_ = 0;     ///< last checkpoint on the session's clock [s]
  std::optional<Mark> written_;  ///< last checkpoint that is safe
  std::optional<Mark> being_written_;
  bool answers_ = false;   ///< the writer does what another process asked for
  BackgroundTask writer_;  ///< writes checkpoints and frames in turn: a checkpoint's frames are safe
};

}  // namespace tread
