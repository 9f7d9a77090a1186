#include "drivers/engine/start.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/engine/traction.hpp"
#include "kernels/contact/contact_surface.hpp"
#include "kernels/update/turn.hpp"

namespace tread {

namespace {

/// A section of a beam and how it changes along the rail.
struct BentSection {
  SectionMotion motion;
  SectionMotion slope;  ///< d/dx of the motion [1/m of it]
};

BentSection bent_section(const RunIn& run_in, SectionMotion RunIn::Section::*part, double x) {
  const auto at = [&](double place) { return run_in.at(place).*part; };
  return {at(x), 0.5 / run_in.pitch * (at(x + run_in.pitch) - at(x - run_in.pitch))};
}

/// Motion of a point at y, z from the section's centroid: the sides of a bent rail are free, and contract as
/// its fibres stretch. [theory.md, eq. (12c)]
Vec3 motion_in(const BentSection& bent, double poissons_ratio, double y, double z) {
  const SectionMotion& section = bent.motion;
  const double stretch = bent.slope.axial, bend = bent.slope.rotation;
  return {section.axial + z * section.rotation, -poissons_ratio * (stretch + bend * z) * y,
          -section.deflection - poissons_ratio * (stretch * z + 0.5 * bend * (z * z - y * y))};
}

/// Centroid of the rail's section: of its mass by length [m].
Vec3 rail_centroid(const Model& model) {
  double mass = 0;
  Vec3 moment;
  const auto add = [&](double m, double y, double z) {
    mass += m;
    moment += Vec3{0, m * y, m * z};
  };
  for (const int b : model.index.rail()) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(b)];
    for (int node = 0; node < block.section.nodes(); ++node)
      add(model.mass[static_cast<std::size_t>(block.base + block.slot(node, 1))] / block.pitch(1),
          block.section.p[static_cast<std::size_t>(node)], block.section.q[static_cast<std::size_t>(node)]);
  }
  const double length = model.scene.rail->length;
  for_each_body_node(model.mesh, false, [&](std::int64_t slot, const Vec3& at) {
    add(model.mass[static_cast<std::size_t>(slot)] / length, at.y, at.z);
  });
  return (1 / mass) * moment;
}

/// Adds the run-in's `part` of the rail to a field: [m] or [m/s].
void add_to_rail(const Model& model, const RunIn& run_in, SectionMotion RunIn::Section::*part,
                 AlignedVector<double>& field) {
  const Vec3 centroid = rail_centroid(model);
  const double nu = model.scene.rail_material().poissons_ratio;
  NodeField nodes(field.data());
  for (const int b : model.index.rail()) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(b)];
    for (int station = 0; station < block.station_count(); ++station) {
      const BentSection bent = bent_section(run_in, part, block.stations[static_cast<std::size_t>(station)]);
      for (int node = 0; node < block.section.nodes(); ++node)
        nodes.add(block.base + block.slot(node, station),
                  motion_in(bent, nu, block.section.p[static_cast<std::size_t>(node)] - centroid.y,
                            block.section.q[static_cast<std::size_t>(node)] - centroid.z));
    }
  }
  for_each_body_node(model.mesh, false, [&](std::int64_t slot, const Vec3& at) {
    nodes.add(slot, motion_in(bent_section(run_in, part, at.x), nu, at.y - centroid.y, at.z - centroid.z));
  });
  for (const std::int64_t unknown : model.restrained) field[static_cast<std::size_t>(unknown)] = 0;
  if (model.ties) model.ties->follow({field.data()});
}

/// Adds to the sleepers' vertical motion what `value` has of each, downwards: [m] or [m/s].
void add_to_sleepers(const Model& model, const RunIn& run_in, double RunIn::Sleeper::*value,
                     AlignedVector<double>& field) {
  for (std::size_t i = 0; i < run_in.sleepers.size(); ++i) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(model.index.sleepers[i])];
    for (int station = 0; station < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes(); ++node)
        field[static_cast<std::size_t>(dof(block.base + block.slot(node, station), 2))] -=
            run_in.sleepers[i].*value;
  }
}

/// The wheelset bends on in the shape that it has, beyond its rim's displacement; `rate` [1/s].
void bend_axle(const Model& model, double rate, const StartFields& fields) {
  const Vec3 rim = rim_displacement(model, fields.displacement.data(), fields.wheel);
  for (const int b : model.index.wheel()) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(b)];
    for (int station = 0; station < block.station_count(); ++station) {
      const Vec3 carried = to_local(block, station, fields.wheel.angle, rim);
      for (int node = 0; node < block.section.nodes(); ++node)
        for (int c = 0; c < 3; ++c) {
          const auto i = static_cast<std::size_t>(dof(block.base + block.slot(node, station), c));
          fields.velocity[i] += rate * (fields.displacement[i] - carried[c]);
        }
    }
  }
  const Vec3 carried = Turn(kCartesianAngle + fields.wheel.angle).to_cylindrical(rim);
  for_each_body_node(model.mesh, true, [&](std::int64_t slot, const Vec3& /*at*/) {
    const Vec3 beyond = ConstNodeField(fields.displacement.data()).at(slot) - carried;
    NodeField(fields.velocity.data()).add(slot, rate * beyond);
  });
  for (const std::int64_t unknown : model.restrained) fields.velocity[static_cast<std::size_t>(unknown)] = 0;
  if (model.ties) model.ties->follow({fields.velocity.data()});
}

/// Gives the wheel the spin at which the patch as a whole does not slip, found before traction acts.
void roll_freely(const Model& model, const Preload& preload, const StartFields& fields) {
  if (!model.contact) return;
  fields.wheel.spin += preload.traction != 0 ? preload.free_spin : free_spin(model, fields);
}

}  // namespace

namespace {

/// Rise of the crown's middle by the run-in at x [m].
double crown_rise(const Model& model, const RunIn& run_in, double x) {
  const SurfaceProfile crown(model.mesh.blocks[static_cast<std::size_t>(model.index.rail_cap)].section);
  const Vec3 centroid = rail_centroid(model);
  return motion_in(bent_section(run_in, &RunIn::Section::displacement, x),
                   model.scene.rail_material().poissons_ratio, -centroid.y, crown.q_at(0) - centroid.z)
      .z;
}

}  // namespace

void place_run_in(const Model& model, const std::optional<RunIn>& run_in, const StartFields& fields) {
  if (!run_in) return;
  add_to_rail(model, *run_in, &RunIn::Section::displacement, fields.displacement);
  add_to_sleepers(model, *run_in, &RunIn::Sleeper::deflection, fields.displacement);
  fields.wheel.origin.z += crown_rise(model, *run_in, fields.wheel.origin.x);
}

namespace {

void start_wheel(const Model& model, const Preload& preload, const StartFields& fields) {
  const std::optional<RunIn>& run_in = preload.run_in;
  const MotionSpec* motion = model.scene.motion ? &*model.scene.motion : nullptr;
  const double speed = motion ? motion->speed : 0.0;
  fields.wheel.velocity = {speed, 0, run_in ? -run_in->wheel_speed : 0.0};
  fields.wheel.spin = speed / model.wheel_radius();
  const bool deflected = model.scene.start() != "rigid";
  if (deflected) move_deflection(model, speed, fields);
  if (run_in) {
    add_to_rail(model, *run_in, &RunIn::Section::rate, fields.velocity);
    add_to_sleepers(model, *run_in, &RunIn::Sleeper::speed, fields.velocity);
  }
  if (run_in) bend_axle(model, run_in->bending_speed, fields);
  if (deflected) roll_freely(model, preload, fields);
  const double creepage = start_creepage(model, preload.traction);
  if (creepage == 0) return;
  const double spin_ratio = MotionSpec::spin_ratio(creepage);
  fields.wheel.spin *= spin_ratio;
  for (const int b : model.index.wheel()) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(b)];
    for (std::int64_t i = 3 * block.base; i < 3 * (block.base + block.slots()); ++i)
      fields.velocity[static_cast<std::size_t>(i)] *= spin_ratio;
  }
  for (const HexBody& body : model.mesh.bodies)
    for (std::int64_t i = 3 * body.base; body.spins && i < 3 * (body.base + body.slots()); ++i)
      fields.velocity[static_cast<std::size_t>(i)] *= spin_ratio;
  if (run_in) bend_axle(model, (1 - spin_ratio) * run_in->bending_speed, fields);  // does not spin
}

void start_pulse(const Model& model, const PulseSpec& pulse, const StartFields& fields) {
  for (const SweptBlock& block : model.mesh.blocks)
    for (int station = 0; station < block.station_count(); ++station) {
      if (block.stations[static_cast<std::size_t>(station)] >= block.stations.front() + pulse.length)
        continue;
      for (int node = 0; node < block.section.nodes(); ++node)
        fields.velocity[static_cast<std::size_t>(dof(block.base + block.slot(node, station), 0))] =
            pulse.velocity;
    }
}

}  // namespace

void start_velocities(const Model& model, const Preload& preload, const StartFields& fields) {
  if (model.wheelset) start_wheel(model, preload, fields);
  if (model.scene.pulse) start_pulse(model, *model.scene.pulse, fields);
}

SprungStart sprung_start(const std::optional<RunIn>& run_in) {
  return run_in ? SprungStart{run_in->stretch, -run_in->sprung_speed} : SprungStart{};
}

}  // namespace tread
