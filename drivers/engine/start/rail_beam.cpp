#include "drivers/engine/start/rail_beam.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "drivers/engine/model/sections.hpp"

namespace tread {

bool is_of_the_beam(const Scene& scene, const Material& part) {
  const Material& beam = scene.rail_material();
  const auto alike = [](double a, double b) { return std::abs(a - b) <= 0.01 * b; };
  return alike(part.youngs_modulus, beam.youngs_modulus) && alike(part.density, beam.density);
}

BeamSection rail_beam_section(const Scene& scene) {
  if (!scene.rail) throw InputError("a beam section needs [rail]");
  Scene upright = scene;
  upright.quality = "draft";
  // Warping takes memory and time that grow fast with the quads; a large box needs no finer ones.
  constexpr double kElement = 1.1e-3, kAcross = 60;
  const RailSpec& rail = *scene.rail;
  upright.element_size =
      rail.profile == "box" ? std::max(kElement, std::min(rail.width, rail.height) / kAcross) : kElement;
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

/// Stiffness [N/m] and damping [N s/m] of a whole fastening.
struct SupportSpring {
  double stiffness;
  double damping;
};

/// Calls visit(number) for a scene's fastenings and, before its rail's left end, for those of a track that
/// goes on there.
template <class Visit>
void for_fastenings(const Scene& scene, int more_spans, const Visit& visit) {
  for (int i = -more_spans; i < scene.fastenings->count; ++i)
    if (i >= 0 || scene.fastening_x(i) < -scene.rail->origin) visit(i);
}

/// The columns of a scene's fastenings as parts of the springs spring(i) of whole fastenings.
template <class SpringOf>
std::vector<BeamSupport> column_supports(const Scene& scene, int more_spans, const SpringOf& spring) {
  const FasteningSpec& f = *scene.fastenings;
  std::vector<BeamSupport> supports;
  for_fastenings(scene, more_spans, [&](int i) {
    const SupportSpring whole = spring(i);
    for (int column = 0; column < f.columns; ++column)
      supports.push_back({scene.fastening_x(i) + f.column_offset(column), whole.stiffness / f.columns,
                          whole.damping / f.columns});
  });
  return supports;
}

SupportSpring vertical_spring(const Scene& scene, int fastening) {
  const SupportSpec own = scene.support(fastening);
  return {own.stiffness * scene.fastenings->stiffness, own.damping_share() * scene.fastenings->damping};
}

}  // namespace

std::vector<BeamSupport> rail_supports(const Scene& scene, int more_spans) {
  if (!scene.rail) throw InputError("a rail beam needs [rail]");
  if (!scene.fastenings) return {};
  return column_supports(scene, more_spans, [&](int i) { return vertical_spring(scene, i); });
}

std::vector<SleeperSupport> rail_sleepers(const Scene& scene, int more_spans) {
  if (!scene.sleepers) return {};
  const FasteningSpec& f = *scene.fastenings;
  const SleeperSpec& spec = *scene.sleepers;
  std::vector<double> columns;
  for (int column = 0; column < f.columns; ++column) columns.push_back(f.column_offset(column));
  std::vector<SleeperSupport> list;
  for_fastenings(scene, more_spans, [&](int i) {
    const SupportSpring pad = vertical_spring(scene, i);
    const double bed = scene.support(i).bed;
    list.push_back({scene.fastening_x(i),
                    pad.stiffness,
                    pad.damping,
                    {sleeper_mass(scene), bed * spec.stiffness, bed * spec.damping},
                    columns});
  });
  return list;
}

std::vector<BeamSupport> rail_foot_supports(const Scene& scene, int more_spans) {
  if (!scene.fastenings || scene.fastenings->along.kind != "elastic") return {};
  const FootHold& along = scene.fastenings->along;
  return column_supports(scene, more_spans, [&](int i) {
    return scene.support(i).holds ? SupportSpring{along.stiffness, along.damping} : SupportSpring{0, 0};
  });
}

std::vector<FootStretch> rail_foot_holds(const Scene& scene, int more_spans) {
  if (!scene.fastenings || scene.fastenings->along.kind != "held") return {};
  const FasteningSpec& f = *scene.fastenings;
  std::vector<FootStretch> holds;
  for_fastenings(scene, more_spans, [&](int i) {
    if (!scene.support(i).holds) return;
    const double middle = scene.fastening_x(i);
    if (f.held_at == "pad") {
      holds.push_back({middle - 0.5 * f.pad_length, middle + 0.5 * f.pad_length});
      return;
    }
    for (int column = 0; column < f.columns; ++column) {
      const double x = middle + f.column_offset(column);
      holds.push_back({x, x});
    }
  });
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
    for (const SleeperSupport& s : rail_sleepers(scene, more_spans)) beam.support_on_sleeper(s);
  else
    for (const BeamSupport& s : rail_supports(scene, more_spans)) beam.support(s.x, s.stiffness, s.damping);
  if (!properties.has_foot()) return beam;
  for (const BeamSupport& s : rail_foot_supports(scene, more_spans))
    beam.support_foot(s.x, s.stiffness, s.damping);
  for (const FootStretch& s : rail_foot_holds(scene, more_spans)) beam.hold_foot(s.first, s.last);
  return beam;
}

double loaded_deflection(const Scene& scene, double x, double force) {
  const BeamProperties rail = timoshenko(rail_beam_section(scene), scene.rail_material());
  const TrackBeam beam = rail_beam(scene, rail);
  // By reciprocity the weight's deflection at x is the weight times the area of the line under a unit force
  // there.
  const std::vector<double> line = beam.static_state(x, 1);
  constexpr int kParts = 2000;
  double area = 0;
  for (int i = 0; i < kParts; ++i)
    area += beam.deflection(line, beam.left() + beam.length() * (i + 0.5) / kParts) * beam.length() / kParts;
  const double bed = scene.sleepers ? scene.gravity * sleeper_mass(scene) / scene.sleepers->stiffness : 0;
  return force * beam.deflection(line, x) + rail.mass * scene.gravity * area + bed;
}

}  // namespace tread
