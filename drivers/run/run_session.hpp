#pragma once
// Options, folder and progress of a process that works on a run.

#include <string>

#include "drivers/process/interruption.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/run/run_checkpoint.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/run/run_options.hpp"
#include "io/files/checkpoint_folder.hpp"
#include "io/text/json.hpp"

namespace tread {

struct RunSession {
  /// Takes the folder. Throws ResourceError if another process has it.
  explicit RunSession(const RunOptions& given);

  RunOptions options;
  RunFolder folder;
  CheckpointFolder checkpoints;
  Progress progress;
  Interruption interruption;
  RunOrder order;
  ResolvedScene resolved;

  /// Command that goes on with the run on its device: "`tread resume out --device gpu`". `more`: other
  /// options.
  std::string resume_command(const std::string& more = "") const;

  /// Lets a signal before the first step name that command: the first state is written.
  void begin_with_state();

  /// The beginning of status.json: stage, version, process and machine.
  Json status(const std::string& stage) const;

  /// Shows stage and text in status.json.
  void show(const std::string& stage, const std::string& text) const;

  /// Says `text` and shows it in status.json.
  void enter(const std::string& stage, const std::string& text) const;
};

}  // namespace tread
