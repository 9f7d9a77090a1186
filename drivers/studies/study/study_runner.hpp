#pragma once
// The runs of a study as child processes, as many at once as the plan allows.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drivers/process/child_process.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/studies/study/study_plan.hpp"

namespace tread {

/// Name and count in progress lines, "[develop] 3 of 10 done", and in status.json.
struct StudyLabel {
  std::string command = "sweep";
  std::string line = {};  ///< command as typed
  int before = 0;         ///< runs that were done before those of the plan
  int after = 0;          ///< runs that follow those of the plan
};

/// Runs the points: a point begins with `tread run`, with another one's state if rolling is shared, and goes
/// on with `tread resume`. Owns the study's folder by `folder` and shows status.json there; obeys `tread
/// ctl`. A stop, by signal or request, is passed to the children, which leave a checkpoint each; where a
/// launcher starts them, to their folders once they own these, since it may keep signals to itself or end the
/// run by them.
class StudyRunner {
 public:
  StudyRunner(StudyPlan& plan, const RunFolder& folder, Progress& progress, StudyLabel label);

  /// Runs until every point has ended or the study is stopped; fills the points' status. Returns the reason
  /// of a stop, empty without one. `retry`: failed points run, too.
  std::string run(bool retry);

 private:
  struct Running {
    PlannedPoint* point;
    ChildProcess process;
    int threads;
    int card;                            ///< StudyPlan::cards; -1: none of its own
    double started;                      ///< start on the clock of the progress [s]
    std::string status_before;           ///< PointProcess::status_before
    std::int64_t log_before;             ///< PointProcess::log_before [B]
    std::optional<ProcessEnd> end = {};  ///< end of a process whose run may go on elsewhere
    bool asked = false;                  ///< true once the folder has the request to stop
  };
  int threads_for_next() const;
  PlannedPoint* take_next();
  int free_card() const;
  void start(PlannedPoint& point, int threads);
  void begin(PlannedPoint& point, int threads);
  void collect_ended();
  void note_ended(const Running& running);
  static void note(PlannedPoint& point, ExitCode code, const std::function<void()>& keep);
  bool is_being_stopped() const;
  static bool owns_folder(const Running& running);
  void leave_state_to_others(PlannedPoint& point);
  void fail_with(const PlannedPoint& keeper, PlannedPoint& point);
  void obey();
  void ask_for_checkpoints();
  void stop(const std::string& why);
  void pass_on_stop();
  bool leave(const Running& running, RunRequest request) const;
  void show();
  double seconds_left() const;

  StudyPlan* plan_;
  const RunFolder* folder_;
  Progress* progress_;
  StudyLabel label_;
  std::vector<PlannedPoint*> queue_;  ///< waiting points, the next one first
  std::vector<Running> running_;
  std::string stopped_by_;
};

/// Threads and device of a run on a command line; as point_arguments().
std::vector<std::string> place_arguments(const StudyPlan& plan, int threads, int card = -1);

/// Arguments of `tread resume` for the process_values() in which the study differs from the run in the
/// point's folder. A limit that the study does not state is as wide as its key allows.
std::vector<std::string> changed_arguments(const PlannedPoint& point);

/// Command line of a point after "tread"; `threads` of 0 are not stated. `card`: in place of the plan's
/// device unless below 0.
std::vector<std::string> point_arguments(const StudyPlan& plan, const PlannedPoint& point, int threads,
                                         int card = -1);

}  // namespace tread
