#include "drivers/engine/start/moving_deflection.hpp"

#include <cstddef>

namespace tread {

namespace {

/// Derivative of a nodal value along the sweep, by the parabola through three stations.
double along_sweep(const SweptBlock& block, int node, int station, int component,
                   const AlignedVector<double>& field) {
  const auto value = [&](int s) {
    return field[static_cast<std::size_t>(dof(block.base + block.slot(node, s), component))];
  };
  const int last = block.station_count() - 1;
  if (!block.closed && (station == 0 || station == last)) {
    const int s = station == 0 ? 0 : last - 1;
    return (value(s + 1) - value(s)) / block.pitch(s);
  }
  const LineCell cell = station_cell(block, station);
  const double h0 = cell.length_before;
  const double h1 = cell.length;
  const double ahead = (value(cell.second) - value(station)) / h1;
  const double behind = (value(station) - value(cell.before)) / h0;
  return (ahead * h0 + behind * h1) / (h0 + h1);
}

}  // namespace

void move_deflection(const Model& model, double speed, const StartFields& fields) {
  // A deflection that stays under the wheel while the material passes: du/dt = spin du/dphi in the wheel, -v
  // du/dx in the track.
  for (const SweptBlock& block : model.mesh.blocks) {
    const double rate = block.sweep == Sweep::revolved ? fields.wheel.spin : -speed;
    for (int station = 0; station < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes(); ++node)
        for (int c = 0; c < 3; ++c)
          fields.velocity[static_cast<std::size_t>(dof(block.base + block.slot(node, station), c))] =
              rate * along_sweep(block, node, station, c, fields.displacement);
  }
  for (const HexBody& body : model.mesh.bodies) {
    const double rate = body.spins ? fields.wheel.spin : -speed;
    const std::vector<Vec3> change = along_motion(body, fields.displacement.data());
    for (std::int64_t node = 0; node < body.nodes(); ++node) {
      Vec3 per_way = change[static_cast<std::size_t>(node)];
      if (body.spins)  // the axes turn under what stands still
        per_way += -1 * cross({0, 1, 0}, ConstNodeField(fields.displacement.data()).at(body.slot(node)));
      NodeField(fields.velocity.data()).set(body.slot(node), rate * per_way);
    }
  }
  for (const std::int64_t unknown : model.restrained) fields.velocity[static_cast<std::size_t>(unknown)] = 0;
  if (model.ties) model.ties->follow({fields.velocity.data()});
}

double free_spin(const Model& model, const StartFields& fields) {
  const ContactState state{fields.displacement.data(), fields.velocity.data(), &fields.wheel};
  return model.contact->mean_slip_velocity(state).x / model.wheel_radius();
}

double free_spin(const Model& model, const AlignedVector<double>& displacement, BodyFrame wheel,
                 double speed) {
  AlignedVector<double> u = displacement;
  AlignedVector<double> v(u.size(), 0.0);
  wheel.velocity = {speed, 0, 0};
  wheel.spin = speed / model.wheel_radius();
  move_deflection(model, speed, {u, v, wheel});
  return free_spin(model, {u, v, wheel});
}

}  // namespace tread
