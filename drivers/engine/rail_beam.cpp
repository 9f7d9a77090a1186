#include "drivers/engine/rail_beam.hpp"

#include <numbers>

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

namespace {

/// The columns of a scene's fastenings as parts of spring-dampers of a whole fastening.
std::vector<BeamSupport> column_supports(const Scene& scene, int more_spans, double stiffness,
                                         double damping) {
  const FasteningSpec& f = *scene.fastenings;
  std::vector<BeamSupport> supports;
  for (int i = -more_spans; i < f.count; ++i)
    for (int column = 0; column < f.columns; ++column)
      supports.push_back({f.position(i) + f.column_offset(column) - scene.rail->origin, stiffness / f.columns,
                          damping / f.columns});
  return supports;
}

}  // namespace

std::vector<BeamSupport> rail_supports(const Scene& scene, int more_spans) {
  if (!scene.rail) throw InputError("a rail beam needs [rail]");
  if (!scene.fastenings) return {};
  return column_supports(scene, more_spans, scene.fastenings->stiffness, scene.fastenings->damping);
}

std::vector<SleeperSupport> rail_sleepers(const Scene& scene, int more_spans) {
  if (!scene.sleepers) return {};
  const FasteningSpec& f = *scene.fastenings;
  const SleeperSpec& spec = *scene.sleepers;
  std::vector<SleeperSupport> list;
  for (int i = -more_spans; i < f.count; ++i) {
    const bool hangs = i + 1 == spec.hanging;
    list.push_back({f.position(i) - scene.rail->origin,
                    f.stiffness,
                    f.damping,
                    {sleeper_mass(scene), hangs ? 0 : spec.stiffness, hangs ? 0 : spec.damping}});
  }
  return list;
}

std::vector<BeamSupport> rail_foot_supports(const Scene& scene, int more_spans) {
  if (!scene.fastenings || scene.fastenings->along.kind != "elastic") return {};
  const FootHold& along = scene.fastenings->along;
  return column_supports(scene, more_spans, along.stiffness, along.damping);
}

std::vector<FootStretch> rail_foot_holds(const Scene& scene, int more_spans) {
  if (!scene.fastenings || scene.fastenings->along.kind != "held") return {};
  const FasteningSpec& f = *scene.fastenings;
  std::vector<FootStretch> holds;
  if (f.held_at == "springs") {
    for (const BeamSupport& s : column_supports(scene, more_spans, 0, 0)) holds.push_back({s.x, s.x});
    return holds;
  }
  for (int i = -more_spans; i < f.count; ++i) {
    const double middle = f.position(i) - scene.rail->origin;
    holds.push_back({middle - 0.5 * f.pad_length, middle + 0.5 * f.pad_length});
  }
  return holds;
}

double sleeper_mass(const Scene& scene) {
  const SleeperSpec& spec = *scene.sleepers;
  return scene.material(spec.material).density * spec.width * spec.length * spec.height;
}

double head_spread(const Scene& scene, const BeamProperties& properties) {
  if (!scene.fastenings || properties.depth == 0) return 0;
  return head_spread(properties.depth, scene.rail_material().poissons_ratio,
                     2 * std::numbers::pi / scene.fastenings->spacing);
}

TrackBeam rail_beam(const Scene& scene, const BeamProperties& properties, int more_spans) {
  if (!scene.rail) throw InputError("a rail beam needs [rail]");
  const RailSpec& rail = *scene.rail;
  const double more = scene.fastenings ? more_spans * scene.fastenings->spacing : 0;
  constexpr double kElement = 0.01;  // [m]
  TrackBeam beam(properties, -rail.origin - more, rail.length + more, BeamEnds::guided, kElement,
                 scene.sleepers.has_value());
  beam.spread_head_load(head_spread(scene, properties));
  if (scene.sleepers)
    for (const SleeperSupport& s : rail_sleepers(scene, more_spans))
      beam.support_on_sleeper(s.x, s.stiffness, s.damping, s.sleeper);
  else
    for (const BeamSupport& s : rail_supports(scene, more_spans)) beam.support(s.x, s.stiffness, s.damping);
  if (!properties.has_foot()) return beam;
  for (const BeamSupport& s : rail_foot_supports(scene, more_spans))
    beam.support_foot(s.x, s.stiffness, s.damping);
  for (const FootStretch& s : rail_foot_holds(scene, more_spans)) beam.hold_foot(s.first, s.last);
  return beam;
}

}  // namespace tread
