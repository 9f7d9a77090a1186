#include "drivers/bench/rolling_scene.hpp"

#include <fmt/core.h>

#include "core/error.hpp"
#include "drivers/engine/start/start.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/results/run_results.hpp"
#include "drivers/results/scene_model.hpp"
#include "drivers/run/preload_cache.hpp"
#include "drivers/run/run_model.hpp"

namespace tread {

namespace {

Model moving_model(const ResolvedScene& resolved, const Progress& progress, const std::string& device) {
  if (!resolved.scene.motion)
    throw InputError("bench: the scene has no [motion], so there are no steps to time; add one");
  settle_device(resolved.scene, device, progress);
  return scene_model(resolved.scene, resolved);
}

}  // namespace

RollingScene::RollingScene(const ResolvedScene& resolved, const Progress& progress, const std::string& device)
    : model_(moving_model(resolved, progress, device)) {
  settle_device(model_, device, progress);
  const auto say = [&](const std::string& text) { progress.say(fmt::format("[{}]", text)); };
  preload_ = preload_and_corrugate(resolved, model_, say);
  dt_ = model_.scene.motion->step_safety * step_limit(model_).stable_step;
}

Simulation RollingScene::start() const {
  Simulation simulation(model_, preload_, dt_);
  simulation.set_sampling_interval(sampling_interval(model_.scene, dt_));
  return simulation;
}

}  // namespace tread
