#include "drivers/bench/rolling_scene.hpp"

#include <fmt/core.h>

#include "core/error.hpp"
#include "drivers/engine/start.hpp"
#include "drivers/engine/static_system.hpp"
#include "drivers/results/memory_need.hpp"
#include "drivers/results/run_results.hpp"
#include "drivers/run/preload_cache.hpp"

namespace tread {

RollingScene::RollingScene(const ResolvedScene& resolved, const Progress& progress) {
  const Scene& scene = resolved.scene;
  if (!scene.motion)
    throw InputError("bench: the scene has no [motion], so there are no steps to time; add one");
  model_ = std::make_unique<Model>(scene, std::nullopt, require_memory);
  const auto say = [&](const std::string& text) { progress.say(fmt::format("[{}]", text)); };
  preload_ = preload_and_corrugate(resolved, *model_, say);
  dt_ = scene.motion->step_safety * step_limit(*model_).stable_step;
}

Simulation RollingScene::start() const {
  Simulation simulation(*model_, preload_, dt_);
  simulation.set_sampling_interval(sampling_interval(model_->scene, dt_));
  return simulation;
}

}  // namespace tread
