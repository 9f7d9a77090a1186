#include "drivers/studies/study/run_study.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "drivers/process/interruption.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/results/disk_use.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/studies/study/job_array.hpp"
#include "drivers/studies/study/shared_rolling.hpp"
#include "drivers/studies/study/study_report.hpp"
#include "drivers/studies/study/study_runner.hpp"
#include "io/files/output_file.hpp"
#include "io/report/plain_text.hpp"
#include "io/text/json.hpp"
#include "io/text/text_file.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

constexpr std::size_t kMostShown = 5;  ///< warnings in the log

int stated(int option, int study) {
  return option > 0 ? option : study;
}

/// Returns true if the name is that of an executable file, of PATH where it has no slash.
bool program_exists(const std::string& name) {
  if (name.find('/') != std::string::npos) return ::access(name.c_str(), X_OK) == 0;
  std::istringstream path(std::getenv("PATH") ? std::getenv("PATH") : "");
  for (std::string folder; std::getline(path, folder, ':');)
    if (::access((std::filesystem::path(folder) / name).c_str(), X_OK) == 0) return true;
  return false;
}

/// Cards that runs with this device share; 0: they need none.
int cards_of(const std::string& device) {
  if (device.starts_with("gpu:")) return 1;
  const int all = static_cast<int>(gpus().size());
  if (device == "gpu") return std::max(1, all);  // the runs say that there is none
  return device == "auto" ? all : 0;
}

/// Chooses the number of runs before the cost is known: as many as cores have room for, elsewhere all at
/// once.
void choose_processes(StudyPlan& plan, const StudyOptions& options) {
  const int cores = machine_cores();
  plan.threads = stated(options.threads, plan.study.threads);
  plan.device = options.device;
  plan.launcher = launcher_words(options.launcher);
  plan.elsewhere = options.slurm.empty() ? fmt::format("{}", fmt::join(plan.launcher, " ")) : "Slurm";
  int jobs = stated(options.jobs, plan.study.jobs);
  if (!plan.elsewhere.empty()) {
    plan.jobs = jobs > 0 ? jobs : static_cast<int>(plan.points.size());
    return;
  }
  const int each = std::max(1, plan.threads);
  plan.cards = cards_of(plan.device);
  if (plan.cards > 0)
    jobs = jobs > 0 ? std::min(jobs, plan.cards) : std::min(plan.cards, std::max(1, cores / each));
  plan.jobs = jobs > 0 ? jobs : std::max(1, cores / each);
}

/// Sentence on launcher, cards or cores that this machine lacks for the runs; "" for a list and a job array,
/// which need none.
std::string lacking_here(const StudyPlan& plan, const StudyOptions& options) {
  if (options.list || !options.slurm.empty()) return "";
  if (!plan.launcher.empty()) return missing_launcher(plan.launcher);
  if (plan.cards > 0 && options.jobs > plan.cards)
    return fmt::format("--jobs {} with --device {}: a card takes one run at a time, and there {}",
                       options.jobs, plan.device,
                       plan.cards == 1 ? "is one" : fmt::format("are {}", plan.cards));
  const int cores = machine_cores();
  const int each = std::max(1, plan.threads);
  if (plan.jobs * each <= cores) return "";
  return fmt::format(
      "{} runs at once with {} threads each need {} cores, this machine has {}: lower --jobs or "
      "--threads (study.jobs, study.threads)",
      plan.jobs, each, plan.jobs * each, cores);
}

/// Refuses runs for which this machine lacks launcher, cores or card.
void require_machine(StudyPlan& plan, const StudyOptions& options) {
  const std::string card = missing_device(plan.device);
  const bool here = !options.list && plan.elsewhere.empty();
  const std::string lacking = lacking_here(plan, options);
  const bool refuses = !lacking.empty() || (here && !card.empty());
  if (!options.output.empty() && (options.list || refuses)) look_into_folders(plan);
  const auto to_run = [&](const PlannedPoint& point) { return point.to_run(options.retry); };
  if (!refuses || std::ranges::none_of(plan.points, to_run)) return;
  if (!lacking.empty()) throw InputError(lacking);
  throw ResourceError(card);
}

/// Lowers the number of runs at once if memory is short and their number was not stated.
void mind_memory(StudyPlan& plan, const StudyOptions& options) {
  if (stated(options.jobs, plan.study.jobs) > 0 || !plan.elsewhere.empty()) return;
  while (plan.jobs > 1 && total_cost(plan).memory > machine_memory()) --plan.jobs;
}

std::string cost_text(const StudyPlan& plan, const StudyCost& cost) {
  std::string saved =
      cost.saved > 0 ? fmt::format("; sharing saves another {}", duration_text(cost.saved)) : "";
  if (!plan.device.empty() && plan.device != "cpu") saved += "; times are the processor's";
  if (!plan.elsewhere.empty())
    return fmt::format(
        "{} runs at once by {}: {} one after the other{} at this machine's speed, {} on the disk", plan.jobs,
        plan.elsewhere, duration_text(cost.seconds), saved, bytes_text(cost.disk));
  const std::string threads =
      plan.threads > 0 ? fmt::format("{} thread{} each", plan.threads, plan.threads == 1 ? "" : "s")
                       : fmt::format("all {} cores", machine_cores());
  return fmt::format(
      "{} run{} at once, {}: about {} ({} one after the other{}), {} on the disk, {} of memory (the machine "
      "has {})",
      plan.jobs, plan.jobs == 1 ? "" : "s", threads, duration_text(cost.wall), duration_text(cost.seconds),
      saved, bytes_text(cost.disk), bytes_text(cost.memory), bytes_text(machine_memory()));
}

std::string plan_json(const StudyPlan& plan, const StudyCost& cost) {
  Json json = {{"jobs", plan.jobs},          {"threads", plan.threads},     {"wall_s", cost.wall},
               {"seconds", cost.seconds},    {"saved_seconds", cost.saved}, {"disk_bytes", cost.disk},
               {"memory_bytes", cost.memory}};
  json["points"] = Json::array();
  for (const PlannedPoint& point : plan.points) {
    Json one = {{"name", point.name}, {"state", name_of(point.status.state)}};
    if (point.cost) {
      one["elements"] = point.cost->elements;
      one["steps"] = point.cost->steps;
      one["seconds"] = point.cost->seconds();
      one["disk_bytes"] = point.cost->disk.results + point.cost->disk.frames;
    }
    if (const std::string begins = beginning_text(plan, point); !begins.empty()) one["begins"] = begins;
    json["points"].push_back(one);
  }
  json["warnings"] = Json::array();
  for (const auto& [text, points] : planned_warnings(plan))
    json["warnings"].push_back({{"text", text}, {"points", points}});
  return json_text(json);
}

/// Writes the scene of a study that brings its own.
void leave_scene(const Study& study) {
  if (study.scene_text.empty()) return;
  constexpr std::size_t kLargest = 1 << 20;  // [B]
  if (std::filesystem::exists(study.scene) && read_text_file(study.scene, kLargest) != study.scene_text)
    throw InputError(fmt::format("{}: it is not the scene that belongs there; choose another folder with -o",
                                 study.scene.string()));
  write_text_file(study.scene, study.scene_text);
}

/// The error that reports points without an end.
std::optional<Error> shortfall(const StudyPlan& plan, const std::string& stopped_by,
                               const std::string& resume_command, const StudyOptions& options) {
  std::string failures;
  int failed = 0;
  int left = 0;
  for (const PlannedPoint& point : plan.points) {
    if (point.status.state == PointState::failed)
      failures += fmt::format("\n  {}: {}", point.name, point.status.why), ++failed;
    else if (point.status.state != PointState::done)
      ++left;
  }
  if (!stopped_by.empty() && left > 0)
    return Interrupted(fmt::format("stopped by {}; nothing is lost: `{}` goes on with {} points", stopped_by,
                                   resume_command, left));
  if (failed > 0)
    return Error(
        plan.failure_code(),
        fmt::format("{} of {} points failed:{}{}\n`{}{}` tries them again", failed, plan.points.size(),
                    failures,
                    left > 0 ? fmt::format("\n{} of {} points are not done", left, plan.points.size()) : "",
                    resume_command, options.retry ? "" : " --retry"));
  if (left > 0)
    return Interrupted(fmt::format("{} points are not done ({}); `{}` goes on", left,
                                   options.quiet ? "see log.txt in their folders" : "see the log above",
                                   resume_command));
  return std::nullopt;
}

/// The first warnings, each with its points, behind "2 of 12 points have warnings"; empty without warnings.
/// `points`: "12 points"; `rest`: place of the others.
std::string warning_text(const std::vector<SharedWarning>& warnings, const std::string& points,
                         std::size_t most, const char* rest) {
  if (warnings.empty()) return "";
  std::set<std::string> warned;
  for (const SharedWarning& warning : warnings) warned.insert(warning.labels.begin(), warning.labels.end());
  std::string text = fmt::format("{} of {} have warnings:", warned.size(), points);
  for (std::size_t i = 0; i < std::min(warnings.size(), most); ++i) {
    const auto& [sentence, labels] = warnings[i];
    const std::string others = labels.size() > 1 ? fmt::format(" and {} more", labels.size() - 1) : "";
    text += fmt::format("\n  {}{}: {}", labels.front(), others, sentence);
  }
  if (warnings.size() > most) text += fmt::format("\n  {} more: see {}", warnings.size() - most, rest);
  return text;
}

/// Warnings of the runs to come.
std::string plan_warning_text(const StudyPlan& plan, std::size_t most) {
  return warning_text(planned_warnings(plan), fmt::format("{} points", plan.points.size()), most, "--list");
}

/// The command of a command line: "paper" of "tread paper -o out".
std::string command_word(const std::string& line) {
  std::istringstream words(line);
  std::string word;
  return words >> word >> word ? word : "sweep";
}

}  // namespace

std::vector<std::string> launcher_words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::string missing_launcher(const std::vector<std::string>& launcher) {
  if (launcher.empty() || program_exists(launcher.front())) return "";
  return fmt::format("--launcher: there is no program '{}' in PATH; install it, or state its path",
                     launcher.front());
}

void add_overrides(Study& study, const StudyOptions& options) {
  if (options.no_share || !options.slurm.empty()) study.share = false;
  const auto refuse_varied = [&](const std::string& text) {
    const std::string key = text.substr(0, text.find_first_of(" \t="));
    for (const StudyPoint& point : study.points)
      for (const StudySetting& setting : point.varied)
        if (setting.key == key)
          throw InputError(
              fmt::format("--set {}: the points of {} differ in {}; leave it out, or change the study", text,
                          study.name, key));
  };
  std::vector<std::string> all;
  if (!options.quality.empty()) all.push_back("scene.quality=" + options.quality);
  all.insert(all.end(), options.overrides.begin(), options.overrides.end());
  for (const std::string& text : all) {
    refuse_varied(text);
    const auto equals = text.find('=');
    if (equals == std::string::npos)
      throw InputError(fmt::format("--set {}: expected key=value, such as \"motion.speed=250 km/h\"", text));
    study.common.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
}

std::optional<Error> run_study(const Study& study, const StudyOptions& options,
                               const std::function<void(const StudyPlan&)>& leave) {
  StudyPlan plan = plan_study(study, options.output);
  choose_processes(plan, options);
  if (options.output.empty() && !options.list)
    throw InputError("-o is missing: the folder for the runs; --list shows them without it");
  const std::string& resume_command = options.origin.command;
  const std::string command = command_word(options.origin.command);
  Progress progress(options.quiet);
  Interruption interruption("tread: stopped before the first run", fmt::format("tread: stopped at once; the "
                                                                               "runs go on from their last "
                                                                               "checkpoints with `{}`",
                                                                               resume_command));
  if (!options.list && require_folder_of(plan.folder, command)) require_same_study(plan);
  require_machine(plan, options);
  std::optional<RunFolder> folder;
  if (!options.list) {
    make_directory(plan.folder);
    folder.emplace(plan.folder);
    look_into_folders(plan);
  }
  project_cost(plan, options.retry);
  mind_memory(plan, options);
  const StudyCost cost = total_cost(plan);
  if (options.list) {
    const std::string warnings = plan_warning_text(plan, std::numeric_limits<std::size_t>::max());
    fmt::print("{}", options.json ? plan_json(plan, cost)
                                  : plain_text(plan_table(plan)) + "\n" + cost_text(plan, cost) + "\n" +
                                        (warnings.empty() ? "" : "\n" + warnings + "\n"));
    return std::nullopt;
  }
  require_free_disk("the study", disk_still_needed(plan), plan.folder,
                    "free some or choose another folder with -o");
  leave_scene(study);
  if (const std::string warnings = plan_warning_text(plan, kMostShown); !warnings.empty())
    progress.warn(fmt::format("[{}] {}", command, warnings));
  if (!options.slurm.empty()) {
    write_job_array(plan, options.slurm, options.retry, options.origin.command);
    return std::nullopt;
  }
  progress.say(plain_text(plan_table(plan)) + fmt::format("\n[{}] {}", command, cost_text(plan, cost)));
  interruption.defer();
  const std::string stopped_by =
      StudyRunner(plan, *folder, progress, {command, resume_command}).run(options.retry);
  leave(plan);
  const std::vector<FinishedRun> finished = finished_runs(plan);
  if (const std::string warnings =
          warning_text(shared_warnings(finished), fmt::format("{} finished points", finished.size()),
                       kMostShown, "report.html in the folders of the points");
      !warnings.empty())
    progress.warn(fmt::format("[{}] {}", command, warnings));
  return shortfall(plan, stopped_by, resume_command, options);
}

}  // namespace tread
