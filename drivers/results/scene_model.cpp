#include "drivers/results/scene_model.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "core/mesh/grading.hpp"
#include "core/parallel/ranks.hpp"
#include "drivers/results/memory_need.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

/// "x.toml:12: scene.element_size = 14 mm", or the same of the quality where that sets the size.
std::string size_and_place(const ResolvedScene& origin) {
  for (const char* key : {"scene.element_size", "scene.quality"}) {
    const auto same = [key](const Entry& entry) { return entry.path == key; };
    const auto entry = std::find_if(origin.entries.begin(), origin.entries.end(), same);
    if (entry != origin.entries.end()) return fmt::format("{}: {} = {}", entry->source, key, entry->shown);
  }
  return origin.name;
}

/// Steps on a device and those of several ranks know swept blocks alone.
void require_one_processor(const Scene& scene) {
  if (scene.bodies.empty() || (!chosen_device() && !chosen_ranks())) return;
  throw InputError(fmt::format(
      "body.{}: the steps of a body from a file are those of one process; leave out {}, or state "
      "body.{}.present = false",
      scene.bodies.begin()->first, chosen_device() ? "--device" : "mpirun", scene.bodies.begin()->first));
}

}  // namespace

Model scene_model(const Scene& scene, const ResolvedScene& origin, std::optional<double> corrugation_centre) {
  require_one_processor(scene);
  try {
    return Model(scene, corrugation_centre, require_memory);
  } catch (const MeshSizeError& error) {
    throw InputError(fmt::format("{}: {}", size_and_place(origin), error.what()));
  }
}

}  // namespace tread
