#include "drivers/run/run_control.hpp"

#include <fmt/core.h>

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/error.hpp"
#include "drivers/process/standard_files.hpp"
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

/// End of a sentence on a folder without a process.
std::string waiting_text(const std::filesystem::path& folder) {
  return is_resumable(folder) ? fmt::format("; {} goes on with the run", resume_text(folder))
                              : ", and no run waits there";
}

/// status.json as the last process left it, and the truth about the folder: a process that was killed still
/// says there what it did. Throws Interrupted if no process works on a run that `tread resume` goes on with.
void print_status(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "status.json";
  Json status = Json::parse(read_text_file(file, kLargestStatus), nullptr, false);
  if (!status.is_object())
    throw InputError(fmt::format("{}: not a JSON object, so no status of a run", file.string()));
  const bool alive = is_taken(folder);
  const bool resumable = !alive && is_resumable(folder);
  status["alive"] = alive;
  status["resumable"] = resumable;
  fmt::print("{}", json_text(status));
  if (resumable)
    throw Interrupted(
        fmt::format("no process works on {}: {} goes on", folder.string(), resume_text(folder)));
  if (!alive) print_error(fmt::format("tread: no process works on {}\n", folder.string()));
}

}  // namespace

void control_run(const CtlOptions& options) {
  const std::filesystem::path& folder = options.folder;
  require_run_folder(folder);
  if (options.action == "status") {
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
  const bool unread = is_pending(folder) && !is_taken(folder);
  if (unread) withdraw_request(folder);
  if (unread && !stop)
    throw InputError(fmt::format("the run in {} ended before it read the request{}", folder.string(),
                                 waiting_text(folder)));
  fmt::print("{}: {}\n", folder.string(),
             unread ? "had ended before it read the request"
             : stop ? "stopped"
                    : "writes a " + options.action);
}

}  // namespace tread
