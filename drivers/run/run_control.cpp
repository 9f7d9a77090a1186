#include "drivers/run/run_control.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <thread>

#include "core/error.hpp"
#include "drivers/process/standard_files.hpp"
#include "drivers/run/point_state.hpp"
#include "drivers/run/run_folder.hpp"
#include "io/files/checkpoint_folder.hpp"
#include "io/text/json.hpp"
#include "io/text/text_file.hpp"

namespace tread {

namespace {

constexpr std::size_t kLargestStatus = 1 << 24;  // [B]: a study has a line a point

bool wait_until(const std::function<bool()>& condition, double patience) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

/// Returns true if the folder holds a run that `tread resume` goes on with.
bool is_resumable(const std::filesystem::path& folder) {
  return CheckpointFolder(folder / kCheckpointFolder).holds_run();
}

/// status.json as the last process left it. Throws InputError where there is none.
Json read_status(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "status.json";
  Json status = Json::parse(read_text_file(file, kLargestStatus), nullptr, false);
  if (!status.is_object())
    throw InputError(fmt::format("{}: not a JSON object, so no status of a run", file.string()));
  return status;
}

std::string text_at(const Json& object, const char* key) {
  const Json none;
  const Json& value = object.is_object() && object.contains(key) ? object[key] : none;
  return value.is_string() ? value.get<std::string>() : "";
}

std::int64_t count_at(const Json& status, const char* key) {
  return status.contains(key) && status[key].is_number_integer() ? status[key].get<std::int64_t>() : 0;
}

/// Points that a killed study says are running, and that no process works on, get the state of their folders.
void correct_points(const std::filesystem::path& folder, Json& status) {
  if (!status.contains("points") || !status["points"].is_array()) return;
  for (Json& point : status["points"]) {
    if (text_at(point, "state") != "running") continue;
    const std::filesystem::path place = folder / text_at(point, "name");
    std::error_code ignored;
    if (std::filesystem::is_directory(place, ignored) && is_taken(place)) continue;
    const char* state = name_of(state_left_in(place));
    point["state"] = state;
    status["running"] = count_at(status, "running") - 1;
    status[state] = count_at(status, state) + 1;
  }
}

/// The command that goes on with the run in the folder, or with the study that left the status; empty: none.
std::string going_on(const std::filesystem::path& folder, const Json& status) {
  if (is_resumable(folder)) return resume_text(folder);
  if (count_at(status, "waiting") + count_at(status, "interrupted") + count_at(status, "running") == 0)
    return "";
  const std::string line = text_at(status, "command_line");
  return line.empty() ? "the same command" : fmt::format("`{}`", line);
}

/// The same; empty where there is none.
Json status_if_any(const std::filesystem::path& folder) {
  try {
    return read_status(folder);
  } catch (const InputError&) {  // it may hold a run that has shown none
    return Json::object();
  }
}

/// End of a sentence on a folder without a process.
std::string waiting_text(const std::filesystem::path& folder) {
  const std::string command = going_on(folder, status_if_any(folder));
  return command.empty() ? ", and no run waits there" : fmt::format("; {} goes on", command);
}

/// Prints the status and the truth about the folder: a process that was killed still says there what it did.
/// Throws Interrupted if no process works on a run or study that a command goes on with.
void print_status(const std::filesystem::path& folder) {
  Json status = read_status(folder);
  const bool alive = is_taken(folder);
  if (!alive) correct_points(folder, status);
  const std::string command = alive ? "" : going_on(folder, status);
  status["alive"] = alive;
  status["resumable"] = !command.empty();
  fmt::print("{}", json_text(status));
  if (!command.empty())
    throw Interrupted(fmt::format("no process works on {}: {} goes on", folder.string(), command));
  if (!alive) print_error(fmt::format("tread: no process works on {}\n", folder.string()));
}

/// Answer to a request of a checkpoint or frame: a study passes the request on.
std::string written_text(const std::filesystem::path& folder, const std::string& action) {
  return fmt::format("{} a {}", status_if_any(folder).contains("points") ? "its runs write" : "has written",
                     action);
}

}  // namespace

void control_run(const CtlOptions& options) {
  const std::filesystem::path& folder = options.folder;
  require_run_folder(folder);
  if (options.action == "status") {
    if (!std::filesystem::exists(folder / "status.json"))
      throw InputError(is_taken(folder)
                           ? fmt::format("a process works on {} and has shown no status yet; ask "
                                         "again in a moment",
                                         folder.string())
                           : no_run_text(folder));
    print_status(folder);
    return;
  }
  if (!is_taken(folder))
    throw InputError(fmt::format("no process works on {}{}", folder.string(), waiting_text(folder)));
  const bool stop = options.action == "stop";
  leave_request(folder, stop                        ? RunRequest::stop
                        : options.action == "frame" ? RunRequest::frame
                                                    : RunRequest::checkpoint);
  const auto answered = [&] { return (!stop && !is_pending(folder)) || !is_taken(folder); };
  if (!wait_until(answered, options.patience))
    throw ResourceError(fmt::format(
        "the run in {} has not answered for {:g} s; the request still lies there. In "
        "the preload it stops at the next iteration of Newton's method and answers other requests "
        "after the first steps",
        folder.string(), options.patience));
  const bool ignored = is_pending(folder) && !is_taken(folder);
  if (ignored) withdraw_request(folder);
  if (ignored && !stop)
    throw InputError(fmt::format("the run in {} ended before it had written a {}{}", folder.string(),
                                 options.action, waiting_text(folder)));
  const std::string done = stop ? "stopped" : written_text(folder, options.action);
  fmt::print("{}: {}\n", folder.string(), ignored ? "had ended before it read the request" : done);
}

}  // namespace tread
