#include "drivers/run/run_session.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "core/parallel/ranks.hpp"
#include "drivers/process/host.hpp"
#include "drivers/process/version.hpp"
#include "io/files/output_file.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

/// Makes the folder of the run that begins or goes on.
std::filesystem::path made(const std::filesystem::path& directory) {
  make_directory(directory);
  return directory;
}

/// Command that goes on with the run of these options.
std::string resume_text_of(const RunOptions& given, std::string more = "") {
  if (!given.device.empty() && given.device != "cpu")
    more += (more.empty() ? "--device " : " --device ") + shell_word(given.device);
  return resume_text(given.output, more);
}

/// Sentence on a signal before the first step, with the command that goes on.
std::string early_word(const std::string& command, bool from_checkpoint) {
  return fmt::format("tread: stopped before the first step; {} {}", command,
                     from_checkpoint ? "goes on from the last checkpoint" : "starts again");
}

/// The sentence as a process begins. With --overwrite, states in the folder are of an earlier run, with which
/// `tread resume` would go on until it is thrown away.
std::string first_word(const RunOptions& given, const CheckpointFolder& checkpoints) {
  const bool goes_on = !given.overwrite && !checkpoints.states().empty();
  const bool as_typed = given.overwrite || !given.from.empty() || !given.overrides.empty();
  return early_word(as_typed ? "the same command" : resume_text_of(given), goes_on);
}

/// A launcher that has lost a rank asks the others to stop, and ends them soon after.
std::string last_word(const RunOptions& given) {
  if (!chosen_ranks()) return "";
  return fmt::format("tread: asked to stop, or a rank is lost; {} goes on from the last checkpoint",
                     resume_text_of(given));
}

}  // namespace

RunSession::RunSession(const RunOptions& given)
    : options(given),
      folder(made(given.output)),
      checkpoints(given.output / kCheckpointFolder),
      progress(given.quiet),
      interruption(
          first_word(given, checkpoints),
          fmt::format("tread: stopped at once; {} goes on from the last checkpoint", resume_text_of(given)),
          last_word(given)) {}

std::string RunSession::resume_command(const std::string& more) const {
  return resume_text_of(options, more);
}

void RunSession::begin_with_state() {
  interruption.set_early(early_word(resume_command(), true));
}

Json RunSession::status(const std::string& stage) const {
  return {{"stage", stage},
          {"command", "run"},
          {"version", program_version()},
          {"process", ::getpid()},
          {"machine", host_name()}};
}

void RunSession::show(const std::string& stage, const std::string& text) const {
  Json json = status(stage);
  json["text"] = text;
  folder.show_status(json_text(json));
}

void RunSession::enter(const std::string& stage, const std::string& text) const {
  progress.say(fmt::format("[{}] {}", stage, text));
  show(stage, text);
}

}  // namespace tread
