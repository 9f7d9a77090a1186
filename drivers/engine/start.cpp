#include "drivers/engine/start.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/engine/traction.hpp"
#include "kernels/update/turn.hpp"

namespace tread {

namespace {

/// Adds the motions of the rail's sections, `motion(x)`, to a field: [m] or [m/s].
template <class MotionAt>
void add_to_rail(const Model& model, const MotionAt& motion, AlignedVector<double>& field) {
  // Rotation is about the rail's centroid.
  double mass = 0;
  double moment = 0;
  for (const int b : model.index.rail()) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(b)];
    for (int node = 0; node < block.section.nodes(); ++node) {
      const double m =
          model.mass[static_cast<std::size_t>(block.base + block.slot(node, 1))] / block.pitch(1);
      mass += m;
      moment += m * block.section.q[static_cast<std::size_t>(node)];
    }
  }
  const double length = model.scene.rail->length;
  for_each_body_node(model.mesh, false, [&](std::int64_t slot, const Vec3& at) {
    const double m = model.mass[static_cast<std::size_t>(slot)] / length;
    mass += m;
    moment += m * at.z;
  });
  const double centroid = moment / mass;
  for (const int b : model.index.rail()) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(b)];
    for (int station = 0; station < block.station_count(); ++station) {
      const SectionMotion section = motion(block.stations[static_cast<std::size_t>(station)]);
      for (int node = 0; node < block.section.nodes(); ++node) {
        const std::int64_t slot = block.base + block.slot(node, station);
        const double above = block.section.q[static_cast<std::size_t>(node)] - centroid;
        field[static_cast<std::size_t>(dof(slot, 0))] += section.axial + above * section.rotation;
        field[static_cast<std::size_t>(dof(slot, 2))] -= section.deflection;
      }
    }
  }
  for_each_body_node(model.mesh, false, [&](std::int64_t slot, const Vec3& at) {
    const SectionMotion section = motion(at.x);
    NodeField(field.data())
        .add(slot, {section.axial + (at.z - centroid) * section.rotation, 0, -section.deflection});
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

void place_run_in(const Model& model, const std::optional<RunIn>& run_in, const StartFields& fields) {
  if (!run_in) return;
  add_to_rail(
      model, [&](double x) { return run_in->at(x).displacement; }, fields.displacement);
  add_to_sleepers(model, *run_in, &RunIn::Sleeper::deflection, fields.displacement);
  fields.wheel.origin.z -= run_in->at(fields.wheel.origin.x).displacement.deflection;
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
    add_to_rail(
        model, [&](double x) { return run_in->at(x).rate; }, fields.velocity);
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
