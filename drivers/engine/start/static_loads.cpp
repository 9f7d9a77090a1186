#include "drivers/engine/start/static_loads.hpp"

#include <algorithm>

#include "core/parallel/parallel.hpp"
#include "drivers/engine/start/traction.hpp"
#include "kernels/update/turn.hpp"

namespace tread {

namespace {

/// Adds the inertia force of a block under an acceleration [m/s2]; `angle`: angle of the wheel's frame [rad].
void add_acceleration(const Model& model, const SweptBlock& block, double angle, const Vec3& acceleration,
                      double* load) {
  for (int station = 0; station < block.station_count(); ++station) {
    const Vec3 local = to_local(block, station, angle, acceleration);
    for (int node = 0; node < block.section.nodes(); ++node) {
      const std::int64_t slot = block.base + block.slot(node, station);
      const double m = model.mass[static_cast<std::size_t>(slot)];
      for (int c = 0; c < 3; ++c) load[dof(slot, c)] += m * local[c];
    }
  }
}

/// The same of a body.
void add_acceleration(const Model& model, const HexBody& body, double angle, const Vec3& acceleration,
                      double* load) {
  const Vec3 local = body.spins ? Turn(kCartesianAngle + angle).to_cylindrical(acceleration) : acceleration;
  for (std::int64_t node = 0; node < body.nodes(); ++node) {
    const std::int64_t slot = body.slot(node);
    for (int c = 0; c < 3; ++c) load[dof(slot, c)] += model.mass[static_cast<std::size_t>(slot)] * local[c];
  }
}

/// Adds the centrifugal force of a spinning body; `spin` [rad/s].
void add_centrifugal(const Model& model, const HexBody& body, double spin, double* load) {
  for (std::int64_t node = 0; node < body.nodes(); ++node) {
    const std::int64_t slot = body.slot(node);
    const Vec3& at = body.mesh.nodes[static_cast<std::size_t>(node)];
    const double scale = model.mass[static_cast<std::size_t>(slot)] * spin * spin;
    load[dof(slot, 0)] += scale * at.x;
    load[dof(slot, 2)] += scale * at.z;
  }
}

/// Adds the centrifugal force of a revolved block; `spin` [rad/s].
void add_centrifugal(const Model& model, const SweptBlock& block, double spin, double* load) {
  for (int station = 0; station < block.station_count(); ++station)
    for (int node = 0; node < block.section.nodes(); ++node) {
      const std::int64_t slot = block.base + block.slot(node, station);
      load[dof(slot, 2)] += model.mass[static_cast<std::size_t>(slot)] * spin * spin *
                            block.section.q[static_cast<std::size_t>(node)];
    }
}

/// Adds -m rate^2 d2u/ds2, s the station coordinate.
void add_inertia_of_blocks(const Model& model, double speed, double spin, const double* u, double* load) {
  for (const SweptBlock& block : model.mesh.blocks) {
    const double rate = block.sweep == Sweep::revolved ? spin : speed;
    if (rate == 0) continue;
    parallel_ranges(block.station_count(), [&](std::int64_t first, std::int64_t last) {
      for (int station = static_cast<int>(first); station < last; ++station) {
        if (!block.closed && (station == 0 || station == block.station_count() - 1)) continue;
        const LineCell cell = station_cell(block, station);
        const double scale = -2 * rate * rate / (cell.length_before + cell.length);
        for (int node = 0; node < block.section.nodes(); ++node) {
          // Values in the basis of the middle station.
          const auto value = [&](int at, double turned) {
            const std::int64_t slot = block.base + block.slot(node, at);
            const Vec3 v{u[dof(slot, 0)], u[dof(slot, 1)], u[dof(slot, 2)]};
            return block.sweep == Sweep::revolved ? turn(v, turned) : v;
          };
          const Vec3 here = value(station, 0);
          const Vec3 second = (1 / cell.length) * (value(cell.second, cell.length) - here) -
                              (1 / cell.length_before) * (here - value(cell.before, -cell.length_before));
          const std::int64_t slot = block.base + block.slot(node, station);
          const double m = model.mass[static_cast<std::size_t>(slot)];
          for (int c = 0; c < 3; ++c) load[dof(slot, c)] += m * scale * second[c];
        }
      }
    });
  }
}

/// The same of bodies, by the change along the motion twice.
void add_inertia_of_bodies(const Model& model, double speed, double spin, const double* u, double* load) {
  for (const HexBody& body : model.mesh.bodies) {
    const double rate = body.spins ? spin : speed;
    if (rate == 0) continue;
    AlignedVector<double> change(static_cast<std::size_t>(3 * model.mesh.slots), 0.0);
    const auto differentiate = [&](const double* field) {
      const std::vector<Vec3> along = along_motion(body, field);
      for (std::int64_t node = 0; node < body.nodes(); ++node)
        NodeField(change.data()).set(body.slot(node), along[static_cast<std::size_t>(node)]);
    };
    differentiate(u);
    differentiate(change.data());
    for (std::int64_t node = 0; node < body.nodes(); ++node) {
      const std::int64_t slot = body.slot(node);
      const double scale = -model.mass[static_cast<std::size_t>(slot)] * rate * rate;
      NodeField(load).add(slot, scale * ConstNodeField(change.data()).at(slot));
    }
  }
}

}  // namespace

void add_external_load(const Model& model, const BodyFrame& frame, double spin, double* load) {
  for (const SweptBlock& block : model.mesh.blocks) {
    add_acceleration(model, block, 0, {0, 0, -model.scene.gravity}, load);
    if (block.sweep == Sweep::revolved) add_centrifugal(model, block, spin, load);
  }
  for (const HexBody& body : model.mesh.bodies) {
    add_acceleration(model, body, 0, {0, 0, -model.scene.gravity}, load);
    if (body.spins) add_centrifugal(model, body, spin, load);
  }
  if (!model.journal.empty()) model.journal.add(load, frame, {0, 0, -model.journal_load()});
}

void add_carrier_load(const Model& model, const BodyFrame& frame, double spin, double* load) {
  if (!model.guide) return;
  load[model.guide->unknown()] +=
      (model.guide->counterweight(spin, frame.angle) - model.journal_load()) / model.guide->per_rise();
}

void add_steady_inertia(const Model& model, double speed, double spin, const double* u, double* load) {
  add_inertia_of_blocks(model, speed, spin, u, load);
  add_inertia_of_bodies(model, speed, spin, u, load);
}

void add_run_in(const Model& model, const RunIn& run_in, const BodyFrame& frame, double* load) {
  model.journal.add(load, frame, {0, 0, -run_in.journal_force});
  const double per_mass = run_in.inertia_force / model.wheelset->mass();
  for (const int b : model.wheelset->blocks())
    add_acceleration(model, model.mesh.blocks[static_cast<std::size_t>(b)], frame.angle, {0, 0, -per_mass},
                     load);
  for (const HexBody& body : model.mesh.bodies)
    if (body.spins) add_acceleration(model, body, frame.angle, {0, 0, -per_mass}, load);
}

void add_traction(const Model& model, double traction, const BodyFrame& frame, double* load) {
  model.torque.add(load, full_torque(model));
  if (!model.scene.vehicle || model.journal.empty()) return;
  const double vehicle = model.scene.vehicle->mass_along();
  const double share = vehicle / (vehicle + model.wheelset->mass());
  model.journal.add(load, frame, {-share * traction * model.wheel_load(), 0, 0});
}

}  // namespace tread
