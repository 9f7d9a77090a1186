#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "drivers/bench/benchmarks.hpp"
#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"

namespace tread {

namespace {

void add_plan_options(CLI::App& command, MeasurementPlan& plan) {
  command.add_option("--repetitions", plan.repetitions, "number of runs; the median counts")
      ->check(at_least(1));
  command.add_option("--run-seconds", plan.run_seconds, "shortest time of a run [s]")->check(at_least(0));
}

constexpr const char* kJsonLines = "one JSON object a line on stdout";

void add_bench_kernels(CLI::App& bench) {
  auto options = std::make_shared<BenchKernelsOptions>();
  CLI::App& command = *bench.add_subcommand(
      "kernels", "speed of every kernel on made-up data, beside the limits of the machine");
  add_thread_options(command, options->threads);
  add_device_option(command, options->device);
  add_plan_options(command, options->plan);
  command.add_flag("--json", options->json, kJsonLines);
  command.add_option("--kernel", options->kernels, "names of kernels (default: all)");
  command.add_option("--elements", options->elements, "mesh sizes (default: 10000 100000 1460000)")
      ->check(CLI::Range(100, 100000000));
  command.add_option("--lanes", options->lanes, "instruction sets (default: all of this processor)");
  command.add_option("--precision", options->precisions, "double, mixed, single (default: all)");
  command.callback([options] { bench_kernels(*options); });
}

void add_bench_scaling(CLI::App& bench) {
  auto state = std::make_shared<SceneCommand<BenchScalingOptions>>();
  CLI::App& command =
      *bench.add_subcommand("scaling", "strong and weak scaling from one to all threads, with every backend");
  add_scene_options(command, state->arguments);
  add_thread_options(command, state->options.threads);
  add_plan_options(command, state->options.plan);
  command
      .add_option("--elements", state->options.elements,
                  "elements of the made-up rail that is measured without a scene (default: 400000)")
      ->check(CLI::Range(100, 100000000));
  command.add_flag("--json", state->options.json, kJsonLines);
  command.callback([state] {
    const SceneArguments& stated = state->arguments;
    if (stated.scene.empty() &&
        !(stated.quality.empty() && stated.precision.empty() && stated.overrides.empty()))
      throw InputError(
          "tread bench scaling: --quality, --precision and --set change a scene, and none is stated; state "
          "one, or leave them out");
    if (stated.scene.empty())
      bench_scaling(state->options);
    else
      bench_scaling(state->arguments.resolve(), state->options);
  });
}

void add_bench_hotspots(CLI::App& bench) {
  auto state = std::make_shared<SceneCommand<BenchHotspotsOptions>>();
  CLI::App& command = add_scene_command(
      bench, "hotspots", "time, work and load balance of every phase of a step", bench_hotspots, state);
  command.get_option("--json")->description(kJsonLines);
  add_device_option(command, state->options.device);
  command.add_option("--steps", state->options.steps, "steps of a run (default: 500)")->check(at_least(1));
  command
      .add_option("--cores", state->options.cores,
                  "numbers of cores: project the step's time on them from work and span of its phases")
      ->check(at_least(1));
  add_plan_options(command, state->options.plan);
  command.add_flag("--quiet", state->options.quiet, "no progress on stderr");
}

void add_bench_ranks(CLI::App& bench) {
  auto state = std::make_shared<SceneCommand<BenchRanksOptions>>();
  CLI::App& command = add_scene_command(
      bench, "ranks", "nodes, memory and messages of a scene cut for ranks that are not there", bench_ranks,
      state);
  command.get_option("--json")->description(kJsonLines);
  command.add_option("--ranks", state->options.ranks, "number of ranks (default: 64)")->check(at_least(1));
  command
      .add_option("--parts", state->options.parts,
                  "numbers of ranks whose part of a step is timed alone, without contact; their mean, rank 0 "
                  "aside, predicts the times of all")
      ->check(at_least(0));
  add_plan_options(command, state->options.plan);
}

void add_bench_compare(CLI::App& bench) {
  auto files = std::make_shared<std::array<std::string, 2>>();
  auto by = std::make_shared<std::string>("rate");
  CLI::App& command = *bench.add_subcommand(
      "compare",
      "compare two files of `bench kernels --json`; exit code 3 if the second is slower beyond the spread or "
      "lacks rows");
  command.add_option("before", (*files)[0], "file of the older program")->required();
  command.add_option("after", (*files)[1], "file of the newer program")->required();
  command
      .add_option("--by", *by,
                  "rate (default; one quiet machine), limit (shares of each machine's limits) or "
                  "instructions (recorded with -t 1; busy machines)")
      ->check(CLI::IsMember({"rate", "limit", "instructions"}));
  auto common = std::make_shared<bool>(false);
  command.add_flag("--common", *common, "compare the rows of both files; the second may lack others");
  command.callback([files, by, common] {
    const BenchMeasure measure = *by == "rate"    ? BenchMeasure::rate
                                 : *by == "limit" ? BenchMeasure::fraction_of_limit
                                                  : BenchMeasure::instructions;
    if (!compare_benchmarks((*files)[0], (*files)[1], measure, *common))
      throw NumericalError(
          "bench compare: at least one row is slower beyond the spread, or missing; --common allows missing "
          "ones");
  });
}

}  // namespace

void add_bench(CLI::App& app, const std::string& /*command_line*/) {
  CLI::App& bench = *app.add_subcommand("bench", "speed of the program beside the limits of the machine");
  bench.require_subcommand(1);
  add_bench_kernels(bench);
  add_bench_scaling(bench);
  add_bench_hotspots(bench);
  add_bench_ranks(bench);
  add_bench_compare(bench);
}

}  // namespace tread
