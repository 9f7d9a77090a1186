#include "drivers/run/run_model.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <functional>
#include <optional>

#include "core/error.hpp"
#include "core/parallel/ranks.hpp"
#include "drivers/engine/chosen_fields.hpp"
#include "drivers/engine/device/device_movers.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/results/scene_model.hpp"
#include "io/report/plain_text.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

void require_rail_for(const Scene& made, const Scene& later) {
  const double planned = made.motion->duration;
  if (made.wheel && later.motion->duration > planned)
    throw InputError(
        fmt::format("motion.duration = {:g} ms: the rail is divided for the {:g} ms that the run "
                    "began with; state a longer duration when a run begins and end it early",
                    1e3 * later.motion->duration, 1e3 * planned));
}

void require_device_memory(const Model& model, const Device& device) {
  const std::int64_t needed = device_need(model).bytes;
  const std::int64_t free = device.free_bytes();
  if (needed <= free) return;
  const char* less = model.scene.precision == "double" ? "use scene.precision = \"mixed\", " : "";
  throw ResourceError(fmt::format(
      "the scene needs about {} on the device, and {} has {} free; raise scene.element_size, {}or "
      "use --device cpu",
      bytes_text(needed), device.name(), bytes_text(free), less));
}

void settle(const std::function<void()>& require, const std::string& option, const Progress& progress) {
  try {
    require();
  } catch (const Error& error) {
    if (option != "auto" || chosen_ranks()) throw;
    progress.warn(fmt::format("[device] --device auto: the processor takes the steps: {}", error.what()));
    choose_device("cpu");
  }
}

}  // namespace

ResolvedScene resolve_with_later(const RunOrder& order) {
  std::vector<std::string> all = order.overrides;
  all.insert(all.end(), order.later.begin(), order.later.end());
  return resolve_scene(order.scene, all);
}

void adopt_later_values(Model& model, const Scene& later) {
  model.scene.output = later.output;
  model.scene.stop = later.stop;
  if (!model.scene.motion) return;
  require_rail_for(model.scene, later);
  model.scene.motion->duration = later.motion->duration;
}

void require_later_end(const Scene& made, const Scene& later, const SealedContent* state) {
  if (!made.motion) return;
  require_rail_for(made, later);
  if (!state) return;
  const auto steps = sealed_value<std::int64_t>(*state, "state/steps");
  if (steps > step_count(later, sealed_value<double>(*state, "results/dt")))
    throw InputError(fmt::format(
        "motion.duration = {:g} ms: the run has already come to t = {:.6e} s (step {}); state a later end",
        1e3 * later.motion->duration, sealed_value<double>(*state, "state/time"), steps));
}

Model run_model(const ResolvedScene& made, const SealedContent* state, RunResults& results) {
  if (state) unpack_results(*state, results);
  return scene_model(made.scene, made,
                     state ? std::optional(deepest_line(made.scene, results.preload)) : std::nullopt);
}

void find_step(const Model& model, RunResults& results) {
  if (!model.scene.motion) return;
  results.limit = step_limit(model);
  results.dt = model.scene.motion->step_safety * results.limit.stable_step;
}

void settle_device(const Scene& scene, const std::string& option, const Progress& progress) {
  settle([&] { require_steps_of_bodies(scene); }, option, progress);
}

void settle_device(const Model& model, const std::string& option, const Progress& progress) {
  if (!chosen_device() || !model.scene.motion) return;
  settle([&] { require_device_memory(model, *chosen_device()); }, option, progress);
}

}  // namespace tread
