#include "drivers/engine/start/run_in.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "drivers/engine/start/rail_beam.hpp"
#include "kernels/update/turn.hpp"

namespace tread {

namespace {

/// Visits slot and Cartesian displacement of every node of a revolved block.
template <class Visit>
void visit_nodes(const SweptBlock& block, ConstNodeField u, const BodyFrame& wheel, const Visit& visit) {
  for (int station = 0; station < block.station_count(); ++station)
    for (int node = 0; node < block.section.nodes(); ++node) {
      const std::int64_t slot = block.base + block.slot(node, station);
      visit(slot, to_cartesian(block, station, wheel.angle, u.at(slot)));
    }
}

}  // namespace

Vec3 rim_displacement(const Model& model, ConstNodeField displacement, const BodyFrame& wheel) {
  Vec3 sum;
  double mass = 0;
  visit_nodes(model.mesh.blocks[static_cast<std::size_t>(model.index.tread)], displacement, wheel,
              [&](std::int64_t slot, const Vec3& u) {
                const double m = model.mass[static_cast<std::size_t>(slot)];
                sum += m * u;
                mass += m;
              });
  return (1 / mass) * sum;
}

AxleBending axle_bending(const Model& model, ConstNodeField displacement, const BodyFrame& wheel) {
  constexpr double kHardly = 0.1;  // of the Hertz approach
  AxleBending axle;
  const Vec3 rim = rim_displacement(model, displacement, wheel);
  const double journal = rim.z - model.journal.displacement(displacement, wheel).z;
  if (journal < kHardly * model.hertz_patch.approach) return axle;
  double mass = 0;
  const auto add = [&](std::int64_t slot, const Vec3& u) {
    const double m = model.mass[static_cast<std::size_t>(slot)];
    const Vec3 shape = (1 / journal) * (rim - u);
    axle.wheelset_share += m * shape.z;
    mass += m * dot(shape, shape);
  };
  for (const int b : model.index.wheel())
    visit_nodes(model.mesh.blocks[static_cast<std::size_t>(b)], displacement, wheel, add);
  const Turn turn(kCartesianAngle + wheel.angle);
  for_each_body_node(model.mesh, true, [&](std::int64_t slot, const Vec3& /*at*/) {
    add(slot, turn.to_cartesian(displacement.at(slot)));
  });
  const double added = model.scene.vehicle ? model.scene.vehicle->unsprung_mass : 0;
  axle.journal = journal;
  axle.bending.coupling = axle.wheelset_share + added;
  axle.bending.mass = mass + added;
  axle.bending.stiffness = (model.journal_load() + axle.wheelset_share * model.scene.gravity) / journal;
  return axle;
}

BeamVehicle beam_vehicle(const Model& model, const AxleBending& axle) {
  BeamVehicle vehicle;
  vehicle.gravity = model.scene.gravity;
  vehicle.unsprung_mass = model.wheelset->mass();
  if (model.scene.vehicle) {
    const VehicleSpec& spec = *model.scene.vehicle;
    vehicle.unsprung_mass += spec.unsprung_mass;
    vehicle.sprung_mass = spec.sprung_mass;
    vehicle.stiffness = spec.suspension_stiffness;
    vehicle.damping = spec.suspension_damping;
  }
  if (model.scene.load) vehicle.pressed = model.scene.load->wheel_load;
  if (!axle.rigid()) vehicle.bending = axle.bending;
  vehicle.contact = model.wheel_load() / std::pow(model.hertz_patch.approach, 1.5);
  return vehicle;
}

RunIn::Section RunIn::at(double x) const {
  const double along = std::clamp((x - left) / pitch, 0.0, static_cast<double>(sections.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(along), sections.size() - 2);
  const double share = along - static_cast<double>(i);
  const Section& a = sections[i];
  const Section& b = sections[i + 1];
  return {(1 - share) * a.displacement + share * b.displacement, (1 - share) * a.rate + share * b.rate};
}

namespace {

constexpr int kStepsOfSpan = 400;

/// Rolls over `spans` spans up to `start` [m]. The sprung mass would need seconds to follow the mean height
/// at which the track carries a moving wheel: after each span but the last it is put where the suspension
/// bears its weight in that span's mean, and its mean speed is taken from it. Returns the forces of the last
/// two spans' steps [N].
std::vector<double> roll_in(BeamPassage& passage, const BeamVehicle& vehicle, double spacing, int spans,
                            double start) {
  const double step = spacing / kStepsOfSpan;
  std::vector<double> forces;
  for (int span = spans - 1; span >= 0; --span) {
    double carried = 0;
    const double height = passage.sprung();
    const double time = passage.time();
    for (int i = kStepsOfSpan - 1; i >= 0; --i) {
      passage.step(start - span * spacing - i * step);
      carried += passage.suspension() / kStepsOfSpan;
      if (span < 2) forces.push_back(passage.force());
    }
    if (span > 0 && vehicle.stiffness > 0)
      passage.move_sprung_mass((vehicle.sprung_mass * vehicle.gravity - carried) / vehicle.stiffness,
                               -(passage.sprung() - height) / (passage.time() - time));
  }
  return forces;
}

/// Largest difference of two spans' forces [N].
double difference(std::span<const double> one, std::span<const double> other) {
  double largest = 0;
  for (std::size_t i = 0; i < one.size(); ++i) largest = std::max(largest, std::abs(one[i] - other[i]));
  return largest;
}

}  // namespace

RunningWheel running_wheel(const Scene& scene, const BeamVehicle& vehicle) {
  constexpr double kTime = 0.08;  // ten times 1 / (zeta w), about 8 ms, of the wheel on the paper's track [s]
  constexpr int kLeastSpans = 4;
  constexpr int kMostSpans = 80;
  constexpr double kSettled = 1e-3;  // of the load
  const double speed = scene.motion->speed;
  const double start = scene.start_x();
  const double spacing = scene.fastenings->spacing;
  const BeamProperties properties = timoshenko(rail_beam_section(scene), scene.rail_material());
  std::vector<double> shorter;  // forces over the last span after half of the way
  for (int spans = std::max(kLeastSpans, static_cast<int>(std::ceil(speed * kTime / spacing)));; spans *= 2) {
    auto beam = std::make_unique<TrackBeam>(rail_beam(scene, properties, spans));
    BeamPassage passage(*beam, vehicle, start - spans * spacing, spacing / kStepsOfSpan / speed);
    const double bending_at_rest = passage.bending();
    const std::vector<double> forces = roll_in(passage, vehicle, spacing, spans, start);
    const std::span all(forces);
    const std::span last = all.subspan(kStepsOfSpan);
    // Near an end of the rail no span is like the one before; a longer way then changes nothing.
    const double change = std::min(difference(last, all.first(kStepsOfSpan)),
                                   shorter.empty() ? vehicle.load() : difference(last, shorter));
    if (2 * spans > kMostSpans || change < kSettled * vehicle.load())
      return {std::move(beam), std::move(passage), bending_at_rest, change / vehicle.load()};
    shorter.assign(last.begin(), last.end());
  }
}

RunIn run_in(const Model& model, const AxleBending& axle) {
  const double speed = model.scene.motion->speed;
  const BeamVehicle vehicle = beam_vehicle(model, axle);
  const RunningWheel running = running_wheel(model.scene, vehicle);
  const TrackBeam& beam = *running.beam;
  const BeamPassage& passage = running.passage;

  RunIn out;
  out.change = running.change;
  out.force = passage.force();
  out.wheel_speed = passage.wheel_speed();
  out.stretch = passage.sprung() - passage.wheel() - passage.bending() - vehicle.static_stretch();
  out.sprung_speed = passage.sprung_speed();
  // A force at the journal and one on the mass that together give the contact force and the bending.
  const double more = out.force - vehicle.load();
  if (axle.rigid()) {
    out.inertia_force = more;
  } else {
    out.bending_speed = passage.bending_speed() / axle.journal;
    const double share = axle.wheelset_share / model.wheelset->mass();
    out.journal_force =
        (axle.bending.stiffness * (passage.bending() - running.bending_at_rest) - share * more) / (1 - share);
    out.inertia_force = more - out.journal_force;
  }
  out.left = beam.left();
  out.pitch = beam.pitch();
  const std::vector<double> rest = beam.static_state(model.scene.start_x(), out.force);
  const std::vector<double>& state = passage.beam_state();
  const std::vector<double>& rate = passage.beam_rate();
  if (model.scene.sleepers)
    for (int i = 0; i < model.scene.fastenings->count; ++i) {
      const double x = model.scene.fastening_x(i);
      out.sleepers.push_back({beam.sleeper(state, x) - beam.sleeper(rest, x), beam.sleeper(rate, x)});
    }
  const int last = beam.nodes() - 1;
  for (int i = 0; i <= last; ++i) {
    // What stays under the wheel has the rate -v d/dx.
    const int after = std::min(i + 1, last);
    const int before = std::max(i - 1, 0);
    const double over = speed / ((after - before) * out.pitch);
    out.sections.push_back(
        {beam.motion(state, i) - beam.motion(rest, i),
         beam.motion(rate, i) + over * (beam.motion(state, after) - beam.motion(state, before))});
  }
  return out;
}

}  // namespace tread
