#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/bench/bench_command.hpp"
#include "drivers/cli/cache_command.hpp"
#include "drivers/cli/check_command.hpp"
#include "drivers/cli/ctl_command.hpp"
#include "drivers/cli/develop_command.hpp"
#include "drivers/cli/dial_command.hpp"
#include "drivers/cli/mesh_command.hpp"
#include "drivers/cli/multibody_command.hpp"
#include "drivers/cli/paper_command.hpp"
#include "drivers/cli/roughness_command.hpp"
#include "drivers/cli/sweep_command.hpp"
#include "drivers/cli/verify_command.hpp"
#include "drivers/cli/version_command.hpp"
#include "drivers/run/run_scene.hpp"
#include "io/scene/problems.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/json.hpp"

namespace {

struct SceneArguments {
  std::string scene;
  std::string quality;
  std::string precision;
  std::vector<std::string> overrides;

  tread::ResolvedScene resolve() const {
    std::vector<std::string> all;
    if (!quality.empty()) all.push_back("scene.quality=" + quality);
    if (!precision.empty()) all.push_back("scene.precision=" + precision);
    all.insert(all.end(), overrides.begin(), overrides.end());
    return tread::resolve_scene(std::filesystem::path(scene), all);
  }
};

/// Options and scene of a command that works on a scene; lives as long as the command line.
template <class Options>
struct SceneCommand {
  SceneArguments arguments;
  Options options;
};

void print_problems(const std::vector<tread::Problem>& problems) {
  tread::Json list = tread::Json::array();
  for (const tread::Problem& problem : problems)
    list.push_back({{"file", problem.file},
                    {"line", problem.line},
                    {"column", problem.column},
                    {"key", problem.key},
                    {"message", problem.message}});
  fmt::print("{}", tread::json_text({{"ok", false}, {"problems", list}}));
}

/// Calls `action`; with `json` what is wrong goes to stdout as a list, too.
void report_problems(bool json, const std::function<void()>& action) {
  try {
    action();
  } catch (const tread::ProblemsError& error) {
    if (json) print_problems(error.problems);
    throw;
  } catch (const tread::Error& error) {
    if (json) print_problems({{"", 0, 0, "", error.what()}});
    throw;
  }
}

/// Refuses what is no number, or one below `least`.
CLI::Validator at_least(int least) {
  const auto refusal = [least](const std::string& text) {
    double value = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool number = failure == std::errc() && end == text.data() + text.size();
    return number && value >= least ? std::string()
                                    : fmt::format("\"{}\" is not a number of at least {}", text, least);
  };
  return {refusal, fmt::format(">= {}", least)};
}

void add_thread_options(CLI::App& command, tread::ThreadOptions& options) {
  command.add_option("-t,--threads", options.number, "threads (default: all)")->check(at_least(1));
  command.add_option("--backend", options.backend,
                     "library that runs them, openmp (default) or tbb; same bits");
}

void add_cache_option(CLI::App& command, std::string& place) {
  place.clear();
  command.add_option(
      "--cache", place,
      "folder of the preload cache, or off (default: TREAD_CACHE, else tread/ in XDG_CACHE_HOME "
      "or ~/.cache)");
}

/// Returns the option of the scene itself.
CLI::Option* add_scene_options(CLI::App& command, SceneArguments& arguments) {
  command.add_option("-q,--quality", arguments.quality, "draft, standard or paper; overrides scene.quality");
  command.add_option("--precision", arguments.precision,
                     "double, mixed or single; overrides scene.precision");
  command
      .add_option("--set", arguments.overrides,
                  "key=value that overrides the scene, e.g. --set \"motion.speed=250 km/h\"")
      ->allow_extra_args(false);
  return command.add_option("scene", arguments.scene, "scene file (TOML)");
}

/// A subcommand that reads a scene: `act(resolved scene, options)`.
template <class Options>
CLI::App& add_scene_command(CLI::App& app, const char* name, const char* text,
                            void (*act)(const tread::ResolvedScene&, const Options&),
                            std::shared_ptr<SceneCommand<Options>> state) {
  CLI::App& command = *app.add_subcommand(name, text);
  add_scene_options(command, state->arguments)->required();
  add_thread_options(command, state->options.threads);
  command.add_flag("--json", state->options.json, "JSON on stdout");
  command.callback([state, act] {
    report_problems(state->options.json, [&] { act(state->arguments.resolve(), state->options); });
  });
  return command;
}

void add_run(CLI::App& app, const std::string& command_line) {
  auto state = std::make_shared<SceneCommand<tread::RunOptions>>();
  state->options.command = command_line;
  CLI::App& command = add_scene_command(app, "run", "preload, roll, write histories, summary and report",
                                        tread::run_scene, state);
  command.add_option("-o,--output", state->options.output, "output directory")->required();
  command.add_flag("--quiet", state->options.quiet, "no progress on stderr");
  command.add_flag("--overwrite", state->options.overwrite,
                   "throw away an unfinished run that the output directory holds");
  command.add_option(
      "--from", state->options.from,
      "begin with the state of another run over another corrugation, DIR or DIR@TIME: out@10ms");
  add_cache_option(command, state->options.cache);
}

void add_resume(CLI::App& app) {
  auto options = std::make_shared<tread::RunOptions>();
  CLI::App& command = *app.add_subcommand("resume", "go on with a run that was stopped or killed");
  command.add_option("folder", options->output, "output directory of the run")->required();
  command
      .add_option("--set", options->overrides,
                  "key=value for motion.duration, output.* and stop.*, e.g. --set \"stop.wall_time=2 h\"")
      ->allow_extra_args(false);
  add_thread_options(command, options->threads);
  command.add_flag("--json", options->json, "summary on stdout");
  command.add_flag("--quiet", options->quiet, "no progress on stderr");
  add_cache_option(command, options->cache);
  command.callback([options] { report_problems(options->json, [&] { tread::resume_run(*options); }); });
}

void add_ctl(CLI::App& app) {
  auto options = std::make_shared<tread::CtlOptions>();
  CLI::App& command =
      *app.add_subcommand("ctl", "look at a run, or ask it for a checkpoint, for a frame, or to stop");
  command.add_option("folder", options->folder, "output directory of the run")->required();
  command.add_option("action", options->action, "status, checkpoint, frame or stop")
      ->required()
      ->check(CLI::IsMember({"status", "checkpoint", "frame", "stop"}));
  command.add_option("--wait", options->patience, "longest time to wait for an answer [s]")
      ->check(at_least(0));
  command.callback([options] { tread::control_run(*options); });
}

void add_cache(CLI::App& app) {
  auto options = std::make_shared<tread::CacheOptions>();
  CLI::App& command = *app.add_subcommand("cache", "preloads that earlier runs have found");
  command.add_option("action", options->action, "show or clear")
      ->required()
      ->check(CLI::IsMember({"show", "clear"}));
  add_cache_option(command, options->place);
  command.add_flag("--json", options->json, "JSON on stdout");
  command.callback([options] { tread::tend_cache(*options); });
}

CLI::Option* add_cost_option(CLI::App& command, std::string& cost) {
  return command.add_option("--cost", cost, "what cheap means: element-steps (default) or minutes");
}

void add_check(CLI::App& app) {
  auto state = std::make_shared<SceneCommand<tread::CheckOptions>>();
  CLI::App& command = add_scene_command(
      app, "check", "all errors of a scene, or what it would compute and cost", tread::check_scene, state);
  tread::AdviceOptions& advice = state->options.advice;
  CLI::Option* error = command.add_option(
      "--error", advice.error, "names the cheapest setting that was measured to be as near, e.g. 2%");
  command
      .add_option("--quantity", advice.quantity,
                  "of the error: F_N, F_L, creepage, pressure, shear, von_mises, work (default: all)")
      ->needs(error);
  command
      .add_option("--dial", advice.dial,
                  "folder of `tread dial`, or its dial.jsonl (default: the table of docs/dial.md)")
      ->needs(error);
  add_cost_option(command, advice.cost)->needs(error);
}

void add_mesh(CLI::App& app) {
  auto state = std::make_shared<SceneCommand<tread::MeshOptions>>();
  CLI::App& command =
      add_scene_command(app, "mesh", "counts, element sizes, masses and stable step of a scene's mesh",
                        tread::describe_mesh, state);
  command.add_option("-o,--output", state->options.output, "directory for mesh.hdf (ParaView)");
}

void add_multibody(CLI::App& app, const std::string& command_line) {
  auto state = std::make_shared<SceneCommand<tread::MultibodyOptions>>();
  tread::MultibodyOptions& options = state->options;
  options.command = command_line;
  CLI::App& command =
      add_scene_command(app, "multibody", "the scene by the multi-body approach: a second instead of an hour",
                        tread::run_multibody_command, state);
  command.add_option("-o,--output", options.output, "directory for CSV, summary and report");
  command
      .add_option(
          "--beam", options.beam,
          "the rail: euler (default), timoshenko, or spread: timoshenko with the head's forces spread")
      ->check(CLI::IsMember({"euler", "timoshenko", "spread"}));
  command.add_option("--modes", options.modes, "modes of the rail (default: all below 20 kHz)")
      ->check(CLI::Range(2, 3000));
  command.add_option("--step", options.step, "time step, e.g. \"5 us\" (default: half the stable one)");
  command.add_flag("--filter", options.filter, "a sine as deep as the contact patch leaves it");
  command.add_option("--calibrate", options.calibrate,
                     "directory of a transient run whose F_N the contact spring is fitted to");
  command
      .add_option("--map", options.map,
                  "response over speed and wavelength: speed=100:500:10km/h wavelength=40:150:2mm")
      ->expected(2);
  command.add_option("--dots", options.dots, "directories of transient runs to show on the map");
  command.add_flag("--quiet", options.quiet, "no progress on stderr");
}

void add_roughness(CLI::App& app, const std::string& command_line) {
  auto options = std::make_shared<tread::RoughnessOptions>();
  options->command = command_line;
  CLI::App& command = *app.add_subcommand(
      "roughness", "one-third octave levels of a measured profile beside the limit of ISO 3095");
  command.add_option("file", options->file, "two columns: along the rail, height upwards")->required();
  command.add_option("--units", options->units,
                     "of both columns, e.g. m,um, where the file does not state them");
  command.add_option("--segment", options->segment, "length of the averaged segments (default: \"2 m\")");
  command.add_flag("--depth", options->depth, "the second column counts downwards");
  command.add_flag("--raw", options->raw, "leave spikes and pits as they are");
  command.add_option("-o,--output", options->output, "directory for CSV, SVG and report");
  add_thread_options(command, options->threads);
  command.add_flag("--json", options->json, "JSON on stdout");
  command.callback([options] { report_problems(options->json, [&] { tread::roughness(*options); }); });
}

void add_study_options(CLI::App& command, tread::StudyOptions& options) {
  command.add_option("-o,--output", options.output, "directory for a folder a run and the comparison");
  command.add_option("-q,--quality", options.quality, "draft, standard or paper, of all points");
  command
      .add_option("--set", options.overrides,
                  "key=value for all points, e.g. --set \"motion.duration=20 ms\"")
      ->allow_extra_args(false);
  command.add_option("-j,--jobs", options.jobs, "runs at once (default: as many as cores and memory allow)")
      ->check(at_least(1));
  command
      .add_option("-t,--threads", options.threads,
                  "threads of one run (default: its share of the cores that are idle when it begins)")
      ->check(at_least(1));
  command.add_flag("--retry", options.retry, "points that failed, too");
  command.add_flag("--no-share", options.no_share,
                   "each run begins at the start, also where corrugations by gap could share the rolling");
  command.add_flag("--list", options.list, "the points and what they will cost, without running them");
  command.add_flag("--json", options.json, "JSON on stdout");
  command.add_flag("--quiet", options.quiet, "no progress on stderr");
}

/// The options of all studies, and what is done with them.
template <class Options>
void add_study(CLI::App& command, const std::shared_ptr<Options>& options,
               std::optional<tread::Error> (*run)(const Options&)) {
  add_study_options(command, options->common);
  command.callback([options, run] {
    std::optional<tread::Error> shortfall;
    report_problems(options->common.json, [&] { shortfall = run(*options); });
    if (shortfall) throw tread::Error(*shortfall);
  });
}

void add_sweep(CLI::App& app, const std::string& command_line) {
  auto options = std::make_shared<tread::SweepOptions>();
  options->common.command = command_line;
  CLI::App& command = *app.add_subcommand(
      "sweep", "a scene with some keys varied: a run for each point; goes on where it was stopped");
  command.add_option("study", options->study, "study file (TOML)")->required();
  add_study(command, options, tread::sweep);
}

void add_dial(CLI::App& app, const std::string& command_line) {
  auto options = std::make_shared<tread::DialOptions>();
  options->common.command = command_line;
  CLI::App& command =
      *app.add_subcommand("dial", "what settings of a passage cost and how far from the finest they lead");
  command.add_option("file", options->file, "scene, or study file that states the runs (TOML)")->required();
  command
      .add_option("--base", options->axes.base,
                  "key=value that holds while another key is varied (default: scene.element_size=5 mm)")
      ->allow_extra_args(false);
  command
      .add_option("--axis", options->axes.axes,
                  "key=value,value,...: values in place of the usual ones, a run each")
      ->allow_extra_args(false);
  command.add_option("--reference", options->reference,
                     "point, or folder of a finished run of the passage (default: the finest)");
  command.add_option("--against", options->against,
                     "point that single settings are compared with (default: the base)");
  add_cost_option(command, options->cost);
  add_study(command, options, tread::turn_dial);
}

void add_paper(CLI::App& app, const std::string& command_line) {
  auto options = std::make_shared<tread::PaperOptions>();
  options->common.command = command_line;
  CLI::App& command = *app.add_subcommand(
      "paper", "the figures of the paper: runs what they need, ours beside theirs, a verdict each");
  command.add_option("--fig", options->figures, "numbers of figures (default: all; --list names them)");
  add_study(command, options, tread::reproduce_paper);
}

void add_develop(CLI::App& app, const std::string& command_line) {
  auto state = std::make_shared<SceneCommand<tread::DevelopOptions>>();
  tread::DevelopOptions& options = state->options;
  options.command = command_line;
  CLI::App& command = *app.add_subcommand(
      "develop", "passages that wear the rail, each for the next; goes on where it was stopped");
  add_scene_options(command, state->arguments)->required();
  command.add_option("--passages", options.passages, "simulated ones (default: 10), each standing for many")
      ->check(CLI::Range(1, 9999));
  command.add_option("-o,--output", options.output, "directory")->required();
  command.add_option("--from", options.from,
                     "begin all passages with the state of a run over the smooth rail, DIR or DIR@TIME");
  command.add_option("-t,--threads", options.threads, "threads of a passage (default: all)")
      ->check(at_least(1));
  command.add_flag("--json", options.json, "JSON on stdout");
  command.add_flag("--quiet", options.quiet, "no progress on stderr");
  command.callback([state] {
    report_problems(state->options.json, [&] { tread::develop(state->arguments.resolve(), state->options); });
  });
}

void add_verify(CLI::App& app) {
  auto options = std::make_shared<tread::VerifyOptions>();
  CLI::App& command =
      *app.add_subcommand("verify", "compare the program with theory; exits 3 if a bound fails");
  command.add_option("cases", options->names, "names of cases or groups (default: standard)");
  command
      .add_option("--set", options->overrides,
                  "input=value for every chosen case that has it, e.g. --set \"radius=0.5 m\"")
      ->allow_extra_args(false);
  command.add_option("-o,--output", options->output, "directory for a page and figures of each case");
  add_thread_options(command, options->threads);
  command.add_flag("--list", options->list, "the cases and their inputs");
  command.add_flag("--json", options->json, "one JSON object a line on stdout");
  command.add_flag("--quiet", options->quiet, "no progress on stderr");
  command.callback([options] {
    bool passed = false;
    report_problems(options->json, [&] { passed = tread::verify(*options); });
    if (!passed) throw tread::NumericalError("verify: at least one bound fails");
  });
}

void add_plan_options(CLI::App& command, tread::MeasurementPlan& plan) {
  command.add_option("--repetitions", plan.repetitions, "runs, of which the median counts")
      ->check(at_least(1));
  command.add_option("--run-seconds", plan.run_seconds, "shortest time of a run [s]")->check(at_least(0));
}

void add_bench_kernels(CLI::App& bench) {
  auto options = std::make_shared<tread::BenchKernelsOptions>();
  CLI::App& command =
      *bench.add_subcommand("kernels", "every kernel on made-up data beside the machine's limits");
  add_thread_options(command, options->threads);
  add_plan_options(command, options->plan);
  command.add_flag("--json", options->json, "one JSON object a line on stdout");
  command.add_option("--kernel", options->kernels, "names of kernels (default: all)");
  command.add_option("--elements", options->elements, "mesh sizes (default: 10000 100000 1460000)")
      ->check(CLI::Range(100, 100000000));
  command.add_option("--lanes", options->lanes, "instruction sets (default: all of this processor)");
  command.add_option("--precision", options->precisions, "double, mixed, single (default: all)");
  command.callback([options] { tread::bench_kernels(*options); });
}

void add_bench_scaling(CLI::App& bench) {
  auto state = std::make_shared<SceneCommand<tread::BenchScalingOptions>>();
  CLI::App& command = *bench.add_subcommand(
      "scaling", "one to all threads, strong and weak, by every backend, and where efficiency is lost");
  add_scene_options(command, state->arguments);
  add_thread_options(command, state->options.threads);
  add_plan_options(command, state->options.plan);
  command
      .add_option("--elements", state->options.elements,
                  "of the made-up rail that is measured without a scene (default: 400000)")
      ->check(CLI::Range(100, 100000000));
  command.add_flag("--json", state->options.json, "one JSON object a line on stdout");
  command.callback([state] {
    if (state->arguments.scene.empty())
      tread::bench_scaling(state->options);
    else
      tread::bench_scaling(state->arguments.resolve(), state->options);
  });
}

void add_bench_hotspots(CLI::App& bench) {
  auto state = std::make_shared<SceneCommand<tread::BenchHotspotsOptions>>();
  CLI::App& command = add_scene_command(bench, "hotspots", "time, work and balance of every phase of a step",
                                        tread::bench_hotspots, state);
  command.add_option("--steps", state->options.steps, "of a run (default: 500)")->check(at_least(1));
  add_plan_options(command, state->options.plan);
  command.add_flag("--quiet", state->options.quiet, "no progress on stderr");
}

void add_bench_compare(CLI::App& bench) {
  auto files = std::make_shared<std::array<std::string, 2>>();
  using tread::BenchMeasure;
  auto measure = std::make_shared<BenchMeasure>(BenchMeasure::rate);
  CLI::App& command = *bench.add_subcommand(
      "compare", "two files of `bench kernels --json`; exits 3 where the second is slower beyond the spread");
  command.add_option("before", (*files)[0], "recorded before")->required();
  command.add_option("after", (*files)[1], "recorded after")->required();
  const std::map<std::string, BenchMeasure> measures = {{"rate", BenchMeasure::rate},
                                                        {"limit", BenchMeasure::fraction_of_limit},
                                                        {"instructions", BenchMeasure::instructions}};
  command
      .add_option("--by", *measure,
                  "rate (default; one quiet machine), limit (shares of what each machine bore) or "
                  "instructions (recorded with -t 1; busy machines)")
      ->transform(CLI::CheckedTransformer(measures))
      ->option_text("TEXT");
  command.callback([files, measure] {
    if (!tread::compare_benchmarks((*files)[0], (*files)[1], *measure))
      throw tread::NumericalError("bench compare: at least one kernel is slower beyond the recorded spread");
  });
}

void add_bench(CLI::App& app) {
  CLI::App& bench = *app.add_subcommand("bench", "how fast the program is beside what the machine can do");
  bench.require_subcommand(1);
  add_bench_kernels(bench);
  add_bench_scaling(bench);
  add_bench_hotspots(bench);
  add_bench_compare(bench);
}

void add_plain(CLI::App& app, const char* name, const char* text, void (*act)(bool)) {
  auto json = std::make_shared<bool>(false);
  CLI::App& command = *app.add_subcommand(name, text);
  command.add_flag("--json", *json, "JSON on stdout");
  command.callback([json, act] { act(*json); });
}

int run(int argc, char** argv) {
  CLI::App app{"tread: transient wheel-rail rolling contact"};
  app.require_subcommand(1);
  std::string command_line = "tread";
  for (int i = 1; i < argc; ++i) command_line.append(" ").append(argv[i]);
  add_run(app, command_line);
  add_resume(app);
  add_ctl(app);
  add_cache(app);
  add_check(app);
  add_mesh(app);
  add_multibody(app, command_line);
  add_roughness(app, command_line);
  add_sweep(app, command_line);
  add_paper(app, command_line);
  add_develop(app, command_line);
  add_dial(app, command_line);
  add_verify(app);
  add_bench(app);
  add_plain(app, "version", "version, compiler, instruction sets, packages", tread::print_version);
  add_plain(app, "scene-reference", "every key of a scene file, as Markdown", tread::print_scene_reference);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    // A misspelt word may be why another one is missing.
    const std::vector<std::string> unknown = app.remaining(true);
    char** const end = argv + argc;
    char** const word = std::find_first_of(argv + 1, end, unknown.begin(), unknown.end());
    if (word == end)
      app.exit(error);
    else
      fmt::print(stderr, "tread: {} was not expected here; --help lists what is\n", *word);
    return static_cast<int>(tread::ExitCode::input);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    tread::give_back_large_arrays();
    return run(argc, argv);
  } catch (const tread::Error& error) {
    fmt::print(stderr, "tread: {}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr,
               "tread: not enough memory for this scene; a coarser quality needs less (see `tread check`)\n");
    return static_cast<int>(tread::ExitCode::resources);
  } catch (const std::exception& error) {
    fmt::print(stderr, "tread: unexpected failure: {}\n", error.what());
    return static_cast<int>(tread::ExitCode::resources);
  }
}
