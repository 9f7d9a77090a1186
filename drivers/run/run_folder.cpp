#include "drivers/run/run_folder.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "io/files/output_file.hpp"
#include "io/text/json.hpp"
#include "io/text/text.hpp"
#include "io/text/text_file.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

constexpr const char* kRequest = "request";
constexpr const char* kTaken = "request.taken";
constexpr const char* kStatus = "status.json";

/// Locks the folder. Throws ResourceError if another process owns it, for longer than is_taken() does.
FileLock take(const fs::path& folder) {
  constexpr int kAttempts = 10;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (attempt > 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (std::optional<FileLock> lock = FileLock::try_folder(folder)) return std::move(*lock);
  }
  throw ResourceError(fmt::format(
      "another process works on {}: `tread ctl {} status` shows it, `tread ctl {} stop` ends it; or "
      "choose another folder",
      folder.string(), shell_word(folder.string()), shell_word(folder.string())));
}

const char* name_of(RunRequest request) {
  switch (request) {
    case RunRequest::checkpoint:
      return "checkpoint";
    case RunRequest::frame:
      return "frame";
    case RunRequest::stop:
      break;
  }
  return "stop";
}

/// Request in the file; nullopt for anything that leave_request() did not write.
std::optional<RunRequest> read_request(const fs::path& path) {
  std::string text;
  try {
    constexpr std::size_t kLongest = 100;
    text = read_text_file(path, kLongest);
  } catch (const InputError&) {
    return std::nullopt;
  }
  for (const RunRequest request : {RunRequest::checkpoint, RunRequest::frame, RunRequest::stop})
    if (text == fmt::format("{}\n", name_of(request))) return request;
  return std::nullopt;
}

/// Lets the request in `part` be read at `path`, except over one to stop. Returns false with errno set.
bool leave_behind_others(const fs::path& part, const fs::path& path, RunRequest request) {
  if (::link(part.c_str(), path.c_str()) == 0) return true;
  const std::optional<RunRequest> there = errno == EEXIST ? read_request(path) : std::nullopt;
  return there == RunRequest::stop || there == request || ::rename(part.c_str(), path.c_str()) == 0;
}

/// The command whose results a folder holds, and the file that shows it.
struct FolderOwner {
  std::string command, file;
};

/// Files that one command leaves, the more telling ones first: a dial leaves sweep.csv, too.
constexpr std::array<std::pair<const char*, const char*>, 12> kOwners = {{
    {"dial.csv", "dial"},
    {"numbers.csv", "paper"},
    {"sweep.csv", "sweep"},
    {"smooth.toml", "develop"},
    {"multibody.csv", "multibody"},
    {"levels.csv", "roughness"},
    {"run.h5", "run"},
    {"histories.csv", "run"},
    {"patch.h5", "run"},
    {kCheckpointFolder, "run"},
    {"summary.json", "run"},
    {"compare.json", "compare"},
}};

/// The command that status.json names, for a folder without results yet; empty: none.
std::string command_in(const fs::path& status) {
  try {
    return fs::exists(status) ? text_in(read_json(status), "command") : "";
  } catch (const InputError&) {  // not a file of this program
    return "";
  }
}

std::optional<FolderOwner> owner_of(const fs::path& folder) {
  for (const auto& [file, command] : kOwners)
    if (fs::exists(folder / file)) return FolderOwner{command, file};
  if (std::string command = command_in(folder / kStatus); !command.empty())
    return FolderOwner{std::move(command), kStatus};
  return std::nullopt;
}

}  // namespace

std::string folder_name(const fs::path& folder) {
  const fs::path normal = folder.lexically_normal();
  return (normal.has_filename() ? normal : normal.parent_path()).filename().string();
}

bool require_folder_of(const fs::path& folder, std::string_view command) {
  const std::optional<FolderOwner> owner = owner_of(folder);
  if (owner && owner->command != command)
    throw InputError(
        fmt::format("-o {}: it holds results of `tread {}` ({}), which those of `tread {}` would overwrite; "
                    "choose another folder",
                    folder.string(), owner->command, owner->file, command));
  return owner.has_value();
}

std::string resume_text(const fs::path& folder, const std::string& more) {
  return fmt::format("`tread resume {}{}{}`", shell_word(folder.string()), more.empty() ? "" : " ", more);
}

void require_run_folder(const fs::path& folder, std::string_view option) {
  if (!fs::is_directory(folder))
    throw InputError(fmt::format("{}there is no folder {}: give the one that `tread run -o` was given",
                                 option, folder.string()));
}

std::string no_run_text(const fs::path& folder) {
  return fmt::format("{} holds no run: start one with `tread run SCENE -o {}`", folder.string(),
                     shell_word(folder.string()));
}

std::string moved_text(const fs::path& folder) {
  return fmt::format(
      "{} was moved or removed while its run went on, or files in it were; `tread resume` goes on where its "
      "checkpoints are",
      folder.string());
}

bool is_taken(const fs::path& folder) {
  return FileLock::is_held(folder);
}

void leave_request(const fs::path& folder, RunRequest request) {
  const fs::path path = folder / kRequest;
  const fs::path part = folder / fmt::format("{}.{}.part", kRequest, ::getpid());
  write_text(part, fmt::format("{}\n", name_of(request)), path);
  const bool left = request == RunRequest::stop ? ::rename(part.c_str(), path.c_str()) == 0
                                                : leave_behind_others(part, path, request);
  const int error = errno;
  ::unlink(part.c_str());
  if (!left)
    throw ResourceError(fmt::format("cannot write {}: {}; does the folder still exist?", path.string(),
                                    std::strerror(error)));
}

void withdraw_request(const fs::path& folder) {
  std::error_code ignored;
  for (const char* name : {kRequest, kTaken}) fs::remove(folder / name, ignored);
}

bool is_pending(const fs::path& folder) {
  return fs::exists(folder / kRequest) || fs::exists(folder / kTaken);
}

RunFolder::RunFolder(fs::path path) : identity_(std::move(path)), lock_(take(identity_.path())) {
  withdraw_request(identity_.path());
}

std::optional<RunRequest> RunFolder::take_request() const {
  if (!in_place()) return std::nullopt;  // it may be another run's
  // A request that comes meanwhile stays.
  const fs::path taken = *this / kTaken;
  if (::rename((*this / kRequest).c_str(), taken.c_str()) != 0) return std::nullopt;
  const std::optional<RunRequest> request = read_request(taken);
  if (!request || request == RunRequest::stop) answer_request();
  return request;
}

void RunFolder::answer_request() const {
  std::error_code ignored;
  if (in_place()) fs::remove(*this / kTaken, ignored);
}

bool RunFolder::take_stop() const {
  if (!in_place()) return false;
  const fs::path path = *this / kRequest;
  std::error_code ignored;
  if (!fs::exists(path, ignored) || read_request(path) != RunRequest::stop) return false;
  fs::remove(path, ignored);
  return true;
}

void RunFolder::show_status(const std::string& json) const {
  if (!in_place()) return;  // another folder may have its name
  try {
    show_text_file(*this / kStatus, json);
  } catch (const ResourceError&) {  // a full disk shows at the files that matter
  }
}

std::int64_t folder_bytes(const fs::path& folder) {
  std::int64_t sum = 0;
  std::error_code ignored;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, ignored);
  for (; entry != fs::recursive_directory_iterator(); entry.increment(ignored))
    if (entry->is_regular_file(ignored))
      if (const std::uintmax_t bytes = entry->file_size(ignored); !ignored)  // error: it was removed
        sum += static_cast<std::int64_t>(bytes);
  return sum;
}

}  // namespace tread
