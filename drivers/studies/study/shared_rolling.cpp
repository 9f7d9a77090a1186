#include "drivers/studies/study/shared_rolling.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "drivers/engine/model/sections.hpp"
#include "drivers/run/fork.hpp"
#include "io/files/checkpoint_folder.hpp"

namespace tread {

namespace {

const SharedRolling* group_of(const StudyPlan& plan, const PlannedPoint& point) {
  return point.shared ? &plan.shared[*point.shared] : nullptr;
}

/// Content that is equal for points whose rolling agrees until their corrugations differ.
SceneContent content_before(const PlannedPoint& point) {
  return content_of(point.resolved, [](Effects effects) {
    return (effects.on_results() && !effects.has(Effect::surface)) || effects.has(Effect::room);
  });
}

SharedRolling group_from(const StudyPlan& plan, const std::vector<std::size_t>& points) {
  SharedRolling group;
  group.points = points;
  group.from_x = std::numeric_limits<double>::max();
  for (const std::size_t i : points) {
    const Scene& scene = plan.points[i].resolved.scene;
    if (!scene.corrugation) continue;
    group.from_x = std::min(group.from_x, corrugation_of(*scene.corrugation, 0).first());
    group.deepest = std::max(group.deepest, corrugation_depth(scene));
  }
  if (group.deepest > forks_room(plan.points[points.front()].resolved.scene)) group.room = group.deepest;
  return group;
}

bool has_state(const PlannedPoint& point) {
  return point.keeps_state && !CheckpointFolder(point.folder / kForkFolder).states().empty();
}

/// Returns true if the point is going to leave the state without a request.
bool will_keep(const PlannedPoint& point) {
  const PointState state = point.status.state;
  return point.keeps_state && state != PointState::failed && state != PointState::done;
}

/// Accepts a state that an earlier study left, if it is not too late and has room.
void recognise_keepers(StudyPlan& plan, const SharedRolling& group) {
  constexpr double kRounding = 1 + 1e-12;
  for (const std::size_t i : group.points) {
    PlannedPoint& point = plan.points[i];
    const PointStatus& status = point.status;
    if (status.keeps_at && *status.keeps_at <= group.until * kRounding && status.room >= group.deepest)
      point.keeps_state = true;
  }
}

void choose_keeper(StudyPlan& plan, const SharedRolling& group, bool retry) {
  PlannedPoint* first = nullptr;
  for (const std::size_t i : group.points) {
    PlannedPoint& point = plan.points[i];
    if (has_state(point) || will_keep(point)) return;
    if (!point.begins_anew() || !point.to_run(retry)) continue;
    if (first) {
      first->keeps_state = true;
      return;
    }
    first = &point;
  }
}

/// Returns true if runs of the scene can begin with the state of another one, or keep it, for another
/// corrugation. A scene with [forks] keeps a state of its own.
bool can_share(const Scene& scene) {
  if (!scene.motion || scene.motion->speed <= 0 || !scene.contact || scene.forks) return false;
  if (scene.corrugation && scene.corrugation->apply != "gap") return false;
  return !scene.contact->depth_room || corrugation_depth(scene) <= *scene.contact->depth_room;
}

}  // namespace

void find_shared_rolling(StudyPlan& plan) {
  std::map<SceneContent, std::vector<std::size_t>> alike;
  for (std::size_t i = 0; i < plan.points.size(); ++i)
    if (can_share(plan.points[i].resolved.scene)) alike[content_before(plan.points[i])].push_back(i);
  for (const auto& [content, points] : alike) {
    if (points.size() < 2) continue;
    for (const std::size_t i : points) plan.points[i].shared = plan.shared.size();
    plan.shared.push_back(group_from(plan, points));
  }
}

std::optional<double> room_of(const StudyPlan& plan, const PlannedPoint& point) {
  return point.shared ? plan.shared[*point.shared].room : std::nullopt;
}

Scene keeping_scene(const StudyPlan& plan, const PlannedPoint& point) {
  Scene scene = point.resolved.scene;
  if (!can_share(scene)) return scene;
  scene.forks.emplace();
  if (const auto room = room_of(plan, point)) scene.contact->depth_room = room;
  return scene;
}

void place_state(StudyPlan& plan, const PlannedPoint& point, const Approach& approach) {
  if (!point.shared || plan.shared[*point.shared].until > 0) return;
  SharedRolling& group = plan.shared[*point.shared];
  const MotionSpec& motion = *point.resolved.scene.motion;
  group.until = std::min(approach.time(motion, group.from_x), motion.duration);
  if (group.until > 0) return;
  const std::vector<std::size_t> alone = std::exchange(group.points, {});
  for (const std::size_t i : alone) plan.points[i].shared.reset();
}

void choose_keepers(StudyPlan& plan, bool retry) {
  for (const SharedRolling& group : plan.shared) {
    if (group.until <= 0) continue;
    recognise_keepers(plan, group);
    choose_keeper(plan, group, retry);
  }
}

const PlannedPoint* keeper_of(const StudyPlan& plan, const PlannedPoint& point) {
  if (const SharedRolling* group = group_of(plan, point))
    for (const std::size_t i : group->points)
      if (const PlannedPoint& other = plan.points[i]; &other != &point && has_state(other)) return &other;
  return nullptr;
}

bool begins_with_state(const StudyPlan& plan, const PlannedPoint& point) {
  const SharedRolling* group = group_of(plan, point);
  if (!group || point.keeps_state || !point.begins_anew()) return false;
  return std::any_of(group->points.begin(), group->points.end(), [&](std::size_t i) {
    const PlannedPoint& other = plan.points[i];
    return &other != &point && other.keeps_state;
  });
}

std::string beginning_text(const StudyPlan& plan, const PlannedPoint& point) {
  const SharedRolling* group = group_of(plan, point);
  if (!group || (!point.keeps_state && !begins_with_state(plan, point))) return "";
  const double time = 1e3 * group->until;
  if (point.keeps_state) return fmt::format("keeps the state at {:.4g} ms", time);
  const auto keeper = std::find_if(group->points.begin(), group->points.end(),
                                   [&](std::size_t i) { return plan.points[i].keeps_state; });
  return fmt::format("at {:.4g} ms, from {}", time, plan.points[*keeper].name);
}

bool waits_for_state(const StudyPlan& plan, const PlannedPoint& point) {
  const SharedRolling* group = group_of(plan, point);
  if (!group || point.keeps_state || !point.begins_anew() || keeper_of(plan, point)) return false;
  return std::any_of(group->points.begin(), group->points.end(),
                     [&](std::size_t i) { return will_keep(plan.points[i]); });
}

std::vector<std::string> sharing_arguments(const StudyPlan& plan, const PlannedPoint& point) {
  const SharedRolling* group = group_of(plan, point);
  if (!group) return {};
  if (point.keeps_state) {
    std::vector<std::string> arguments = {"--set", fmt::format("forks.at={} s", group->until)};
    if (group->room)
      arguments.insert(arguments.end(), {"--set", fmt::format("contact.depth_room={} m", *group->room)});
    return arguments;
  }
  const PlannedPoint* keeper = keeper_of(plan, point);
  if (!keeper) return {};
  return {"--from", fmt::format("{}@{} s", keeper->folder.string(), group->until)};
}

std::vector<PlannedPoint*> replace_keeper(StudyPlan& plan, PlannedPoint& point) {
  if (!point.keeps_state || point.status.state != PointState::failed || has_state(point)) return {};
  point.keeps_state = false;
  const SharedRolling& group = plan.shared[*point.shared];
  if (point.status.code != ExitCode::numerical) {
    choose_keeper(plan, group, false);
    return {};
  }
  std::vector<PlannedPoint*> doomed;
  for (const std::size_t i : group.points)
    if (plan.points[i].begins_anew() && &plan.points[i] != &point) doomed.push_back(&plan.points[i]);
  return doomed;
}

}  // namespace tread
