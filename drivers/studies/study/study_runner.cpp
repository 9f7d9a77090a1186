#include "drivers/studies/study/study_runner.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "drivers/process/interruption.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/studies/study/shared_rolling.hpp"
#include "io/files/output_file.hpp"
#include "io/scene/schema.hpp"
#include "io/text/json.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

constexpr double kShowInterval = 5;                    ///< [s]
constexpr auto kLook = std::chrono::milliseconds(50);  ///< time between looks at the children

/// The status of the run; empty before its first one.
JsonRecord status_of(const PlannedPoint& point) {
  try {
    return read_json(point.folder / "status.json");
  } catch (const InputError&) {
    return {};
  }
}

int count(const StudyPlan& plan, PointState state) {
  return static_cast<int>(
      std::count_if(plan.points.begin(), plan.points.end(),
                    [state](const PlannedPoint& point) { return point.status.state == state; }));
}

/// Fails a point whose folder keeps no record of it.
void fail_unrecorded(PlannedPoint& point, ExitCode code, std::string why) {
  point.status.state = PointState::failed;
  point.status.why = std::move(why);
  point.status.code = code;
}

}  // namespace

std::vector<std::string> place_arguments(const StudyPlan& plan, int count, int card) {
  std::vector<std::string> place;
  if (count > 0) place = {"-t", std::to_string(count)};
  const std::string device = card < 0 ? plan.device : fmt::format("gpu:{}", card);
  if (!device.empty()) place.insert(place.end(), {"--device", device});
  return place;
}

std::vector<std::string> changed_arguments(const PlannedPoint& point) {
  const SceneContent& there = point.status.process;
  if (there.empty()) return {};
  SceneContent here = process_values(point.resolved);
  for (const auto& [path, value] : there)
    if (const Key key = *find_key(path); key.quantity)
      here.try_emplace(path, fmt::format("{} {}", key.range.high, key.quantity->si));
  std::vector<std::string> arguments;
  for (const auto& [path, value] : here) {
    const auto found = there.find(path);
    if (found == there.end() || found->second != value)
      arguments.insert(arguments.end(), {"--set", fmt::format("{}={}", path, value)});
  }
  return arguments;
}

std::vector<std::string> point_arguments(const StudyPlan& plan, const PlannedPoint& point, int count,
                                         int card) {
  const PointStatus& status = point.status;
  const std::vector<std::string> place = place_arguments(plan, count, card);
  const bool failed = status.state == PointState::failed;
  std::vector<std::string> arguments;
  if (status.state == PointState::interrupted || (failed && !status.anew)) {
    arguments = {"resume", point.folder.string()};
    arguments.insert(arguments.end(), place.begin(), place.end());
    const std::vector<std::string> changed = changed_arguments(point);
    arguments.insert(arguments.end(), changed.begin(), changed.end());
    return arguments;
  }
  arguments = {"run", plan.study.scene.string()};
  for (const std::string& text : point.overrides) arguments.insert(arguments.end(), {"--set", text});
  arguments.insert(arguments.end(), {"-o", point.folder.string()});
  arguments.insert(arguments.end(), place.begin(), place.end());
  if (!point.from.empty()) arguments.insert(arguments.end(), {"--from", point.from});
  if (failed) arguments.emplace_back("--overwrite");
  const std::vector<std::string> sharing = sharing_arguments(plan, point);
  arguments.insert(arguments.end(), sharing.begin(), sharing.end());
  return arguments;
}

StudyRunner::StudyRunner(StudyPlan& plan, const RunFolder& folder, Progress& progress, StudyLabel label)
    : plan_(&plan), folder_(&folder), progress_(&progress), label_(std::move(label)) {}

std::string StudyRunner::run(bool retry) {
  for (PlannedPoint& point : plan_->points)
    if (point.to_run(retry)) queue_.push_back(&point);
  for (;;) {
    obey();
    while (stopped_by_.empty()) {
      const int threads = threads_for_next();
      PlannedPoint* point = threads > 0 ? take_next() : nullptr;
      if (!point) break;
      start(*point, threads);
    }
    if (progress_->due(kShowInterval)) show();
    if (running_.empty()) break;
    std::this_thread::sleep_for(kLook);
    collect_ended();
  }
  show();
  return stopped_by_;
}

/// Threads for the next run: the idle cores are dealt out among the points that can begin; 0 if there is
/// none.
int StudyRunner::threads_for_next() const {
  const auto ready = std::count_if(queue_.begin(), queue_.end(), [this](const PlannedPoint* point) {
    return !waits_for_state(*plan_, *point);
  });
  const int beginning = std::min(static_cast<int>(ready), plan_->jobs - static_cast<int>(running_.size()));
  if (beginning <= 0) return 0;
  if (plan_->threads > 0 || !plan_->launcher.empty()) return std::max(1, plan_->threads);
  int idle = machine_cores();
  for (const Running& running : running_) idle -= running.threads;
  return idle > 0 ? std::max(1, idle / beginning) : 0;
}

/// Takes the first point that waits for no other; nullptr if there is none.
PlannedPoint* StudyRunner::take_next() {
  const auto next = std::find_if(queue_.begin(), queue_.end(), [this](const PlannedPoint* point) {
    return !waits_for_state(*plan_, *point);
  });
  if (next == queue_.end()) return nullptr;
  PlannedPoint* point = *next;
  queue_.erase(next);
  return point;
}

/// The first card on which no run is; -1 where the plan names one, or none.
int StudyRunner::free_card() const {
  if (plan_->cards <= 1) return -1;
  const std::vector<int> cards = gpu_numbers();
  return *std::find_if(cards.begin(), cards.end(), [this](int card) {
    return std::none_of(running_.begin(), running_.end(),
                        [card](const Running& running) { return running.card == card; });
  });
}

/// Starts the point's process. A folder without use or a missing process fails this point alone.
void StudyRunner::start(PlannedPoint& point, int threads) {
  try {
    begin(point, threads);
  } catch (const ResourceError& error) {
    fail_unrecorded(point, error.code(), fmt::format("not begun: {}", error.what()));
    progress_->say(fmt::format("[{}] {}", point.name, point.status.why));
    leave_state_to_others(point);
  }
}

void StudyRunner::begin(PlannedPoint& point, int threads) {
  create_folder(point.folder);
  if (is_taken(point.folder)) {
    point.status = {PointState::running, "another process works on its folder"};
    progress_->say(fmt::format("[{}] left alone: {}", point.name, point.status.why));
    return;
  }
  // Elsewhere a run takes all cores that it is given.
  const int card = free_card();
  const std::vector<std::string> arguments =
      point_arguments(*plan_, point, plan_->launcher.empty() ? threads : plan_->threads, card);
  std::string before = shown_status(point.folder);
  const std::int64_t log_before = log_bytes(point.folder);
  progress_->say(fmt::format("[{}] {}", point.name, arguments[0] == "run" ? "begins" : "goes on"));
  running_.push_back({&point, ChildProcess(arguments, log_of(point.folder), plan_->launcher, plan_->jobs > 1),
                      threads, card, progress_->seconds(), std::move(before), log_before});
  point.status = {PointState::running, ""};
}

void StudyRunner::collect_ended() {
  for (std::size_t i = 0; i < running_.size();) {
    Running& running = running_[i];
    ProcessEnd end;
    if (!running.end && running.process.ended(end)) running.end = end;
    // A launcher that ends by itself may leave the run to go on.
    if (!running.end || (!plan_->launcher.empty() && is_taken(running.point->folder))) {
      ++i;
      continue;
    }
    note_ended(running);
    running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// Returns true from the signal or the request on, even if obey() has not seen it yet.
bool StudyRunner::is_being_stopped() const {
  return !stopped_by_.empty() || Interruption::stop_wanted();
}

/// Looks at the point again after `keep` has left its end in the folder. A full disk, which lets a point fail
/// with `code` but without a record, must not end the study before its runs.
void StudyRunner::note(PlannedPoint& point, ExitCode code, const std::function<void()>& keep) {
  std::string unkept;
  try {
    keep();
  } catch (const ResourceError& error) {
    unkept = error.what();
  }
  point.status = look_into(point.folder, point.content, point.resolved.source.files);
  if (!unkept.empty()) fail_unrecorded(point, code, std::move(unkept));
}

void StudyRunner::note_ended(const Running& running) {
  PlannedPoint& point = *running.point;
  note(point, failed_exit_code(running.end->code), [&] {
    note_end(point.folder, {*running.end, is_being_stopped(), running.status_before, running.log_before});
  });
  if (!plan_->launcher.empty()) withdraw_request(point.folder);
  if (point.status.foreign)
    point.status = {PointState::failed, "the scene has changed since the study began: " + point.status.why};
  const std::string time = duration_text(progress_->seconds() - running.started);
  const std::string why = point.status.why.empty() ? "" : ": " + point.status.why;
  progress_->say(fmt::format("[{}] {} after {}{}", point.name, name_of(point.status.state), time, why));
  leave_state_to_others(point);
}

/// Lets another point keep the state that a failed one was to keep, or fails the points that need it.
void StudyRunner::leave_state_to_others(PlannedPoint& point) {
  for (PlannedPoint* other : replace_keeper(*plan_, point)) {
    if (std::erase(queue_, other) == 0) continue;
    fail_with(point, *other);
  }
}

/// Fails a point that would come to the same end as `keeper`, with whose state it was to begin.
void StudyRunner::fail_with(const PlannedPoint& keeper, PlannedPoint& point) {
  note(point, keeper.status.code, [&] {
    note_failure(point.folder, keeper.status.code,
                 fmt::format("not begun: up to {:.6g} ms it is the run of {}, which failed before: {}",
                             1e3 * plan_->shared[*point.shared].until, keeper.name, keeper.status.why));
  });
  progress_->say(fmt::format("[{}] {}", point.name, point.status.why));
}

void StudyRunner::obey() {
  if (!stopped_by_.empty()) return pass_on_stop();
  if (const char* signal = Interruption::stop_wanted()) stop(signal);
  bool checkpoint = Interruption::take_checkpoint_wanted();
  const std::optional<RunRequest> request = folder_->take_request();
  if (request == RunRequest::stop) stop("tread ctl");
  checkpoint = checkpoint || request == RunRequest::checkpoint;
  if (request == RunRequest::frame)
    for (const Running& running : running_)
      if (owns_folder(running)) leave(running, RunRequest::frame);
  if (checkpoint) ask_for_checkpoints();
  if (request) folder_->answer_request();
}

void StudyRunner::ask_for_checkpoints() {
  for (const Running& running : running_) {
    if (plan_->launcher.empty())
      running.process.send(SIGUSR1);
    else if (owns_folder(running))  // the signal would end a launcher that does not pass it on
      leave(running, RunRequest::checkpoint);
  }
}

void StudyRunner::stop(const std::string& why) {
  stopped_by_ = why;
  progress_->say(fmt::format("[{}] {}: waiting until {} runs have left a checkpoint", label_.command, why,
                             running_.size()));
  for (const Running& running : running_) {
    if (running.end) continue;
    // Until the run takes its folder, nothing but the signal reaches it behind its launcher. A launcher may
    // end a run that it signals before the checkpoint is written.
    if (plan_->launcher.empty())
      running.process.send(SIGTERM);
    else if (!owns_folder(running))
      running.process.send_to_group(SIGTERM);
  }
  pass_on_stop();
}

/// Returns true once the run shows that it has taken its folder, which forgets earlier requests then.
bool StudyRunner::owns_folder(const Running& running) {
  return shown_status(running.point->folder) != running.status_before;
}

/// Leaves the request to stop in the folders of launched runs that can read it by now.
void StudyRunner::pass_on_stop() {
  if (plan_->launcher.empty()) return;
  for (Running& running : running_) {
    if (running.asked || !owns_folder(running)) continue;
    running.asked = true;
    if (!leave(running, RunRequest::stop)) running.process.send_to_group(SIGTERM);
  }
}

/// Returns whether the request reaches the run. A full disk must not end the study before its runs.
bool StudyRunner::leave(const Running& running, RunRequest request) const {
  try {
    leave_request(running.point->folder, request);
    return true;
  } catch (const ResourceError& error) {
    progress_->say(fmt::format("[{}] no request reaches it: {}", running.point->name, error.what()));
    return false;
  }
}

double StudyRunner::seconds_left() const {
  // Work in core-time: costs are those of the plan's threads, or of one.
  const int each = std::max(1, plan_->threads);
  const int workers = plan_->threads > 0 ? plan_->jobs * each : machine_cores();
  double sum = 0;
  double longest = 0;
  const auto add = [&](double seconds, int threads) {
    sum += seconds * threads;
    longest = std::max(longest, seconds);
  };
  for (const PlannedPoint* point : queue_) {
    const double seconds = point->cost ? point->cost->seconds() : 0;
    plan_->threads > 0 ? add(seconds, each) : add(seconds / workers, workers);
  }
  for (const Running& running : running_) {
    const double whole = running.point->cost ? running.point->cost->seconds() : 0;
    const double guess =
        std::max(0.0, whole * each / running.threads - (progress_->seconds() - running.started));
    add(number_in(status_of(*running.point), "left_s").value_or(guess), running.threads);
  }
  return std::max(longest, sum / workers);
}

void StudyRunner::show() {
  const StudyPlan& plan = *plan_;
  const double left = seconds_left();
  std::string line =
      fmt::format("[{}] {} of {} done", label_.command, label_.before + count(plan, PointState::done),
                  label_.before + static_cast<int>(plan.points.size()) + label_.after);
  if (const int failed = count(plan, PointState::failed)) line += fmt::format(", {} failed", failed);
  Json json = {{"stage", running_.empty() ? "ended" : label_.command},
               {"command", label_.command},
               {"command_line", label_.line},
               {"process", ::getpid()}};
  for (const PointState state : {PointState::waiting, PointState::interrupted, PointState::running,
                                 PointState::done, PointState::failed}) {
    const int others = state == PointState::done      ? label_.before
                       : state == PointState::waiting ? label_.after
                                                      : 0;
    json[name_of(state)] = others + count(plan, state);
  }
  json["left_s"] = left;
  json["points"] = Json::array();
  for (const PlannedPoint& point : plan.points) {
    Json one = {{"name", point.name}, {"state", name_of(point.status.state)}};
    if (!point.status.why.empty()) one["why"] = point.status.why;
    json["points"].push_back(one);
  }
  folder_->show_status(json_text(json));
  for (const Running& running : running_) {
    const JsonRecord status = status_of(*running.point);
    const auto time = number_in(status, "time_s");
    const auto duration = number_in(status, "duration_s");
    line += fmt::format(
        "  {}: {}", running.point->name,
        time && duration ? fmt::format("{:.1f} %", 100 * *time / *duration) : text_in(status, "stage"));
  }
  if (!running_.empty()) line += fmt::format("  ETA {}", duration_text(left));
  progress_->say(line);
}

}  // namespace tread
