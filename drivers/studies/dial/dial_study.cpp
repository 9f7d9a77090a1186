#include "drivers/studies/dial/dial_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "drivers/process/standard_files.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/studies/dial/dial_report.hpp"
#include "drivers/studies/study/study_report.hpp"
#include "io/files/output_file.hpp"
#include "io/report/figure_files.hpp"
#include "io/report/plain_text.hpp"
#include "io/scene/schema.hpp"

namespace tread {

namespace {

const PlannedPoint* find_point(const StudyPlan& plan, const std::string& name) {
  const auto found = std::find_if(plan.points.begin(), plan.points.end(),
                                  [&](const PlannedPoint& point) { return point.name == name; });
  return found == plan.points.end() ? nullptr : &*found;
}

/// Most elements, then the most digits, then most steps; the first of equals.
const FinishedRun& finest(const std::vector<FinishedRun>& runs) {
  const auto fineness = [](const FinishedRun& run) {
    const std::string& precision = run.scene.precision;
    const int digits = precision == "double" ? 2 : precision == "mixed" ? 1 : 0;
    return std::tuple(run.number("elements").value_or(0), digits, run.number("steps").value_or(0));
  };
  return *std::max_element(runs.begin(), runs.end(), [&](const FinishedRun& a, const FinishedRun& b) {
    return fineness(a) < fineness(b);
  });
}

/// The values that identify a passage: without mesh, precision, outputs and the keys that the points vary.
SceneContent passage(SceneContent content, const std::vector<std::string>& varied) {
  std::erase_if(content, [&](const auto& entry) {
    const std::string& key = entry.first;
    const auto covers = [&](const std::string& one) {
      return key == one || (one.ends_with(".present") && key.starts_with(one.substr(0, one.size() - 7)));
    };
    const std::optional<Key> known = find_key(key);
    return (known && known->effects.any_of({Effect::fineness, Effect::duration, Effect::output})) ||
           std::any_of(varied.begin(), varied.end(), covers);
  });
  return content;
}

std::vector<FinishedRun> on_the_mesh_of(const FinishedRun& one, const std::vector<FinishedRun>& runs) {
  std::vector<FinishedRun> chosen;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(chosen), [&](const FinishedRun& run) {
    return run.scene.element_size == one.scene.element_size && run.scene.quality == one.scene.quality;
  });
  return chosen;
}

/// A finished run that is no point of the dial.
FinishedRun read_reference(const DialOptions& options, const StudyPlan& plan) {
  const std::filesystem::path folder = options.reference;
  if (!std::filesystem::exists(folder / "summary.json"))
    throw InputError(
        fmt::format("--reference {}: neither a point of this dial nor the folder of a finished run (its "
                    "summary.json is missing); --list names the points",
                    options.reference));
  const KeptScene kept = kept_scene(folder, plan.points.front().resolved.source.files);
  const std::vector<std::string> varied = varied_keys(plan);
  const std::string apart =
      difference(passage(plan.points.front().content, varied), passage(kept.content, varied));
  if (!apart.empty())
    throw InputError(fmt::format("--reference {}: another passage than this dial's (here: the dial): {}",
                                 options.reference, apart));
  // The folder's own name, or as stated where a point has that name.
  const std::string name = folder_name(folder);
  const bool own = !name.empty() && name != "." && name != ".." && !find_point(plan, name);
  return read_finished_run(folder, kept.resolved.scene, own ? name : options.reference);
}

bool is_of_outputs(const std::string& path) {
  const std::optional<Key> key = find_key(path);
  return key && key->effects.any_of({Effect::output, Effect::process});
}

/// Adds the settings in which the runs differ from the scene, without outputs; a reference from elsewhere has
/// none.
void add_settings(const Study& study, DialTable& table) {
  for (DialRow& row : table.rows)
    for (const StudyPoint& point : study.points)
      if (point.name == row.point)
        for (const auto* settings : {&point.own, &point.varied})
          for (const StudySetting& one : *settings)
            if (!is_of_outputs(one.key)) row.settings.push_back(one.as_override());
}

DialOutcome evaluate(const DialOptions& options, const DialDesign& design, const StudyPlan& plan) {
  DialOutcome outcome;
  outcome.cost = dial_cost(options.cost);
  for (FinishedRun& run : finished_runs(plan))
    if (run.rolled()) outcome.runs.push_back(std::move(run));
  if (outcome.runs.empty()) return outcome;
  const FinishedRun* named = find_run(outcome.runs, options.reference);
  if (!named && !options.reference.empty()) {
    if (find_point(plan, options.reference)) {
      print_error(fmt::format("tread: --reference {} is not done; there is nothing to compare with yet\n",
                              options.reference));
      outcome.runs.clear();
      return outcome;
    }
    outcome.runs.push_back(read_reference(options, plan));
    named = &outcome.runs.back();
  }
  outcome.table = dial_table(outcome.runs, named ? *named : finest(outcome.runs));
  add_settings(plan.study, outcome.table);
  const std::string& against = options.against.empty() ? design.base : options.against;
  if (const FinishedRun* base = find_run(outcome.runs, against)) {
    outcome.effects = dial_table(on_the_mesh_of(*base, outcome.runs), *base);
    add_settings(plan.study, outcome.effects);
  }
  return outcome;
}

void print(const DialOutcome& outcome) {
  fmt::print("Error [%] against {}\n\n{}\nShift along the rail [mm]\n\n{}\nCheapest for an error\n\n{}",
             outcome.table.reference, plain_text(error_table(outcome.table)),
             plain_text(shift_table(outcome.table)), plain_text(advice_table(outcome.table, outcome.cost)));
}

void leave_results(const DialOptions& options, const DialDesign& design, const StudyPlan& plan) {
  const DialOutcome outcome = evaluate(options, design, plan);
  if (outcome.runs.empty()) {
    if (options.common.json) fmt::print("{}", dial_json({}));
    return;
  }
  const std::filesystem::path& folder = plan.folder;
  write_text_file(folder / "sweep.csv", sweep_csv(plan, finished_runs(plan)));
  write_text_file(folder / "dial.csv", dial_csv(outcome.table));
  write_text_file(folder / "dial.jsonl", dial_lines(outcome.table));
  write_text_file(folder / "results.md", dial_markdown(outcome));
  std::error_code ignored;
  if (outcome.effects.rows.empty())
    std::filesystem::remove(folder / "effects.csv", ignored);
  else
    write_text_file(folder / "effects.csv", dial_csv(outcome.effects));
  replace_report(folder / "report.html", dial_report(outcome, plan, options.common.origin));
  if (options.common.json)
    fmt::print("{}", dial_json(outcome.table));
  else
    print(outcome);
}

void require_rolling(const DialDesign& design) {
  const Scene scene = read_scene(design.study.scene);
  if (!scene.contact || !scene.motion)
    throw InputError(
        fmt::format("{}: nothing rolls in it; a dial compares passages of a wheel over a rail ([contact] and "
                    "[motion])",
                    design.study.scene.string()));
}

}  // namespace

std::optional<Error> turn_dial(const DialOptions& options) {
  dial_cost(options.cost);
  DialDesign design = design_dial(options.file, options.axes);
  require_rolling(design);
  add_overrides(design.study, options.common);
  const auto named = [&](const std::string& name) {
    return std::any_of(design.study.points.begin(), design.study.points.end(),
                       [&](const StudyPoint& point) { return point.name == name; });
  };
  if (!options.against.empty() && !named(options.against))
    throw InputError(
        fmt::format("--against {}: not a point of this dial; --list names them", options.against));
  if (!options.reference.empty() && !named(options.reference))
    read_reference(options, plan_study(design.study, options.common.output));
  return run_study(design.study, options.common,
                   [&](const StudyPlan& plan) { leave_results(options, design, plan); });
}

}  // namespace tread
