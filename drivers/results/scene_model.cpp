#include "drivers/results/scene_model.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <string>

#include "core/mesh/grading.hpp"
#include "drivers/engine/chosen_fields.hpp"

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

/// Largest element size that all parts of the mesh take [m], where one takes `fits`; 0: not known.
double fitting_all(Scene scene, double fits) {
  while (fits > 0) {
    scene.element_size = fits;
    try {
      const Model coarse(scene, std::nullopt, require_memory);
      return fits;
    } catch (const MeshSizeError& next) {
      fits = next.fits < fits ? next.fits : 0;
    } catch (const Error&) {
      return 0;
    }
  }
  return 0;
}

}  // namespace

Model scene_model(const Scene& scene, const ResolvedScene& origin, std::optional<double> corrugation_centre,
                  const AcceptMesh& accept) {
  require_steps_of_bodies(scene);
  try {
    return Model(scene, corrugation_centre, accept);
  } catch (const MeshSizeError& error) {
    const double all = fitting_all(scene, error.fits);
    const std::string others =
        all < error.fits && all > 0 ? fmt::format(", the other parts need {:.4g} mm", 1e3 * all) : "";
    throw InputError(fmt::format("{}: {}{}", size_and_place(origin), error.what(), others));
  }
}

}  // namespace tread
