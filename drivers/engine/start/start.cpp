#include "drivers/engine/start/start.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/engine/start/traction.hpp"
#include "kernels/contact/contact_surface.hpp"
#include "kernels/update/turn.hpp"

namespace tread {

namespace {

/// The rail, whose sections move as a run-in's displacement or rate has them: [m] or [m/s]. Its sides are
/// free and contract as its fibres stretch. [theory.md, eq. (12c)]
class BentRail {
 public:
  /// Keeps references.
  BentRail(const Model& model, const RunIn& run_in, SectionMotion RunIn::Section::*part)
      : model_(model),
        run_in_(run_in),
        part_(part),
        poissons_ratio_(model.scene.rail_material().poissons_ratio) {
    double mass = 0;
    const auto add = [&](double m, double y, double z) {
      mass += m;
      centroid_ += Vec3{0, m * y, m * z};
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
    centroid_ = (1 / mass) * centroid_;
  }

  /// Adds the motion of all nodes to a vector field.
  void add_to(AlignedVector<double>& field) const {
    NodeField nodes(field.data());
    for (const int b : model_.index.rail()) {
      const SweptBlock& block = model_.mesh.blocks[static_cast<std::size_t>(b)];
      for (int station = 0; station < block.station_count(); ++station) {
        const BentSection section = section_at(block.stations[static_cast<std::size_t>(station)]);
        for (int node = 0; node < block.section.nodes(); ++node)
          nodes.add(block.base + block.slot(node, station),
                    motion(section, block.section.p[static_cast<std::size_t>(node)],
                           block.section.q[static_cast<std::size_t>(node)]));
      }
    }
    for_each_body_node(model_.mesh, false, [&](std::int64_t slot, const Vec3& at) {
      nodes.add(slot, motion(section_at(at.x), at.y, at.z));
    });
    for (const std::int64_t unknown : model_.restrained) field[static_cast<std::size_t>(unknown)] = 0;
    if (model_.ties) model_.ties->follow({field.data()});
  }

  /// Vertical motion of the crown's middle at x [m].
  double rise_of_crown(double x) const {
    const SurfaceProfile crown(model_.mesh.blocks[static_cast<std::size_t>(model_.index.rail_cap)].section);
    return motion(section_at(x), 0, crown.q_at(0)).z;
  }

 private:
  struct BentSection {
    SectionMotion motion;
    SectionMotion slope;  ///< d/dx of the motion
  };

  BentSection section_at(double x) const {
    const auto at = [&](double place) { return run_in_.at(place).*part_; };
    return {at(x), 0.5 / run_in_.pitch * (at(x + run_in_.pitch) - at(x - run_in_.pitch))};
  }

  /// Motion of a point of the section at y, z [m].
  Vec3 motion(const BentSection& section, double y, double z) const {
    y -= centroid_.y;
    z -= centroid_.z;
    const SectionMotion& mean = section.motion;
    const double stretch = section.slope.axial, bend = section.slope.rotation;
    return {mean.axial + z * mean.rotation, -poissons_ratio_ * (stretch + bend * z) * y,
            -mean.deflection - poissons_ratio_ * (stretch * z + 0.5 * bend * (z * z - y * y))};
  }

  const Model& model_;
  const RunIn& run_in_;
  SectionMotion RunIn::Section::*part_;
  double poissons_ratio_;
  Vec3 centroid_;  ///< of the mass by length
};

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
  const BentRail rail(model, *run_in, &RunIn::Section::displacement);
  rail.add_to(fields.displacement);
  add_to_sleepers(model, *run_in, &RunIn::Sleeper::deflection, fields.displacement);
  fields.wheel.origin.z += rail.rise_of_crown(fields.wheel.origin.x);
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
    BentRail(model, *run_in, &RunIn::Section::rate).add_to(fields.velocity);
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
  if (run_in) bend_axle(model, (1 - spin_ratio) * run_in->bending_speed, fields);  // no part of the spin
}

void start_pulse(const Model& model, const PulseSpec& pulse, const StartFields& fields) {
  const double end = pulse.length - model.scene.rail->origin;
  const auto start_node = [&](std::int64_t slot, double x) {
    if (x < end) fields.velocity[static_cast<std::size_t>(dof(slot, 0))] = pulse.velocity;
  };
  for (const int b : model.index.rail()) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(b)];
    for (int station = 0; station < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes(); ++node)
        start_node(block.base + block.slot(node, station), block.stations[static_cast<std::size_t>(station)]);
  }
  for_each_body_node(model.mesh, false, [&](std::int64_t slot, const Vec3& at) { start_node(slot, at.x); });
  for (const std::int64_t unknown : model.restrained) fields.velocity[static_cast<std::size_t>(unknown)] = 0;
  if (model.ties) model.ties->follow({fields.velocity.data()});
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
