#include "drivers/studies/study/point_folder.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "drivers/engine/model/sections.hpp"
#include "drivers/process/interruption.hpp"
#include "io/files/checkpoint_folder.hpp"
#include "io/files/output_file.hpp"
#include "io/text/json.hpp"
#include "io/text/text_file.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

/// The end of a log, at most 4000 B from `first` [B] on.
std::string end_of_log(const fs::path& log, std::int64_t first) {
  constexpr std::streamoff kEnd = 4000;  // [B]
  std::ifstream stream(log, std::ios::binary | std::ios::ate);
  if (!stream) return "";
  const std::streamoff size = stream.tellg();
  const std::streamoff begin = std::max({std::streamoff{0}, size - kEnd, static_cast<std::streamoff>(first)});
  if (begin >= size) return "";
  stream.seekg(begin);
  std::string text(static_cast<std::size_t>(size - begin), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
}

bool is_warning(const std::string& line) {
  return line.find("warning: ") != std::string::npos;
}

/// The error in a line, behind "tread: " or the command, "tread run: "; nothing in other lines.
std::optional<std::string> error_in(const std::string& line) {
  constexpr std::string_view kName = "tread";
  constexpr std::ptrdiff_t kWords = 2;  // of a command
  if (is_warning(line)) return std::nullopt;
  for (std::size_t at = line.find(kName); at != std::string::npos; at = line.find(kName, at + 1)) {
    const std::size_t words = at + kName.size();
    const std::size_t end = line.find_first_not_of("abcdefghijklmnopqrstuvwxyz- ", words);
    if (end == std::string::npos || line.compare(end, 2, ": ") != 0) continue;
    if ((at > 0 && line[at - 1] != ' ') || (end > words && line[words] != ' ')) continue;
    const std::string_view between = std::string_view(line).substr(words, end - words);
    if (std::count(between.begin(), between.end(), ' ') <= kWords) return line.substr(end + 2);
  }
  return std::nullopt;
}

/// The last error that a process has written behind the first bytes of the log, with the lines that follow.
std::string last_words(const fs::path& log, std::int64_t first) {
  std::istringstream lines(end_of_log(log, first));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (std::optional<std::string> error = error_in(line))
      text = std::move(*error);
    else if (!text.empty() && !is_warning(line))
      text += " " + line;
  }
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

/// Returns true if another attempt would come to the same end. Missing resources may be available at the next
/// attempt; other codes are a launcher's, which says nothing of the run.
bool leads_to_the_same_end(std::optional<double> code) {
  return code == static_cast<double>(ExitCode::input) || code == static_cast<double>(ExitCode::numerical);
}

bool asks_to_stop(int signal) {
  return std::ranges::find(kStopSignals, signal, &StopSignal::number) != std::end(kStopSignals);
}

/// Returns true for an exit code by which shells and `timeout` say that they passed such a signal on.
bool tells_of_a_stop(int code) {
  constexpr int kTimeout = 124;
  constexpr int kSignals = 128;
  return code == kTimeout || asks_to_stop(code - kSignals);
}

bool is_own_failure(int code) {
  for (const ExitCode own : {ExitCode::input, ExitCode::numerical, ExitCode::resources})
    if (code == static_cast<int>(own)) return true;
  return false;
}

/// Stage in the text of a status.json; empty if it has none.
std::string stage_in(const std::string& status) {
  try {
    return status.empty() ? "" : text_in(parse_json(status, "status.json"), "stage");
  } catch (const InputError&) {
    return "";
  }
}

std::string reason(const fs::path& folder, const PointProcess& process) {
  const ProcessEnd& end = process.end;
  if (end.signal != 0)
    return fmt::format("signal {} ({}) ended it{}", end.signal, ::strsignal(end.signal),
                       end.signal == SIGKILL ? "; the system ends processes when memory is short" : "");
  const std::string words = last_words(log_of(folder), process.log_before);
  return fmt::format("exit {}: {}", end.code, words.empty() ? "see log.txt in its folder" : words);
}

/// Finds why the run in the folder is not that of the scene, and which state the run keeps.
void look_at_scene(const fs::path& folder, const SceneContent& scene, const SceneFiles& files,
                   PointStatus& status) {
  try {
    const KeptScene there = kept_scene(folder, files);
    status.why = difference(scene, there.content);
    if (there.resolved.scene.forks) status.keeps_at = there.resolved.scene.forks->at;
    status.room = depth_room(there.resolved.scene);
    status.process = process_values(there.resolved);
  } catch (const InputError& error) {
    status.why = fmt::format("its scene does not read: {}", error.what());
  }
  status.foreign = !status.why.empty();
}

void write_failure(const fs::path& folder, const ProcessEnd& end, const std::string& why) {
  try {
    create_folder(folder);
    write_text_file(folder / kFailure, json_text({{"exit", end.code},
                                                  {"signal", end.signal},
                                                  {"why", why},
                                                  {"anew", leads_to_the_same_end(end.code)}}));
  } catch (const ResourceError& error) {
    throw ResourceError(fmt::format("{} ({})", why, error.what()));
  }
}

/// Record of the failure in the folder; one that does not read tells of no cause that would come again.
JsonRecord failure_in(const fs::path& folder) {
  try {
    return read_json(folder / kFailure);
  } catch (const InputError&) {
    return {{"why", fmt::format("its {} does not read", kFailure)}};
  }
}

}  // namespace

ExitCode failed_exit_code(std::optional<double> code) {
  for (const ExitCode known : {ExitCode::input, ExitCode::numerical})
    if (code && *code == static_cast<double>(known)) return known;
  return ExitCode::resources;
}

SceneContent process_values(const ResolvedScene& scene) {
  return content_of(scene, [](Effects effects) { return effects.only({Effect::process, Effect::stop}); });
}

PointStatus look_into(const fs::path& folder, const SceneContent& scene, const SceneFiles& files) {
  PointStatus status;
  status.state = state_left_in(folder);
  const bool begun = CheckpointFolder(folder / "checkpoint").holds_run();
  const bool stated = fs::exists(folder / kKeptScene);
  if (stated && (begun || status.state == PointState::done)) look_at_scene(folder, scene, files, status);
  if (status.state == PointState::failed) {
    const JsonRecord failure = failure_in(folder);
    if (!status.foreign) status.why = text_in(failure, "why");
    status.code = failed_exit_code(number_in(failure, "exit"));
    status.anew = !begun || (truth_in(failure, "anew") && leads_to_the_same_end(number_in(failure, "exit")));
  }
  return status;
}

std::string shown_status(const fs::path& folder) {
  constexpr std::size_t kLargest = 1 << 20;  // [B]
  try {
    return read_text_file(folder / "status.json", kLargest);
  } catch (const InputError&) {
    return "";
  }
}

bool was_stopped(const fs::path& folder, const PointProcess& process) {
  const ProcessEnd& end = process.end;
  if (end.signal == 0 && end.code == static_cast<int>(ExitCode::resumable)) return true;
  // An older status tells of an older process.
  const std::string status = shown_status(folder);
  const std::string stage = status == process.status_before ? "" : stage_in(status);
  if (stage == "failed") return false;
  if (stage == "stopped" && CheckpointFolder(folder / "checkpoint").holds_run()) return true;
  // A signal before the process has its handlers, or the launcher's own.
  if (end.signal != 0) return process.told_to_stop && asks_to_stop(end.signal);
  return tells_of_a_stop(end.code) || (process.told_to_stop && !is_own_failure(end.code));
}

void note_end(const fs::path& folder, const PointProcess& process) {
  const ProcessEnd& end = process.end;
  const bool done = end.signal == 0 && end.code == static_cast<int>(ExitCode::done);
  if (done || was_stopped(folder, process)) return forget_failure(folder);
  write_failure(folder, end, reason(folder, process));
}

void note_failure(const fs::path& folder, ExitCode code, const std::string& why) {
  write_failure(folder, {static_cast<int>(code), 0}, why);
}

fs::path log_of(const fs::path& folder) {
  return folder / "log.txt";
}

std::int64_t log_bytes(const fs::path& folder) {
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(log_of(folder), error);
  return error ? 0 : static_cast<std::int64_t>(bytes);
}

}  // namespace tread
