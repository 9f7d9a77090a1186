#include "drivers/run/fork.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "drivers/engine/measurements.hpp"
#include "drivers/engine/model/sections.hpp"
#include "drivers/results/rail_ends.hpp"
#include "drivers/results/run_results.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/run/scene_content.hpp"
#include "io/files/checkpoint_folder.hpp"
#include "io/scene/schema.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

/// "DIR@TIME"
struct Place {
  fs::path folder;
  std::optional<double> time;  ///< [s]
};

Place parse_place(const std::string& text) {
  const std::size_t at = text.rfind('@');
  if (at == std::string::npos || fs::is_directory(text)) return {text, std::nullopt};
  try {
    return {text.substr(0, at), parse_quantity(text.substr(at + 1), kTime)};
  } catch (const InputError& error) {
    throw InputError(fmt::format("--from {}: expected a run's folder and a time, such as out@10ms: {}", text,
                                 error.what()));
  }
}

/// Whole steps of length `dt` [s] up to a time [s].
std::int64_t steps_until(double time, double dt) {
  return static_cast<std::int64_t>(std::clamp(std::floor(time / dt + 1e-6), 0.0, 1e18));
}

using Found = CheckpointFolder::Found;

/// Newest of the states that the run keeps for good and of the last two of a run that is not finished.
std::optional<Found> newest(const fs::path& folder, std::int64_t last, std::vector<std::string>& refused) {
  std::optional<Found> found = CheckpointFolder(folder / kForkFolder).newest(refused, require_state, last);
  std::optional<Found> other =
      CheckpointFolder(folder / kCheckpointFolder).newest(refused, require_state, last);
  return other && (!found || other->steps > found->steps) ? std::move(other) : std::move(found);
}

Found find_state(const Place& place, const Progress& progress) {
  require_run_folder(place.folder, "--from: ");
  std::vector<std::string> refused;
  std::optional<Found> found = newest(place.folder, std::numeric_limits<std::int64_t>::max(), refused);
  std::string newest_time;
  if (found && place.time) {
    const double dt = sealed_value<double>(found->content, "results/dt");
    const std::int64_t last = steps_until(*place.time, dt);
    if (found->steps > last) {
      newest_time =
          fmt::format("; its newest is that of {:.6g} ms", 1e3 * dt * static_cast<double>(found->steps));
      found.reset();
      refused.clear();
      found = newest(place.folder, last, refused);
    }
  }
  if (found) {
    for (const std::string& reason : refused) progress.say("[fork] " + reason);
    return std::move(*found);
  }
  const std::string until = place.time ? fmt::format(" up to {:g} ms", 1e3 * *place.time) : "";
  if (!refused.empty())
    throw InputError(
        fmt::format("--from: no state{} in {} is of use: {}; begin from another run, or leave "
                    "--from out",
                    until, place.folder.string(), fmt::join(refused, "; ")));
  throw InputError(
      fmt::format("--from: {} has no state{} to begin with{}; a run keeps one for good where its scene has "
                  "[forks], and its last two checkpoints until it is finished",
                  place.folder.string(), until, newest_time));
}

/// "motion.speed (300 km/h there, 250 km/h here)" for each value whose effects `counts` and that differs, or
/// whose file does.
template <class Counts>
std::vector<std::string> differences(const ResolvedScene& there, const ResolvedScene& here,
                                     const Counts& counts) {
  std::map<std::string, std::array<const Entry*, 2>> values;  // by key; null: absent
  for (std::size_t side = 0; side < 2; ++side)
    for (const Entry& entry : (side == 0 ? there : here).entries)
      if (counts(find_key(entry.path)->effects)) values[entry.path][side] = &entry;
  const SceneContent of_there = content_of(there, counts), of_here = content_of(here, counts);
  std::vector<std::string> texts;
  for (const auto& [path, entry] : values) {
    const auto shown = [](const Entry* of) {
      return of == nullptr || of->shown.empty() ? std::string("absent") : of->shown;
    };
    const bool both = entry[0] != nullptr && entry[1] != nullptr;
    if (both && of_there.at(path) == of_here.at(path)) continue;
    if (!both || entry[0]->value != entry[1]->value || entry[0]->unit != entry[1]->unit)
      texts.push_back(fmt::format("{} ({} there, {} here)", path, shown(entry[0]), shown(entry[1])));
    else
      texts.push_back(fmt::format("{} (another content of {})", path, shown(entry[1])));
  }
  return texts;
}

/// Moved nodes are another mesh.
std::vector<std::string> mesh_differences(const ResolvedScene& there, const ResolvedScene& here) {
  const auto by_nodes = [](const Scene& scene) {
    return scene.corrugation && scene.corrugation->apply == "nodes";
  };
  if (!by_nodes(there.scene) && !by_nodes(here.scene)) return {};
  std::vector<std::string> texts =
      differences(there, here, [](Effects effects) { return effects.has(Effect::surface); });
  if (!texts.empty()) texts.emplace_back("which state corrugation.apply = \"gap\" in both would allow");
  return texts;
}

void require_same_start(const std::string& from, const ResolvedScene& there, const ResolvedScene& here) {
  std::vector<std::string> texts =
      differences(there, here, [](Effects effects) { return effects.on_smooth_motion(); });
  for (std::string& text : mesh_differences(there, here)) texts.push_back(std::move(text));
  if (texts.empty()) return;
  throw InputError(
      fmt::format("--from {}: the scenes differ in what the state there depends on: {}; a fork may have "
                  "another corrugation "
                  "by gap, a shorter motion.duration, other output.*, stop.* and forks.*; for the rest start "
                  "a run of its own",
                  from, fmt::join(texts, ", ")));
}

/// Corrugation depth that the searched surface of the scene's run has room for [m].
double room_of(const Scene& scene) {
  return std::max(depth_room(scene), corrugation_depth(scene));
}

void require_room(const std::string& from, const Scene& scene, double room) {
  const double deepest = corrugation_depth(scene);
  if (deepest > room)
    throw InputError(
        fmt::format("--from {}: the corrugation is {:.4g} mm deep, the run there has searched the surface "
                    "for one of at most "
                    "{:.4g} mm; that run's scene needs contact.depth_room = \"{:.4g} mm\"",
                    from, 1e3 * deepest, 1e3 * room, 1e3 * deepest));
  const std::optional<double>& stated = scene.contact->depth_room;
  if (stated && *stated != room)
    throw InputError(
        fmt::format("--from {}: contact.depth_room = {:.4g} mm, but a fork has that of the run there, {:.4g} "
                    "mm; leave it out",
                    from, 1e3 * *stated, 1e3 * room));
}

/// The same mesh and searched surface as in the other run; its own end comes later, as in a resumed run.
RunOrder order_of(RunOrder wanted, const ResolvedScene& here, const ResolvedScene& there) {
  const double planned = there.scene.motion->duration;
  const double duration = here.scene.motion->duration;
  wanted.overrides.push_back(fmt::format("motion.duration={} s", planned));
  wanted.overrides.push_back(fmt::format("contact.depth_room={} m", room_of(there.scene)));
  if (duration != planned) wanted.later.push_back(fmt::format("motion.duration={} s", duration));
  wanted.resolved = resolved_toml(resolve_scene(wanted.scene, wanted.overrides));
  return wanted;
}

/// The state as a checkpoint of the run that begins: with its order, without the times that the other took.
/// When surfaces cannot touch yet has to be found anew.
SealedContent state_of(SealedContent content, const RunOrder& order) {
  std::erase_if(content, [](const auto& entry) { return entry.first.starts_with("order/"); });
  content.merge(pack_order(order));
  for (const char* name : {"results/seconds_mesh", "results/seconds_preload", "results/seconds_rolling"})
    content[name] = std::vector<double>{0};
  std::vector<double> wake = sealed_entry<std::vector<double>>(content, "state/contact/wake_time");
  std::fill(wake.begin(), wake.end(), -std::numeric_limits<double>::infinity());
  content["state/contact/wake_time"] = std::move(wake);
  return content;
}

/// Takes the values out of the columns of a probe.
void forget_probe(const std::string& probe, MeasuredRows::Kept& kept) {
  const std::size_t width = kept.names.size();
  for (std::size_t c = 0; c < width; ++c) {
    if (!is_column_of(probe, kept.names[c])) continue;
    for (std::size_t i = c; i < kept.values.size(); i += width)
      kept.values[i] = std::numeric_limits<double>::quiet_NaN();
  }
}

/// Takes the values of probes that are others here out of the state.
void forget_other_probes(const Scene& there, const Scene& here, SealedContent& content) {
  MeasuredRows::Kept kept = unpack_measured(content);
  for (const auto& [name, probe] : here.probes) {
    const auto other = there.probes.find(name);
    if (other != there.probes.end() && other->second != probe) forget_probe(name, kept);
  }
  pack_measured(std::move(kept), content);
}

}  // namespace

Fork fork_from(const std::string& from, const RunOrder& wanted, const Progress& progress) {
  const ResolvedScene here = resolve_scene(wanted.scene, wanted.overrides);
  const Place place = parse_place(from);
  Found found = find_state(place, progress);
  const ResolvedScene there = resolve_order(unpack_order(found.content), place.folder);
  if (!here.scene.motion || !here.scene.contact)
    throw InputError(fmt::format("--from {}: a fork needs [motion] and [contact]", from));
  require_same_start(from, there, here);
  const double room = room_of(there.scene);
  require_room(from, here.scene, room);
  Fork fork{order_of(wanted, here, there), {}, there.scene.corrugation};
  fork.order.origin = {place.folder.string(), sealed_value<double>(found.content, "state/time"), found.steps};
  fork.content = state_of(std::move(found.content), fork.order);
  forget_other_probes(there.scene, here.scene, fork.content);
  return fork;
}

double fork_room(const std::string& from) {
  const Place place = parse_place(from);
  const Found found = find_state(place, Progress(true));  // fork_from() tells of states that are of no use
  return room_of(resolve_order(unpack_order(found.content), place.folder).scene);
}

/// Option of the newest earlier state that the run there keeps for good, in brackets; empty: none.
std::string kept_state_text(const Fork& fork) {
  const ForkOrigin& origin = *fork.order.origin;
  std::vector<std::string> refused;
  const std::optional<Found> kept = CheckpointFolder(fs::path(origin.folder) / kForkFolder)
                                        .newest(refused, require_state, origin.steps - 1);
  if (!kept) return "";
  // Half a step later: the digits must not round to an earlier step.
  const double time =
      sealed_value<double>(fork.content, "results/dt") * (static_cast<double>(kept->steps) + 0.5);
  return fmt::format(" (--from {}@{:.9g}ms has a state kept for forks)", origin.folder, 1e3 * time);
}

void require_same_past(const Fork& fork, const Model& model, const std::vector<Sample>& samples) {
  constexpr double kSame = 1e-9;  // [m]
  const Corrugation& here = model.contact->corrugation();
  const Corrugation there =
      fork.corrugation ? corrugation_of(*fork.corrugation, fork.corrugation->centre.value_or(here.centre()))
                       : Corrugation{};
  static_assert(offsetof(BodyFrame, origin) == 0 && offsetof(Vec3, x) == 0);
  const auto& wheel_frame = sealed_entry<std::vector<double>>(fork.content, "state/wheel_frame");
  double foremost = wheel_frame.at(0);  // a braked wheel may have come back
  for (const Sample& sample : samples) foremost = std::max(foremost, sample.wheel_x);
  const double reached = foremost + model.contact->reach();
  const std::optional<double> differs = first_difference(here, there, reached, kSame);
  if (!differs) return;
  throw InputError(fmt::format(
      "--from {}: up to t = {:.6g} ms the patch may reach x = {:.4f} m, but the corrugations differ "
      "by more than 1 nm "
      "from x = {:.4f} m on; fork at an earlier time{}, or let the corrugation begin later",
      fork.order.origin->folder, 1e3 * fork.order.origin->time, reached, *differs, kept_state_text(fork)));
}

double Approach::time(const MotionSpec& motion, double x) const {
  const double acceleration = std::abs(wheel.acceleration(motion));  // reversals drive a braked wheel
  const double speed = motion.speed + std::max(wheel.speed_of_slip(motion), 0.0);
  const double way = x - start - before;
  if (way <= 0 || motion.speed <= 0) return 0;
  return 2 * way / (speed + std::sqrt(speed * speed + 2 * acceleration * way));
}

Approach approach_of(const Scene& scene, double reach) {
  constexpr double kMargin = 0.02;  // [m]
  return {scene.start_x(), reach + kMargin, driven_wheel(scene)};
}

namespace {

/// Time of the state for forks that is not stated: before the patch meets the corrugation or the zone [s].
double usual_fork_time(const Model& model) {
  const Scene& scene = model.scene;
  // Before the preload the contact has no corrugation yet; its ends along the rail do not need the centre.
  const Corrugation corrugation = scene.corrugation ? corrugation_of(*scene.corrugation, 0) : Corrugation();
  const double start = corrugation.smooth() ? scene.zone_start : corrugation.first();
  const double time = approach_of(scene, searched_reach(model)).time(*scene.motion, start);
  if (time <= 0)
    throw InputError(fmt::format(
        "[forks]: at the start the patch is less than 20 mm from x = {:.4f} m, where the corrugation or the "
        "solution zone begins, or the wheel stands; state forks.at",
        start));
  return time;
}

}  // namespace

std::optional<std::int64_t> fork_step(const Model& model, double dt) {
  const std::optional<ForkSpec>& forks = model.scene.forks;
  if (!forks || !model.contact) return std::nullopt;
  return steps_until(forks->at ? *forks->at : usual_fork_time(model), dt);
}

void require_fork_step(const Model& model, double dt, std::int64_t begun) {
  const Scene& scene = model.scene;
  const std::optional<std::int64_t> step = fork_step(model, dt);
  if (!step) return;
  const auto instant = [dt](std::int64_t steps) { return 1e3 * dt * static_cast<double>(steps); };
  const bool stated = scene.forks->at.has_value();
  if (*step > step_count(scene, dt))
    throw InputError(
        fmt::format("{}: the state for other runs is that of t = {:.6g} ms, after motion.duration = {:.6g} "
                    "ms; state a longer "
                    "motion.duration, or an earlier forks.at",
                    stated ? "forks.at" : "[forks]", instant(*step), 1e3 * scene.motion->duration));
  if (stated && *step < begun)
    throw InputError(fmt::format(
        "forks.at = {:.6g} ms lies before t = {:.6g} ms, where this run begins; state a later forks.at, or "
        "leave [forks] out",
        1e3 * *scene.forks->at, instant(begun)));
}

}  // namespace tread
