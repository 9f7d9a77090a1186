#include "drivers/engine/model/model.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/geometry/profiles.hpp"
#include "core/mesh/rail_section.hpp"
#include "core/mesh/structured.hpp"
#include "core/mesh/wheel_section.hpp"
#include "core/travel.hpp"
#include "drivers/engine/model/attachments.hpp"
#include "drivers/engine/model/lateral_gap.hpp"
#include "drivers/engine/model/rail_foot.hpp"
#include "drivers/engine/model/restraints.hpp"
#include "drivers/engine/model/scene_requirements.hpp"
#include "drivers/engine/model/sections.hpp"
#include "drivers/engine/model/surfaces.hpp"
#include "kernels/element/front_plan.hpp"
#include "kernels/material/laws.hpp"

namespace tread {

namespace {

/// Sets the scale of penalty and first overlap where the wheel has hardly any load [N].
constexpr double kLeastLoad = 100;

/// Friction law of the scene. A table's law refers to the spec's arrays. InputError for an unknown name.
FrictionLaw friction_of(const ContactSpec& spec) {
  if (spec.friction_law == "table")
    return TableFriction{spec.friction_x.data(), spec.friction_at_x.data(),
                         static_cast<int>(spec.friction_x.size()), spec.friction_start};
  if (spec.friction_law == "falling")
    return FallingFriction{spec.friction, spec.friction_fast, spec.friction_speed, spec.friction_memory};
  if (spec.friction_law == "coulomb") return CoulombFriction{spec.friction};
  spec.refuse_friction_law();
}

}  // namespace

Model::Model(const Scene& source, std::optional<double> corrugation_centre, const AcceptMesh& accept)
    : scene(source), sizes(mesh_sizes(source)) {
  require_scene(scene);
  build_blocks();
  if (accept) accept({elements(), nodes()}, sizes);
  tie_blocks();
  const Corrugation shape = corrugation_centre ? corrugate(*corrugation_centre) : Corrugation();
  build_operators();
  restrained = restrained_unknowns(scene, {mesh, index, ties ? &*ties : nullptr});
  build_connectors();
  if (scene.wheel) build_wheel_parts();
  if (scene.contact && scene.rail && scene.wheel) build_contact(shape);
}

void Model::build_blocks() {
  if (scene.rail) build_rail();
  if (scene.slab_track) build_slab();
  if (scene.sleepers) build_sleepers();
  if (scene.wheel) build_wheel();
  build_bodies();
  if (mesh.blocks.empty()) throw InputError("the scene has neither [rail] nor [wheel]: nothing to compute");
}

void Model::build_operators() {
  build_internal();
  build_mass();
  set_damping();
}

void Model::build_connectors() {
  const auto block = [&](int b) { return b >= 0 ? &mesh.blocks[static_cast<std::size_t>(b)] : nullptr; };
  if (scene.fastenings && scene.rail) {
    std::vector<const SweptBlock*> below(static_cast<std::size_t>(scene.fastenings->count),
                                         block(index.slab));
    for (std::size_t i = 0; i < index.sleepers.size(); ++i) below[i] = block(index.sleepers[i]);
    std::vector<SpringDampers::Element> elements =
        fastening_elements(scene, foot_of_rail(scene, mesh, index), below);
    if (scene.sleepers)
      for (std::size_t i = 0; i < below.size(); ++i)
        for (const SpringDampers::Element& element :
             bed_elements(*scene.sleepers, scene.support(static_cast<int>(i)).bed, *below[i]))
          elements.push_back(element);
    fastenings.emplace(std::move(elements));
  }
  if (scene.hammer && scene.rail)
    hammer = attach_to_surface(*block(index.rail_cap), scene.hammer->position, 0);
}

int Model::add(SweptBlock block) {
  number_by_front(block.section);
  return mesh.add(std::move(block));
}

void Model::build_rail() {
  const RailSpec& rail = *scene.rail;
  const Material& material = scene.rail_material();
  const Span length{-rail.origin, rail.length - rail.origin};
  if (rail.profile == "box") {
    const int evenly = std::max(1, static_cast<int>(std::lround(rail.length / sizes.contact)));
    const std::vector<Segment> segments =
        scene.wheel ? plan_rail(length, run_span(scene), zone_spans(scene), sizes).fine
                    : std::vector<Segment>{{evenly, rail.length / evenly, 0}};
    index.rail_cap = add(make_swept_block("rail", Sweep::extruded, box_rail_section(scene, sizes), {material},
                                          length.first, segments));
    return;
  }
  const NestedSegments plan = scene.wheel ? plan_rail(length, run_span(scene), zone_spans(scene), sizes)
                                          : plan_even_rail(length, sizes);
  RailSections sections = rail_sections(scene, sizes);
  index.rail_cap = add(make_swept_block("rail head", Sweep::extruded, std::move(sections.cap),
                                        {scene.head_material()}, length.first, plan.fine));
  if (scene.body_replacing("rail")) return;
  index.rail_base = add(make_swept_block("rail", Sweep::extruded, std::move(sections.base), {material},
                                         length.first, plan.coarse));
  tie_specs.push_back({index.rail_cap, "tie", index.rail_base, "tie"});
}

double Model::foot_height() const {
  double lowest = 0;
  if (const auto* body = scene.body_replacing("rail")) {
    const HexMesh& file = *body->second.mesh;
    for (const std::int32_t node : file.node_sets.at(body->second.foot))
      lowest = std::min(lowest, file.nodes[static_cast<std::size_t>(node)].z);
    return lowest;
  }
  const Section& rail = mesh.blocks[static_cast<std::size_t>(index.rail_foot())].section;
  for (const int node : rail.paths.at("foot"))
    lowest = std::min(lowest, rail.q[static_cast<std::size_t>(node)]);
  return lowest;
}

void Model::build_slab() {
  const SlabSpec& slab = *scene.slab_track;
  const RailSpec& rail = *scene.rail;
  const double left = -rail.origin;
  // Alternating stretches of slab (material 0) and gap filler (1); mortar is material 2 of every quad below.
  std::vector<Segment> segments;
  const auto stretch = [&](double length, int material) {
    if (length < 1e-9) return;
    const int count = std::max(1, static_cast<int>(std::lround(length / sizes.slab)));
    segments.push_back({count, length / count, material});
  };
  double at = 0;
  for (double gap = slab.first_gap; gap - 0.5 * slab.gap < rail.length; gap += slab.pitch) {
    const double first = std::clamp(gap - 0.5 * slab.gap, 0.0, rail.length);
    const double last = std::clamp(gap + 0.5 * slab.gap, 0.0, rail.length);
    stretch(first - at, 0);
    stretch(last - first, 1);
    at = last;
  }
  stretch(rail.length - at, 0);
  const Material& mortar = scene.material(slab.mortar_material);
  const std::vector<Material> materials = {scene.material(slab.material), scene.material(slab.gap_material),
                                           mortar, mortar};
  SweptBlock block = make_swept_block("slab", Sweep::extruded, slab_section(slab, foot_height(), sizes),
                                      materials, left, segments);
  // Held along and across, the nodes let the slab shear and be compressed, but not bend.
  block.vertical_only = true;
  index.slab = add(std::move(block));
}

void Model::build_sleepers() {
  const SleeperSpec& spec = *scene.sleepers;
  const Section section = sleeper_section(spec, foot_height(), sizes);
  const int elements = std::max(2, static_cast<int>(std::lround(spec.width / sizes.slab)));
  for (int i = 0; i < scene.fastenings->count; ++i) {
    const double middle = scene.fastening_x(i);
    index.sleepers.push_back(add(make_swept_block(fmt::format("sleeper {}", i + 1), Sweep::extruded, section,
                                                  {scene.material(spec.material)}, middle - 0.5 * spec.width,
                                                  {{elements, spec.width / elements, 0}})));
  }
}

void Model::build_wheel() {
  const Material& material = scene.wheel_material();
  const auto on_wheel = [&](Span span) {
    return arc_of(scene, {span.first - scene.start_x(), span.last - scene.start_x()});
  };
  std::vector<Span> zones = zone_spans(scene);
  for (Span& zone : zones) zone = on_wheel(zone);
  if (scene.wheel->shape == "tyre") {
    const std::optional<double>& overhang = scene.wheel->overhang;
    const double run = scene.motion ? scene.motion->speed * scene.motion->duration : 0;
    const WheelPlan plan =
        overhang ? plan_tyre_part(wheel_radius(), arc_of(scene, {0, run}), zones, *overhang, sizes)
                 : plan_tyre(wheel_radius(), on_wheel(run_span(scene)), zones, sizes);
    index.tread = add(make_swept_block("tyre", Sweep::revolved, tyre_section(scene, sizes), {material},
                                       plan.start, plan.tread));
    return;
  }
  const WheelPlan plan = plan_wheel(wheel_radius(), zones, sizes);
  SizedWheel sized = wheel_sections(scene, sizes, plan);
  WheelSections& sections = sized.sections;
  web_thickness = sized.web_thickness;
  brake_ring_thickness = sized.brake_ring_thickness;
  index.tread = add(make_swept_block("tread", Sweep::revolved, std::move(sections.tread), {material},
                                     plan.start, plan.tread));
  const bool swept_disc = scene.body_replacing("disc") == nullptr;
  if (swept_disc)
    index.disc = add(make_swept_block("wheel disc", Sweep::revolved, std::move(sections.disc), {material},
                                      plan.start, plan.disc));
  index.axle = add(
      make_swept_block("axle", Sweep::revolved, std::move(sections.axle), {material}, plan.start, plan.axle));
  if (!swept_disc) return;
  tie_specs.push_back({index.tread, "tie", index.disc, "tie_outer"});
  tie_specs.push_back({index.disc, "tie_inner", index.axle, "tie"});
}

void Model::build_internal() {
  internal = std::make_unique<InternalForce>(mesh);
  body_forces.clear();
  const bool turns = scene.motion.has_value();
  if (turns)
    for (const int b : index.wheel()) internal->set_finite_rotation(b, true);
  for (const HexBody& body : mesh.bodies)
    body_forces.push_back(std::make_unique<BodyForce>(body, turns && body.spins));
}

void Model::build_mass() {
  mass.assign(static_cast<std::size_t>(mesh.slots), 0.0);
  add_lumped_mass(mass.data());
  if (ties) ties->gather_mass(mass.data());
  if (scene.wheel) balance(mesh, index.wheel(), mass.data());
}

void Model::set_damping() {
  std::map<std::string, double> highest;  // frequency of a material's elements, by its name [rad/s]
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const Material& material = mesh.blocks[b].materials.front();  // the others are damped alike
    double& omega = highest[material.name];
    if (material.high_frequency_fraction > 0)
      omega = std::max(omega, internal->max_frequency(static_cast<int>(b)).omega);
  }
  for (const auto& body : body_forces) {
    const Material& material = body->body().materials.front();
    if (material.high_frequency_fraction > 0)
      highest[material.name] = std::max(highest[material.name], body->elements().max_frequency().omega);
  }
  const auto beta_of = [&](const Material& material) {
    const double fraction = material.high_frequency_fraction;  // of critical: beta omega / 2
    return fraction > 0 ? 2 * fraction / highest[material.name] : material.rayleigh_beta;
  };
  for (const auto& body : body_forces) {
    const Material& material = body->body().materials.front();
    body->set_damping(beta_of(material), material.branch());
  }
  beta.assign(mesh.blocks.size(), 0.0);
  branches.assign(mesh.blocks.size(), std::nullopt);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const Material& material = mesh.blocks[b].materials.front();
    branches[b] = material.branch();
    if (branches[b])
      internal->set_branch(static_cast<int>(b), branches[b]->strength);
    else
      beta[b] = beta_of(material);
    internal->set_beta(static_cast<int>(b), beta[b]);
  }
}

bool Model::has_branches() const {
  return std::ranges::any_of(branches, [](const auto& branch) { return branch.has_value(); }) ||
         std::ranges::any_of(body_forces, [](const auto& body) { return body->branch().has_value(); });
}

void Model::build_wheel_parts() {
  wheelset.emplace(mesh, index.wheel(), mass.data());
  const bool tyre = index.axle < 0;
  const SweptBlock& block = mesh.blocks[static_cast<std::size_t>(tyre ? index.tread : index.axle)];
  if (tyre && scene.wheel->bore == "guided") {
    guide.emplace(block, block.section.paths.at("bore"), mass.data());
    return;
  }
  if (scene.vehicle || scene.load)
    journal = Journal(block, block.section.paths.at(tyre ? "bore" : "journal"), mass.data());
  if (scene.motion && (scene.motion->traction_mu || scene.motion->traction_torque))
    torque = AxleTorque(block, block.section.paths.at(tyre ? "bore" : "symmetry_end"), mass.data());
}

double Model::wheel_load() const {
  return scene.wheel ? journal_load() + wheelset->mass() * scene.gravity : 0;
}

double Model::journal_load() const {
  return carried_load(scene);
}

double Model::line_semi_axis() const {
  return tread::line_semi_axis(wheel_radius(), scene.elastic_pair().contact_modulus(), line_load());
}

double Model::hertz_pressure() const {
  return line_width > 0 ? 2 / std::numbers::pi * line_load() / line_semi_axis() : hertz_patch.max_pressure;
}

HertzPatch Model::scale_patch() const {
  return hertz(wheel_radius(), hertz_radius_y, scene.elastic_pair().contact_modulus(),
               std::max(wheel_load(), kLeastLoad));
}

double Model::penalty_stiffness(const ContactSpec& spec) const {
  const HertzPatch scale = scale_patch();
  const double unit_ratio = scale.max_pressure / scale.approach;
  // A softer penalty widens the patch; under a stiffer one the points of a face share its load unevenly.
  // [limits.md, Penalty]
  constexpr double kPerElement = 10;
  // Harmonic mean of the moduli: one element of each body in series.
  const ElasticPair bodies = scene.elastic_pair();
  const double youngs_modulus =
      2 * bodies.wheel.youngs_modulus / (1 + bodies.wheel.youngs_modulus / bodies.rail.youngs_modulus);
  const double preferred = std::max(kPerElement * youngs_modulus / sizes.contact, unit_ratio / 0.02);
  if (!spec.penetration_ratio) return preferred;
  // At ten times the stiffness, 10 to 40 % of the area are missing and points carry up to twice the pressure.
  constexpr double kStiffest = 10;
  const double stated = unit_ratio / *spec.penetration_ratio;
  if (stated > kStiffest * preferred * (1 + 1e-9))
    throw InputError(
        fmt::format("contact.penetration_ratio = {:.3g}: the penalty is {:.3g} times as stiff as suits "
                    "elements of {:.3g} mm; the "
                    "integration points of a face would share its load unevenly and the patch come out too "
                    "small; state at "
                    "least {:.3g}, or leave it out",
                    *spec.penetration_ratio, stated / preferred, 1e3 * sizes.contact,
                    1.005 * unit_ratio / (kStiffest * preferred)));  // rounds to no less than the least
  return stated;
}

void Model::build_contact(const Corrugation& shape) {
  const ContactSpec& spec = *scene.contact;
  const SurfaceProfile rail(mesh.blocks[static_cast<std::size_t>(index.rail_cap)].section);
  const SurfaceProfile wheel(mesh.blocks[static_cast<std::size_t>(index.tread)].section);
  const LateralGap gap = lateral_gap(rail, wheel);
  hertz_radius_y = gap.radius;
  line_width = gap.width;
  const double modulus = scene.elastic_pair().contact_modulus();
  hertz_patch = hertz(wheel_radius(), hertz_radius_y, modulus, wheel_load() > 0 ? wheel_load() : kLeastLoad);

  ContactOptions options;
  options.rail_block = index.rail_cap;
  options.wheel_block = index.tread;
  options.surface = spec.surface == "facets" ? SurfaceKind::facets : SurfaceKind::exact;
  options.straight_across = scene.plane_strain;
  options.points = spec.points;
  options.penalty = penalty_stiffness(spec);
  options.friction = friction_of(spec);
  options.wheel_radius = wheel_radius();
  // At the patch's border the undeformed surfaces are apart by up to the approach; of a line contact by a^2 /
  // 2R.
  const double per_width = line_width > 0 ? line_load() : 0;
  const double border_gap = std::max(hertz_patch.approach, 2 * per_width / (std::numbers::pi * modulus));
  options.reach_gap = std::max(options.reach_gap, 3 * border_gap);
  options.static_force = wheel_load();
  const auto yields = [](const Material& material) { return !is_linear(Laws::find(material.law)); };
  options.yields = yields(scene.wheel_material()) || yields(scene.head_material());
  options.depth_room = depth_room(scene);
  options.rail_depth = rail_surface(scene);
  options.wheel_depth = wheel_surface(scene);
  contact = std::make_unique<Contact>(mesh, options, shape);
}

Corrugation Model::corrugate(double centre) {
  if (!scene.corrugation) return {};
  const CorrugationSpec& spec = *scene.corrugation;
  Corrugation shape = corrugation_of(spec, centre);
  if (spec.apply == "nodes")
    shift_top_layers(mesh.blocks[static_cast<std::size_t>(index.rail_cap)], shape, 3 * sizes.contact);
  return shape;
}

void Model::apply_corrugation(double centre) {
  if (!scene.corrugation) return;
  const Corrugation shape = corrugate(centre);
  if (scene.corrugation->apply == "nodes") build_operators();
  contact->set_corrugation(shape);
}

std::vector<std::int64_t> Model::loaded_slots() const {
  std::vector<std::int64_t> slots = connected_slots();
  if (!ties) return slots;
  for (const std::vector<std::int64_t>* tied : {&ties->secondary_slots(), &ties->primary_slots()})
    slots.insert(slots.end(), tied->begin(), tied->end());
  return slots;
}

std::vector<std::int64_t> Model::connected_slots() const {
  std::vector<std::int64_t> slots;
  const auto add = [&](const auto& more) { slots.insert(slots.end(), more.begin(), more.end()); };
  if (fastenings) add(fastenings->slots());
  if (hammer) hammer->add_slots(slots);
  add(journal.slots());
  add(torque.slots());
  return slots;
}

}  // namespace tread
