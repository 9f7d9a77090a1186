#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/report/scene_check.hpp"
#include "drivers/results/scene_model.hpp"
#include "drivers/run/run_model.hpp"
#include "drivers/run/run_refusals.hpp"
#include "drivers/studies/dial/dial_advice.hpp"
#include "io/report/plain_text.hpp"
#include "io/text/json.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

struct CheckOptions {
  ThreadOptions threads;
  std::string device;    ///< takes the steps; empty: the processor [choose_device]
  bool json = false;     ///< an object instead of tables
  bool quiet = false;    ///< no progress
  bool verbose = false;  ///< phases and fields, too
  AdviceOptions advice;
};

/// Elements whose mesh takes a core about ten seconds.
constexpr std::int64_t kManyElements = 2'000'000;

void check_scene(const ResolvedScene& resolved, const CheckOptions& options) {
  use_threads(options.threads);
  choose_device(options.device);
  const std::optional<Advice> advice = advise(resolved, options.advice);
  const Progress progress(options.quiet || options.json);
  settle_device(resolved.scene, options.device, progress);
  Model model =
      scene_model(resolved.scene, resolved, {}, [&](const MeshCount& count, const MeshSizes& sizes) {
        require_memory(count, sizes);
        if (count.elements >= kManyElements)
          progress.say(fmt::format("[mesh] {} elements: building the mesh", grouped(count.elements)));
      });
  settle_device(model, options.device, progress);
  const std::int64_t files = file_bytes(resolved.source);
  const Estimate cost = estimate(model, files);
  require_runnable(model, cost.dt, files);
  if (options.json) {
    Json json = check_json(model, cost);
    if (advice) json["advice"] = advice_json(*advice);
    fmt::print("{}", json_text(json));
    return;
  }
  fmt::print("{}", check_text(model, resolved, cost, options.verbose));
  if (advice) fmt::print("\n{}", advice_text(*advice));
}

}  // namespace

void add_check(CLI::App& app, const std::string& /*command_line*/) {
  auto state = std::make_shared<SceneCommand<CheckOptions>>();
  CLI::App& command = add_scene_command(
      app, "check", "report all errors of a scene, or its size, step and cost", check_scene, state);
  add_device_option(command, state->options.device);
  command.add_flag("--quiet", state->options.quiet, "no progress on stderr");
  command.add_flag("--verbose", state->options.verbose, "list the phases of a step and the fields as well");
  AdviceOptions& advice = state->options.advice;
  CLI::Option* error = command.add_option(
      "--error", advice.error, "name the cheapest setting with at most this measured error, e.g. 2%");
  command
      .add_option(
          "--quantity", advice.quantity,
          "quantity of the error: F_N, F_L, creepage, pressure, shear, von_mises, work (default: all)")
      ->needs(error);
  command
      .add_option("--dial", advice.dial,
                  "folder of `tread dial`, or its dial.jsonl (default: the shipped one)")
      ->needs(error);
  add_cost_option(command, advice.cost)->needs(error);
}

}  // namespace tread
