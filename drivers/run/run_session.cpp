#include "drivers/run/run_session.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <array>

#include "drivers/process/machine.hpp"

namespace tread {

namespace {

/// Makes the folder of the run that begins or goes on.
std::filesystem::path made(const std::filesystem::path& directory) {
  make_directory(directory);
  return directory;
}

std::string resumption(const std::filesystem::path& directory) {
  return fmt::format("`tread resume {}`", directory.string());
}

}  // namespace

RunSession::RunSession(const RunOptions& given)
    : options(given),
      folder(made(given.output)),
      checkpoints(given.output / kCheckpointFolder),
      progress(given.quiet),
      interruption(fmt::format("tread: stopped before the first step; {} starts again",
                               given.from.empty() ? resumption(given.output) : "the same command"),
                   fmt::format("tread: stopped at once; {} goes on from the last checkpoint",
                               resumption(given.output))) {}

std::string RunSession::way_on() const {
  return resumption(folder.path());
}

JsonWriter RunSession::status(const std::string& stage) const {
  std::array<char, 256> machine{};
  ::gethostname(machine.data(), machine.size() - 1);
  JsonWriter json;
  json.begin_object();
  json.member("stage", std::string_view(stage));
  json.member("process", ::getpid());
  json.member("machine", std::string_view(machine.data()));
  return json;
}

void RunSession::enter(const std::string& stage, const std::string& text) const {
  progress.say(fmt::format("[{}] {}", stage, text));
  folder.show_status(status(stage).member("text", std::string_view(text)).end_object().text());
}

}  // namespace tread
