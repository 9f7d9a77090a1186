#include "drivers/run/run_refusals.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "core/error.hpp"
#include "drivers/engine/traction.hpp"
#include "drivers/results/disk_use.hpp"
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
  require_same_past(fork, model);
  require_disk(model, results, file_bytes(session.order.scene));
  fork_step(model, results.dt);
}

/// Finds the faults of a scene that its model and its disk use show, before an earlier run is thrown away.
void rehearse(const RunSession& session, const Fork* fork) {
  preload_cache(session.options.cache);
  if (fork)
    rehearse_fork(session, *fork);
  else
    require_runnable(scene_model(session.resolved.scene, session.resolved, std::nullopt),
                     file_bytes(session.resolved.source));
}

}  // namespace

void require_disk(const Model& model, const RunResults& results, std::int64_t files) {
  const std::optional<double>& limit = model.scene.output.disk_limit;
  const std::int64_t needed = disk_use(model, results.dt, files).total();
  if (limit && static_cast<double>(needed) > *limit)
    throw InputError(
        fmt::format("the run needs about {}, more than output.disk_limit = {}; raise that, or "
                    "output.history_interval, or state less output.frames",
                    bytes_text(needed), bytes_text(static_cast<std::int64_t>(*limit))));
}

void require_runnable(const Model& model, std::int64_t files) {
  steady_traction(model);
  const Scene& scene = model.scene;
  if (!scene.motion || (!scene.output.disk_limit && !scene.forks)) return;
  RunResults results;
  results.dt = scene.motion->step_safety * step_limit(model).stable_step;
  require_disk(model, results, files);
  fork_step(model, results.dt);
}

void refuse_to_overwrite(const RunSession& session, const Fork* fork) {
  const bool finished = std::filesystem::exists(session.folder / "summary.json");
  if (session.options.overwrite) {
    if (finished || !session.checkpoints.states().empty()) rehearse(session, fork);
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
