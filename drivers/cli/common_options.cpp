#include "drivers/cli/common_options.hpp"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "io/files/share_folder.hpp"
#include "io/scene/problems.hpp"
#include "io/scene/schema.hpp"
#include "io/text/json.hpp"

namespace tread {

namespace {

void print_problems(const std::vector<Problem>& problems) {
  Json list = Json::array();
  for (const Problem& problem : problems)
    list.push_back({{"file", problem.file},
                    {"line", problem.line},
                    {"column", problem.column},
                    {"key", problem.key},
                    {"message", problem.message}});
  fmt::print("{}", json_text({{"ok", false}, {"problems", list}}));
}

void add_quality_option(CLI::App& command, std::string& quality, const char* text) {
  command.add_option("-q,--quality", quality, text)->type_name("draft|standard|paper");
}

/// Returns true if a line of the file begins with the text. Throws InputError where it is no file of a scene.
bool has_line(const std::string& file, std::string_view text) {
  std::istringstream lines(load_scene_source(file).text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(text)) return true;
  return false;
}

/// `shipped`: names of the files of this kind that come with the program.
void require_file(const std::string& stated, const char* kind, const std::vector<std::string>& shipped) {
  if (stated.empty())
    throw InputError(fmt::format("the name of the {} is empty; state a file or a shipped one", kind));
  std::error_code ignored;
  if (std::filesystem::exists(stated, ignored)) return;
  if (const std::string near = similar_text(stated, shipped); !near.empty())
    throw InputError(fmt::format("cannot read {}: there is no such file; did you mean {}?", stated, near));
  const std::string share = stated_share();
  if (shipped.empty())
    throw InputError(
        fmt::format("cannot read {}: there is no such file, and no shipped {}{}", stated, kind,
                    share.empty() ? "" : fmt::format(" in TREAD_SHARE = {}; correct or unset it", share)));
  throw InputError(fmt::format("cannot read {}: there is no such file; shipped{}: {}", stated,
                               share.empty() ? "" : fmt::format(" in TREAD_SHARE = {}", share),
                               fmt::join(shipped, ", ")));
}

}  // namespace

void require_scene_or_study(const std::string& stated) {
  require_file(stated, "scene", shipped_scenes());
}

void require_scene_file(const std::string& stated) {
  require_scene_or_study(stated);
  if (has_line(stated, "[study]"))
    throw InputError(fmt::format("{} is a study, not a scene: `tread sweep {}` runs it", stated, stated));
}

void require_study_file(const std::string& stated) {
  require_file(stated, "study", shipped_studies());
  if (!has_line(stated, "[study]") && has_line(stated, "[scene]"))
    throw InputError(fmt::format("{} is a scene, not a study: `tread run {}` runs it", stated, stated));
}

ResolvedScene SceneArguments::resolve() const {
  require_scene_file(scene);
  std::vector<std::string> all;
  if (!quality.empty()) all.push_back("scene.quality=" + quality);
  if (!precision.empty()) all.push_back("scene.precision=" + precision);
  all.insert(all.end(), overrides.begin(), overrides.end());
  return resolve_scene(std::filesystem::path(scene), all);
}

void report_problems(bool json, const std::function<void()>& action) {
  try {
    action();
  } catch (const ProblemsError& error) {
    if (json) print_problems(error.problems);
    throw;
  } catch (const Error& error) {
    if (json) print_problems({{"", 0, 0, "", error.what()}});
    throw;
  }
}

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

void add_thread_options(CLI::App& command, ThreadOptions& options) {
  command.add_option("-t,--threads", options.number, "threads (default: all)")->check(at_least(1));
  command
      .add_option("--backend", options.backend, "library of the threads, tbb (default) or openmp; same bits")
      ->type_name("tbb|openmp");
  command.add_flag("--bind", options.bind,
                   "keep threads on cores of their own; for a machine without other work");
}

void add_device_option(CLI::App& command, std::string& device) {
  command
      .add_option(
          "--device", device,
          "what takes the steps: cpu (default), gpu, gpu:N, emulated, or auto (a card where there is one)")
      ->type_name("cpu|gpu|gpu:N|auto|emulated");
}

void add_cache_option(CLI::App& command, std::string& place) {
  place.clear();
  command.add_option(
      "--cache", place,
      "folder of the preload cache, or off (default: TREAD_CACHE, else tread/ in XDG_CACHE_HOME "
      "or ~/.cache)");
}

CLI::Option* or_shipped(CLI::Option* option) {
  return option->transform([](const std::string& stated) { return find_scene(stated).string(); });
}

CLI::Option* add_scene_options(CLI::App& command, SceneArguments& arguments) {
  add_quality_option(command, arguments.quality, "overrides scene.quality");
  command.add_option("--precision", arguments.precision, "overrides scene.precision")
      ->type_name("double|mixed|single");
  command
      .add_option("--set", arguments.overrides,
                  "key=value that overrides the scene, e.g. --set \"motion.speed=250 km/h\"")
      ->allow_extra_args(false);
  return or_shipped(
      command.add_option("scene", arguments.scene, "scene file (TOML), or the name of a shipped scene"));
}

CLI::Option* add_cost_option(CLI::App& command, std::string& cost) {
  return command.add_option("--cost", cost, "measure of the cost: element-steps (default) or minutes")
      ->type_name("element-steps|minutes");
}

void add_study_options(CLI::App& command, StudyOptions& options) {
  command.add_option("-o,--output", options.output, "directory for the comparison and one folder a run");
  add_quality_option(command, options.quality, "of all points");
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
  add_device_option(command, options.device);
  command.add_option("--launcher", options.launcher,
                     "words before each run's command, e.g. \"srun -N1 -n1\": runs begin elsewhere, all at "
                     "once unless -j or study.jobs states their number");
  command.add_option("--slurm", options.slurm,
                     "write a job array for sbatch to this file, and run nothing; points share no rolling");
  command.add_flag("--retry", options.retry, "run failed points again");
  command.add_flag("--no-share", options.no_share,
                   "start each run at t = 0, even if points could share their rolling");
  command.add_flag("--list", options.list, "list the points and their cost, and run nothing");
  command.add_flag("--json", options.json, "JSON on stdout");
  command.add_flag("--quiet", options.quiet, "no progress on stderr");
}

}  // namespace tread
