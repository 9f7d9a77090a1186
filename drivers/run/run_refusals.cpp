#include "drivers/run/run_refusals.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "core/error.hpp"
#include "drivers/engine/start/traction.hpp"
#include "drivers/engine/step_features.hpp"
#include "drivers/results/disk_use.hpp"
#include "drivers/results/growing_files.hpp"
#include "drivers/results/rail_ends.hpp"
#include "drivers/results/run_results.hpp"
#include "drivers/results/scene_model.hpp"
#include "drivers/run/preload_cache.hpp"
#include "drivers/run/run_model.hpp"
#include "io/report/plain_text.hpp"
#include "io/scene/schema.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

/// Finds the faults of a fork that its model, the state and its disk use show.
void rehearse_fork(const RunSession& session, const Fork& fork) {
  const ResolvedScene made = resolve_scene(session.order.scene, session.order.overrides);
  RunResults results;
  Model model = run_model(made, &fork.content, results);
  adopt_later_values(model, session.resolved.scene);
  require_same_mesh(fork.content, model);
  require_same_past(fork, model, results.samples);
  settle_device(model, session.options.device, session.progress);
  require_disk(model, results.dt, file_bytes(session.order.scene));
  require_free_disk(session, model, results.dt);
  require_fork_step(model, results.dt, fork.order.origin->steps);
}

/// Finds the faults of a scene that its model shows.
void rehearse_scene(const RunSession& session) {
  const ResolvedScene& resolved = session.resolved;
  const Model model = scene_model(resolved.scene, resolved);
  settle_device(model, session.options.device, session.progress);
  RunResults results;
  find_step(model, results);
  require_runnable(model, results.dt, file_bytes(resolved.source));
  require_free_disk(session, model, results.dt);
}

/// Finds the faults of a run that show before the preload, before an earlier run is thrown away.
void rehearse(const RunSession& session, const Fork* fork) {
  preload_cache(session.options.cache);
  if (fork)
    rehearse_fork(session, *fork);
  else
    rehearse_scene(session);
}

/// InputError where the corrugation would turn elements inside out. Nothing for a model that has it.
void require_corrugation(const Model& model) {
  const std::optional<CorrugationSpec>& spec = model.scene.corrugation;
  if (!spec || spec->apply != "nodes" || !model.contact->corrugation().smooth()) return;
  const Model corrugated(model.scene, spec->centre.value_or(0));
}

/// Size of the files that the run still has to write, by the estimate for a time step [s], beyond those in
/// its folder [B].
std::int64_t run_bytes_to_come(const RunSession& session, const Model& model, double dt) {
  const std::int64_t there = folder_bytes(session.folder.path());
  return std::max<std::int64_t>(disk_use(model, dt, file_bytes(session.order.scene)).total() - there, 0);
}

/// Time step whose run has at least as many samples and frames as one of any other step [s].
double shortest_step(const Scene& scene) {
  constexpr double kMostSamples = 1e12;
  const double frames = std::max(scene.output.frames, 1);
  return std::clamp(scene.output.history_interval, scene.motion->duration / kMostSamples,
                    scene.motion->duration / frames);
}

/// Name of results that the session's folder keeps without a run that ends or has begun, such as copies of
/// files or states for forks; empty: none.
std::string kept_results(const RunSession& session) {
  if (!CheckpointFolder(session.folder / kForkFolder).states().empty())
    return fmt::format("{}/", kForkFolder);
  if (session.checkpoints.holds_run()) return "";
  for (const char* name : {"run.h5", "histories.csv", kPatchFile})
    if (std::filesystem::exists(session.folder / name)) return name;
  return "";
}

}  // namespace

void require_disk(const Model& model, double dt, std::int64_t files) {
  const std::optional<double>& limit = model.scene.output.disk_limit;
  const std::int64_t needed = disk_use(model, dt, files).total();
  if (limit && static_cast<double>(needed) > *limit)
    throw InputError(
        fmt::format("the run needs about {}, more than output.disk_limit = {}; raise that, or "
                    "output.history_interval, or state less output.frames",
                    bytes_text(needed), bytes_text(static_cast<std::int64_t>(*limit))));
}

void require_free_disk(const RunSession& session, const Model& model, double dt) {
  if (!model.scene.motion) return;
  const std::filesystem::path& folder = session.folder.path();
  if (dt == 0) {
    const std::int64_t most = run_bytes_to_come(session, model, shortest_step(model.scene));
    if (most <= free_disk(folder).value_or(most)) return;
    RunResults results;
    find_step(model, results);
    dt = results.dt;
  }
  require_free_disk("the run", run_bytes_to_come(session, model, dt), folder,
                    "free some, state less output.frames or choose another folder with -o");
}

void require_runnable(const Model& model, double dt, std::int64_t files) {
  steady_traction(model);
  require_way_on_rail(model);
  require_corrugation(model);
  if (!model.scene.motion) return;
  if (dt == 0) {
    const StepFeatures features(model, 0);  // probes lie in their bodies
    return;
  }
  require_disk(model, dt, files);  // which asks for the places of probes, too
  require_fork_step(model, dt);
}

void refuse_to_overwrite(const RunSession& session, const Fork* fork) {
  const bool finished = std::filesystem::exists(session.folder / "summary.json");
  const std::string kept = kept_results(session);
  if (session.options.overwrite) {
    if (finished || !kept.empty() || !session.checkpoints.states().empty()) rehearse(session, fork);
    return;
  }
  const std::string folder = session.folder.path().string();
  if (!session.checkpoints.states().empty())
    throw InputError(
        fmt::format("{} holds a run that is not finished: {} goes on with it; --overwrite throws it "
                    "away, or choose another folder",
                    folder, session.resume_command()));
  if (finished)
    throw InputError(fmt::format(
        "{} holds a finished run: --overwrite throws it away, or choose another folder with -o", folder));
  if (!kept.empty())
    throw InputError(
        fmt::format("{} holds results of a run ({}): --overwrite throws them away, or choose another folder "
                    "with -o",
                    folder, kept));
}

void refuse_other_keys(const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) {
    const std::string key(trimmed(std::string_view(text).substr(0, text.find('='))));
    const std::optional<Key> known = find_key(key);
    if (!known || key.starts_with(kProbeTables) ||
        !known->effects.only({Effect::duration, Effect::output, Effect::process, Effect::stop}))
      throw InputError(
          fmt::format("--set {}: a run that goes on may change motion.duration, output.* and "
                      "stop.*; for other values start a run with them",
                      text));
  }
}

}  // namespace tread
