#include "drivers/run/run_control.hpp"

#include <fmt/core.h>

#include <chrono>
#include <functional>
#include <thread>

#include "core/error.hpp"
#include "drivers/run/run_folder.hpp"
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

void print_status(const std::filesystem::path& folder) {
  fmt::print("{}", read_text_file(folder / "status.json", kLargestStatus));
  if (!is_taken(folder)) fmt::print(stderr, "tread: no process works on {} now\n", folder.string());
}

}  // namespace

void control_run(const CtlOptions& options) {
  const std::filesystem::path& folder = options.folder;
  if (!std::filesystem::is_directory(folder))
    throw InputError(
        fmt::format("there is no folder {}: give the one that `tread run -o` was given", folder.string()));
  if (options.action == "status") {
    print_status(folder);
    return;
  }
  if (!is_taken(folder))
    throw InputError(
        fmt::format("no process works on {}; `tread resume {}` goes on with a run that was stopped",
                    folder.string(), folder.string()));
  const bool stop = options.action == "stop";
  leave_request(folder, stop                        ? RunRequest::stop
                        : options.action == "frame" ? RunRequest::frame
                                                    : RunRequest::checkpoint);
  const auto answered = [&] { return stop ? !is_taken(folder) : !is_pending(folder); };
  if (!wait_until(answered, options.patience))
    throw ResourceError(fmt::format(
        "the run in {} has not answered for {:g} s; the request still lies there. In "
        "the preload it stops at the next iteration of Newton's method and answers other requests "
        "after the first steps",
        folder.string(), options.patience));
  fmt::print("{}: {}\n", folder.string(), stop ? "stopped" : "writes a " + options.action);
}

}  // namespace tread
