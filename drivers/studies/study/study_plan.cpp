#include "drivers/studies/study/study_plan.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "drivers/process/machine.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/results/resolution.hpp"
#include "drivers/results/scene_model.hpp"
#include "drivers/run/fork.hpp"
#include "drivers/run/preload_cache.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/run/scene_content.hpp"
#include "drivers/studies/study/shared_rolling.hpp"
#include "io/report/plain_text.hpp"
#include "io/scene/problems.hpp"

namespace tread {

namespace {

/// Number of parts with which both paths begin: 1 for "motion.speed" and "motion.duration".
std::ptrdiff_t shared_parts(const std::string& a, const std::string& b) {
  const std::string first = a + ".", second = b + ".";
  const auto apart = std::mismatch(first.begin(), first.end(), second.begin(), second.end()).first;
  return std::count(first.begin(), apart, '.');
}

/// Problems of many points, each reported once: with the first point that has it unless all have it.
class PointProblems {
 public:
  explicit PointProblems(const Study& study) : study_(study) {}

  void add(const PlannedPoint& point, const Problem& problem) {
    Problem placed = problem;
    const StudySetting* nearest = problem.file == "--set" ? nearest_setting(point, problem.key) : nullptr;
    if (nearest && nearest->line > 0)
      std::tie(placed.file, placed.line, placed.column) =
          std::tie(study_.name, nearest->line, nearest->column);
    const auto identity =
        std::make_tuple(placed.file, placed.line, placed.column, placed.key, placed.message);
    Told& told = told_[identity];
    if (told.count++ == 0) std::tie(told.problem, told.point) = std::tie(placed, point.name);
  }

  void throw_if_any() const {
    std::vector<Problem> problems;
    for (const auto& [identity, told] : told_) {
      problems.push_back(told.problem);
      const bool placed = told.problem.file == study_.name;
      if (!placed && told.count < static_cast<int>(study_.points.size()))
        problems.back().message += fmt::format(" (point {})", told.point);
    }
    if (!problems.empty()) throw ProblemsError(std::move(problems));
  }

 private:
  /// The setting with the longest common path, of equals the last; nullptr if there is none.
  const StudySetting* nearest_setting(const PlannedPoint& point, const std::string& key) const {
    const StudySetting* nearest = nullptr;
    for (const auto* settings : {&study_.common, &point.varied})
      for (const StudySetting& setting : *settings)
        if (!nearest || shared_parts(setting.key, key) >= shared_parts(nearest->key, key)) nearest = &setting;
    return nearest;
  }

  struct Told {
    Problem problem;
    std::string point;
    int count = 0;
  };
  const Study& study_;
  std::map<std::tuple<std::string, int, int, std::string, std::string>, Told> told_;
};

PlannedPoint planned(const Study& study, const StudyPoint& point, const std::filesystem::path& folder) {
  PlannedPoint p;
  p.name = point.name;
  p.varied = point.varied;
  for (const StudySetting& s : point.own) p.overrides.push_back(s.as_override());
  for (const StudySetting& s : study.common) p.overrides.push_back(s.as_override());
  for (const StudySetting& s : point.varied) p.overrides.push_back(s.as_override());
  p.folder = folder / point.name;
  return p;
}

/// Meshes of the bodies of a study by all that they are read with.
using BodyMeshes = std::map<std::tuple<std::string, std::string, std::string, double, double, double>,
                            std::shared_ptr<const HexMesh>>;

/// Lets the scene's bodies hold the meshes of earlier points where they are the same.
void share_meshes(Scene& scene, BodyMeshes& known) {
  for (auto& [name, body] : scene.bodies)
    body.mesh =
        known
            .try_emplace({body.file, body.unit, body.part, body.origin_x, body.origin_y, body.origin_z},
                         body.mesh)
            .first->second;
}

void refuse_doubles(const StudyPlan& plan, PointProblems& problems) {
  std::map<SceneContent, std::string> known;
  for (const PlannedPoint& point : plan.points) {
    const auto [first, is_new] = known.try_emplace(point.content, point.name);
    const int line = point.varied.empty() ? 0 : point.varied.back().line;
    if (!is_new)
      problems.add(point, {plan.study.name, line, 0, "",
                           fmt::format("the points {} and {} are the same scene: leave one of them out",
                                       first->second, point.name)});
  }
}

/// Returns true for a point that may have failed by a stop.penetration other than the study's.
bool failed_by_other_penetration(const PlannedPoint& point) {
  const auto stated = [](const SceneContent& values) {
    const auto found = values.find("stop.penetration");
    return found == values.end() ? "" : found->second;
  };
  const SceneContent& there = point.status.process;
  return point.status.code == ExitCode::numerical && !there.empty() &&
         stated(there) != stated(process_values(point.resolved));
}

/// Calls `act(point)` and collects its errors.
void try_point(PlannedPoint& point, const Study& study, PointProblems& problems,
               const std::function<void(PlannedPoint&)>& act) {
  try {
    act(point);
  } catch (const ProblemsError& error) {
    for (const Problem& problem : error.problems) problems.add(point, problem);
  } catch (const InputError& error) {
    problems.add(point, {study.scene.string(), 0, 0, "", error.what()});
  } catch (const ResourceError& error) {
    throw ResourceError(fmt::format("{}: {}", point.name, error.what()));
  }
}

/// Content on which the time of an element's step depends: all that has one of these effects.
SceneContent element_content(const PlannedPoint& point, Effects those = {Effect::mesh, Effect::cost}) {
  const std::optional<CorrugationSpec>& spec = point.resolved.scene.corrugation;
  if (spec && spec->apply == "nodes") those = those | Effects{Effect::surface};
  return content_of(point.resolved, [&](Effects effects) { return effects.any_of(those); });
}

/// Content on which the costs of a point's model depend.
SceneContent model_content(const StudyPlan& plan, const PlannedPoint& point) {
  const Scene& scene = point.resolved.scene;
  SceneContent content = element_content(point, {Effect::mesh, Effect::cost, Effect::output});
  if (const auto room = room_of(plan, point)) content["room"] = fmt::format("{}", *room);
  content["start"] = scene.start();
  add_run(content, scene);
  return content;
}

double duration_of(const PlannedPoint& point) {
  return point.resolved.scene.motion ? point.resolved.scene.motion->duration : 0;
}

/// Estimate of the same model over `ratio` times the duration.
Estimate prolonged(Estimate cost, double ratio) {
  const auto times = [ratio](std::int64_t number) {
    return std::llround(static_cast<double>(number) * ratio);
  };
  cost.steps = times(cost.steps);
  cost.rolling_seconds *= ratio;
  cost.disk.rows = times(cost.disk.rows);
  cost.disk.results = times(cost.disk.results);
  cost.disk.forks = times(cost.disk.forks);
  return cost;
}

/// Builds the model of points that have the same one, and fills their costs and warnings. `times`: of models
/// by element_content(), so that points of one mesh do not differ by the load of the machine.
void project_alike(StudyPlan& plan, const std::vector<PlannedPoint*>& points,
                   std::map<SceneContent, ElementTimes>& times) {
  const PlannedPoint& first = *points.front();
  Model model = scene_model(keeping_scene(plan, first), first.resolved);
  const double reach = model.contact ? model.contact->reach() : 0;
  const Estimate cost = estimate(model, file_bytes(first.resolved.source), times[element_content(first)]);
  const double duration = duration_of(first);
  for (PlannedPoint* point : points) {
    const Scene& scene = point->resolved.scene;
    point->cost = prolonged(cost, duration > 0 ? duration_of(*point) / duration : 1);
    if (scene.contact) place_state(plan, *point, approach_of(scene, reach));
    model.scene = scene;
    point->warnings = resolution_warnings(model);
  }
}

/// Subtracts from the costs the work of other points: preloads that the cache will have, the rolling before a
/// state.
void subtract_shared(StudyPlan& plan) {
  const bool cached = preload_cache("").has_value();
  std::set<SceneContent> solved;
  for (PlannedPoint& point : plan.points) {
    if (!point.cost) continue;
    const double before = point.cost->seconds();
    const bool from_state = begins_with_state(plan, point);
    if (from_state) point.cost->rolling_seconds *= 1 - plan.shared[*point.shared].until / duration_of(point);
    const bool known = cached && !solved.insert(preload_content(point.resolved)).second;
    if (from_state || known) point.cost->preload_seconds = 0;
    if (!point.keeps_state && !point.resolved.scene.forks)
      point.cost->disk.results -= std::exchange(point.cost->disk.forks, 0);
    point.saved_seconds = before - point.cost->seconds();
  }
}

/// Sum of the values of the largest runs at once.
std::int64_t sum_at_once(const StudyPlan& plan, std::vector<std::int64_t> values) {
  std::sort(values.rbegin(), values.rend());
  const auto count = std::min(values.size(), static_cast<std::size_t>(plan.jobs));
  return std::accumulate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count),
                         std::int64_t{0});
}

/// Size of the results of all runs and of the checkpoints of the runs at once, without what `there` says to
/// lie in a point's folder already [B].
std::int64_t disk_need(const StudyPlan& plan, const std::function<std::int64_t(const PlannedPoint&)>& there) {
  std::int64_t sum = 0;
  std::vector<std::int64_t> checkpoints;
  for (const PlannedPoint& point : plan.points) {
    if (!point.cost) continue;
    const std::int64_t files = point.cost->disk.results + point.cost->disk.frames;
    const std::int64_t found = there(point);
    sum += files - std::min(found, files);
    const std::int64_t beyond =
        std::min(std::max<std::int64_t>(0, found - files), point.cost->disk.checkpoints);
    checkpoints.push_back(point.cost->disk.checkpoints - beyond);
  }
  return sum + sum_at_once(plan, std::move(checkpoints));
}

}  // namespace

ExitCode StudyPlan::failure_code() const {
  for (const PlannedPoint& point : points)
    if (point.status.state == PointState::failed) return point.status.code;
  return ExitCode::done;
}

StudyPlan plan_study(const Study& study, const std::filesystem::path& folder) {
  StudyPlan plan;
  plan.study = study;
  plan.folder = folder;
  PointProblems problems(study);
  SceneSource source = study.scene_text.empty() ? load_scene_source(study.scene)
                                                : SceneSource{study.scene.string(), study.scene_text, folder};
  BodyMeshes meshes;
  for (const StudyPoint& point : study.points) plan.points.push_back(planned(study, point, folder));
  for (PlannedPoint& one : plan.points)
    try_point(one, study, problems, [&](PlannedPoint& point) {
      point.resolved = resolve_scene(source, point.overrides);
      // The points share files, which may be larger than all else that the study keeps.
      source.files.insert(point.resolved.source.files.begin(), point.resolved.source.files.end());
      share_meshes(point.resolved.scene, meshes);
      point.content = scene_content(point.resolved);
    });
  problems.throw_if_any();
  refuse_doubles(plan, problems);
  problems.throw_if_any();
  if (study.share) find_shared_rolling(plan);
  return plan;
}

void require_same_study(const StudyPlan& plan) {
  // A study that brings its scene, the paper's, knows its folder by that.
  const bool any = std::any_of(plan.points.begin(), plan.points.end(), [](const PlannedPoint& point) {
    return std::filesystem::exists(point.folder);
  });
  if (any || !plan.study.scene_text.empty()) return;
  for (const auto& entry : std::filesystem::directory_iterator(plan.folder))
    if (std::filesystem::exists(entry.path() / kKeptScene))
      throw InputError(
          fmt::format("-o {}: it holds runs of another study ({}), whose report would be overwritten; choose "
                      "another folder",
                      plan.folder.string(), entry.path().filename().string()));
}

void look_into_folders(StudyPlan& plan) {
  std::string foreign;
  for (PlannedPoint& point : plan.points) {
    point.status = look_into(point.folder, point.content, point.resolved.source.files);
    if (failed_by_other_penetration(point)) point.status.anew = false;
    if (point.status.foreign) foreign += fmt::format("\n{}: {}", point.folder.string(), point.status.why);
  }
  if (!foreign.empty())
    throw InputError(
        fmt::format("{} holds runs of other scenes; choose another folder with -o, or remove theirs (here: "
                    "this study, there: the folder):{}",
                    plan.folder.string(), foreign));
}

void project_cost(StudyPlan& plan, bool retry) {
  use_threads({std::clamp(plan.threads, 1, machine_cores()), ""});
  PointProblems problems(plan.study);
  std::map<SceneContent, std::vector<PlannedPoint*>> alike;
  std::map<SceneContent, ElementTimes> times;
  for (PlannedPoint& point : plan.points)
    if (point.to_run(retry)) alike[model_content(plan, point)].push_back(&point);
  for (const auto& group : alike) {
    const std::vector<PlannedPoint*>& points = group.second;
    try_point(*points.front(), plan.study, problems,
              [&](PlannedPoint&) { project_alike(plan, points, times); });
  }
  problems.throw_if_any();
  choose_keepers(plan, retry);
  subtract_shared(plan);
}

std::vector<SharedWarning> planned_warnings(const StudyPlan& plan) {
  std::vector<SharedWarning> all;
  for (const PlannedPoint& point : plan.points) add_warnings(point.warnings, point.name, all);
  return all;
}

StudyCost total_cost(const StudyPlan& plan) {
  StudyCost cost;
  double longest = 0;
  std::vector<std::int64_t> memory;
  for (const PlannedPoint& point : plan.points) {
    if (!point.cost) continue;
    cost.seconds += point.cost->seconds();
    cost.saved += point.saved_seconds;
    longest = std::max(longest, begins_with_state(plan, point) ? point.cost->seconds() + point.saved_seconds
                                                               : point.cost->seconds());
    memory.push_back(point.cost->memory);
  }
  const bool apart = plan.threads > 0 || plan.cards > 0;  // else one run takes idle cores of another
  cost.wall = apart ? std::max(longest, cost.seconds / plan.jobs) : cost.seconds / machine_cores();
  cost.disk = disk_need(plan, [](const PlannedPoint&) { return std::int64_t{0}; });
  cost.memory = sum_at_once(plan, std::move(memory));
  return cost;
}

std::int64_t disk_still_needed(const StudyPlan& plan) {
  return disk_need(plan, [](const PlannedPoint& point) { return folder_bytes(point.folder); });
}

Table plan_table(const StudyPlan& plan) {
  Table table{"",
              {{.title = "Point", .plain = true},
               {"State"},
               {"Elements", Align::right},
               {"Steps", Align::right},
               {"Time", Align::right},
               {"Disk", Align::right}},
              {}};
  if (!plan.shared.empty()) table.columns.push_back({"Begins"});
  for (const PlannedPoint& point : plan.points) {
    std::vector<std::string> row = {point.name, name_of(point.status.state), "", "", "", ""};
    if (point.cost)
      row = {row[0],
             row[1],
             grouped(point.cost->elements),
             grouped(point.cost->steps),
             duration_text(point.cost->seconds()),
             bytes_text(point.cost->disk.results + point.cost->disk.frames)};
    if (!plan.shared.empty()) row.push_back(beginning_text(plan, point));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace tread
