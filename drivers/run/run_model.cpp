#include "drivers/run/run_model.hpp"

#include <fmt/core.h>

#include "core/error.hpp"

namespace tread {

ResolvedScene resolve_with_later(const RunOrder& order) {
  std::vector<std::string> all = order.overrides;
  all.insert(all.end(), order.later.begin(), order.later.end());
  return resolve_scene(order.scene, all);
}

void adopt_later_values(Model& model, const Scene& later) {
  model.scene.output = later.output;
  model.scene.stop = later.stop;
  if (!model.scene.motion) return;
  const double planned = model.scene.motion->duration;
  if (model.scene.wheel && later.motion->duration > planned)
    throw InputError(
        fmt::format("motion.duration = {:g} ms: the rail is divided for the {:g} ms that the run "
                    "began with; state a longer duration when a run begins and end it early",
                    1e3 * later.motion->duration, 1e3 * planned));
  model.scene.motion->duration = later.motion->duration;
}

}  // namespace tread
