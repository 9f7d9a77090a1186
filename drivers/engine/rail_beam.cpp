#include "drivers/engine/rail_beam.hpp"

#include "core/error.hpp"
#include "drivers/engine/sections.hpp"

namespace tread {

BeamSection rail_beam_section(const Scene& scene) {
  if (!scene.rail) throw InputError("a beam section needs [rail]");
  Scene upright = scene;
  upright.quality = "draft";
  upright.element_size = 1.1e-3;
  upright.rail->inclination = 0;
  const MeshSizes sizes = mesh_sizes(upright);
  const double nu = scene.rail_material().poissons_ratio;
  if (scene.rail->profile == "box") {
    const Section box = box_rail_section(upright, sizes);
    return beam_section({&box}, nu);
  }
  const RailSections sections = rail_sections(upright, sizes);
  return beam_section({&sections.cap, &sections.base}, nu);
}

}  // namespace tread
