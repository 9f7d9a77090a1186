#include "drivers/studies/develop/passage_room.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "drivers/engine/model/sections.hpp"
#include "drivers/results/scene_model.hpp"
#include "drivers/run/fork.hpp"
#include "io/scene/schema.hpp"

namespace tread {

namespace {

/// Depth of waves that grow by the largest change in each of the passages, at least to twice their depth [m].
double grown_depth(const Scene& scene, int passages) {
  const double growth = std::max(2.0, std::pow(1 + scene.wear->change, passages));
  return std::min(growth * corrugation_depth(scene), find_key("contact.depth_room")->range.high);
}

/// Value that gives the wheel of passage 0 more way before the kept state, "a longer motion.run_up".
const char* more_way(const Scene& scene) {
  if (scene.motion->run_up) return "a longer motion.run_up";
  return scene.forks && scene.forks->at ? "a later corrugation.start" : "a later solution_zone.start";
}

/// Sentence on a state of passage 0, with so much room [m], that is kept too late for the other passages;
/// empty where it is in time.
std::string late_state(const ResolvedScene& resolved, double room) {
  constexpr double kFar = 0.3;  // beyond the reach of any patch [m]
  Scene smooth = resolved.scene;
  const MotionSpec& motion = *resolved.scene.motion;
  const bool stated = smooth.forks && smooth.forks->at;
  const double at = stated ? *smooth.forks->at : 0;
  // Passage 0 chooses a time before the zone; a stated one may be later.
  const double place = stated ? corrugation_of(*smooth.corrugation, 0).first() : smooth.zone_start;
  const auto in_time = [&](double latest) { return latest > 0 && at <= latest; };
  if (in_time(approach_of(smooth, kFar).time(motion, place))) return "";
  smooth.contact->depth_room = room;
  smooth.corrugation.reset();
  smooth.wear.reset();
  smooth.forks.emplace();
  const Model model = scene_model(smooth, resolved);
  Approach approach = approach_of(smooth, model.contact->reach());
  if (stated) approach.before = model.contact->reach();  // without the margin
  const double latest = approach.time(motion, place);
  if (in_time(latest)) return "";
  if (!stated)
    return fmt::format(
        "solution_zone.start = {:.4g} mm: all passages begin with a state that is kept before "
        "the patch comes near the zone, but the wheel starts at x = {:.4g} mm and needs a way of more than "
        "{:.4g} mm up to it; state {}, or the time of the state by forks.at",
        1e3 * place, 1e3 * smooth.start_x(), 1e3 * approach.before, more_way(resolved.scene));
  const std::string limit =
      latest > 0 ? fmt::format("after {0:.6g} ms; state at most {0:.6g} ms", std::floor(1e6 * latest) / 1e3)
                 : fmt::format("at the start; state {}", more_way(resolved.scene));
  return fmt::format(
      "forks.at = {:.6g} ms: all passages begin with the state of that time, but the patch may meet the "
      "corrugation, which begins at x = {:.4g} mm, {}",
      1e3 * at, 1e3 * place, limit);
}

}  // namespace

double room_of_passage0(const ResolvedScene& resolved, int passages) {
  const Scene& scene = resolved.scene;
  const double grown = std::max(forks_room(scene), grown_depth(scene, passages));
  if (late_state(resolved, grown).empty()) return grown;
  const double least = std::max(forks_room(scene), grown_depth(scene, 0));
  const std::string late = late_state(resolved, least);
  if (!late.empty()) throw InputError("tread develop: " + late);
  return least;
}

std::string short_room(const Scene& scene, double room, int passages) {
  const double grown = grown_depth(scene, passages);
  if (grown <= room) return "";
  return fmt::format(
      "passage 0 has room for a corrugation of {:.4g} mm, its wheel no way for more; {} passages may make "
      "this one {:.4g} mm deep, and a passage over a deeper one than the room is refused; {} leaves more "
      "room",
      1e3 * room, passages, 1e3 * grown, more_way(scene));
}

std::string outgrown_room(const Scene& scene, const std::string& from, int passages) {
  const double room = fork_room(from);
  const double deepest = corrugation_depth(scene);
  if (deepest > room)
    throw InputError(
        fmt::format("--from {}: the corrugation is {:.4g} mm deep, and the run there has room for {:.4g} mm; "
                    "run it again with a larger contact.depth_room, or leave --from out",
                    from, 1e3 * deepest, 1e3 * room));
  const double grown = grown_depth(scene, passages);
  if (grown <= room) return "";
  return fmt::format(
      "--from {}: the run there has room for a corrugation of {:.4g} mm; {} passages may make this one "
      "{:.4g} mm deep (contact.depth_room of that run), and a passage over a deeper one than the room is "
      "refused",
      from, 1e3 * room, passages, 1e3 * grown);
}

}  // namespace tread
