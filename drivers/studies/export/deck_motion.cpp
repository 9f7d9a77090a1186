#include "drivers/studies/export/deck_motion.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <vector>

#include "drivers/engine/start/traction.hpp"
#include "drivers/studies/export/deck_start.hpp"
#include "drivers/studies/export/deck_surfaces.hpp"
#include "drivers/studies/export/deck_units.hpp"
#include "drivers/studies/export/deck_vehicle.hpp"

namespace tread {

namespace {

/// Directions by node of the mesh, as DeckModel::held.
std::map<std::int64_t, int> held_directions(const DeckModel& deck) {
  std::map<std::int64_t, int> directions;
  for (const std::int64_t unknown : deck.model().restrained) {
    directions[deck.node(slot_of(unknown))] |= 1 << component_of(unknown);
  }
  return directions;
}

/// A force on a node along an axis of coordinates, which are 0 for those of the deck.
struct NodeForce {
  std::int64_t node = 0;
  std::int64_t curve = 0;
  double share = 0;  ///< of the curve [kN per its unit]
  std::int64_t coordinates = 0;
  int axis = 2;
};

/// A keyword for each: readers may take the first card alone.
void write_force(const NodeForce& force, KeywordDeck& out) {
  out.keyword("*LOAD_NODE_POINT");
  out.card({force.node, force.axis + 1, force.curve, force.share, force.coordinates});
}

/// Coordinates that turn with three nodes and whose third axis is normal to their plane. Follower forces
/// (direction 4) would do, but OpenRadioss gives them numbers that it also gives to a wheel's velocity.
class TurningCoordinates {
 public:
  TurningCoordinates(DeckModel& deck, KeywordDeck& out) : deck_(deck), out_(out) {}

  /// Number of the plane's coordinates, written when first asked for.
  std::int64_t of(const std::array<std::int64_t, 3>& plane) {
    const auto [known, added] = numbers_.try_emplace(plane, 0);
    if (!added) return known->second;
    known->second = ++deck_.numbers.coordinates;
    constexpr int kMoving = 1;
    out_.keyword("*DEFINE_COORDINATE_NODES");
    out_.names({"cid", "n1", "n2", "n3", "flag"});
    out_.card({known->second, plane[0], plane[1], plane[2], kMoving});
    return known->second;
  }

 private:
  DeckModel& deck_;
  KeywordDeck& out_;
  std::map<std::array<std::int64_t, 3>, std::int64_t> numbers_;
};

/// Writes a curve of (time [s], value in the deck's units) and returns its number.
std::int64_t write_curve(DeckModel& deck, const std::vector<std::array<double, 2>>& points,
                         KeywordDeck& out) {
  const std::int64_t curve = ++deck.numbers.curve;
  out.keyword("*DEFINE_CURVE");
  out.names({"lcid"});
  out.card({curve});
  out.names(kCurveCard, {"time", "value"});
  for (const auto& [time, value] : points) out.card(kCurveCard, {deck_unit::kTime * time, value});
  return curve;
}

/// Share of gravity and static loads.
std::int64_t write_static_curve(DeckModel& deck, KeywordDeck& out) {
  const double ramp = deck.options().ramp;
  const double end = 2 * (deck.duration() + ramp);
  out.remark("Share of gravity and static loads.");
  if (ramp <= 0) return write_curve(deck, {{0, 1}, {end, 1}}, out);
  return write_curve(deck, {{0, 0}, {ramp, 1}, {end, 1}}, out);
}

/// Values of a function of time over the deck's duration, and at the ends of its ramps.
std::vector<std::array<double, 2>> sampled(double duration, double ramp, int ramps,
                                           const std::function<double(double)>& value) {
  if (ramp <= 0) return {{0, value(0)}, {2 * duration, value(0)}};
  constexpr int kPoints = 20;  // in each ramp
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i <= kPoints * ramps; ++i) {
    const double time = ramp * i / kPoints;
    points.push_back({time, value(time)});
  }
  const double end = std::max(2 * duration, 1.5 * points.back()[0]);
  points.push_back({end, points.back()[1]});
  return points;
}

void write_gravity(DeckModel& deck, std::int64_t curve, KeywordDeck& out) {
  if (deck.scene().gravity == 0) return;
  out.remark("A positive value accelerates all masses downwards.");
  out.keyword("*LOAD_BODY_Z");
  out.names({"lcid", "sf"});
  out.card({curve, deck_unit::kAcceleration * deck.scene().gravity});
}

/// The weight of a sprung mass stands in its spring from the start: its share on the journal, and a force
/// that carries the mass. In a preloaded deck the spokes of the axle box begin with that of the box.
void write_journal_load(DeckModel& deck, std::int64_t curve, KeywordDeck& out) {
  const Model& model = deck.model();
  if (model.journal.empty()) return;
  double load = model.journal_load();
  double sprung = 0, unsprung = 0;  // upwards, on these masses
  if (const auto& vehicle = deck.scene().vehicle) {
    sprung = vehicle->sprung_mass * deck.scene().gravity +
             vehicle->suspension_stiffness * deck.sprung_start().drop;
    unsprung = deck.preloaded() ? vehicle->unsprung_mass * deck.scene().gravity : 0;
    load = sprung + unsprung;
  }
  if (load == 0) return;
  out.remark("Static load on the journal. The weight of a sprung mass is in its spring from the start.");
  for (const auto& [node, share] : journal_shares(deck))
    write_force({node, curve, -deck_unit::kForce * load * share}, out);
  if (deck.sprung > 0) write_force({deck.sprung, curve, deck_unit::kForce * sprung}, out);
  if (unsprung > 0) write_force({deck.unsprung, curve, deck_unit::kForce * unsprung}, out);
}

/// Those of fastenings and bed at t = 0: the springs of the deck begin without a force.
void write_spring_forces(DeckModel& deck, std::int64_t curve, KeywordDeck& out) {
  if (!deck.preloaded()) return;
  out.remark("Forces of the fastenings at t = 0.");
  for (const auto& [node, force] : deck.spring_forces)
    for (int axis = 0; axis < 3; ++axis)
      if (force[axis] != 0) write_force({node, curve, deck_unit::kForce * force[axis], 0, axis}, out);
}

/// Three nodes of the section at a node's station whose plane has the tangent as its normal, by node of the
/// section.
std::vector<std::array<int, 3>> planes_across(const Section& section) {
  std::vector<std::array<int, 3>> planes(static_cast<std::size_t>(section.nodes()));
  for (const std::array<int, 4>& quad : section.quads)
    for (const int node : quad) planes[static_cast<std::size_t>(node)] = {quad[0], quad[1], quad[2]};
  return planes;
}

/// Three nodes of the wheel's innermost part that turn with it.
std::array<std::int64_t, 3> turning_plane(const DeckModel& deck) {
  const BlockIndex& index = deck.model().index;
  const int part = index.axle >= 0 ? index.axle : index.tread;
  const SweptBlock& block = deck.model().mesh.blocks[static_cast<std::size_t>(part)];
  const auto node = [&](int third) { return deck.node(block, 0, block.station_count() * third / 3); };
  return {node(0), node(1), node(2)};
}

/// Axes of the coordinates of three nodes at t = 0.
std::array<Vec3, 3> axes_of(const DeckModel& deck, const std::array<std::int64_t, 3>& plane) {
  const auto unit = [](const Vec3& v) { return (1 / norm(v)) * v; };
  const Vec3 origin = deck.place(plane[0]);
  const Vec3 first = unit(deck.place(plane[1]) - origin);
  const Vec3 third = unit(cross(first, deck.place(plane[2]) - origin));
  return {first, cross(third, first), third};
}

/// See hourglass_forces().
void write_hourglass_forces(DeckModel& deck, std::int64_t curve, KeywordDeck& out) {
  if (!deck.preloaded()) return;
  out.remark("Forces in place of those of the hourglass stiffness at t = 0.");
  std::int64_t turning = 0;
  std::array<Vec3, 3> axes;  // of the wheel
  if (deck.model().index.tread >= 0) {
    const std::array<std::int64_t, 3> plane = turning_plane(deck);
    turning = TurningCoordinates(deck, out).of(plane);
    axes = axes_of(deck, plane);
  }
  for (const auto& [node, force] : hourglass_forces(deck)) {
    const VtkGrid::Point& point = deck.grid().points[static_cast<std::size_t>(node - 1)];
    const bool turns =
        deck.model().mesh.blocks[static_cast<std::size_t>(point.block)].sweep == Sweep::revolved;
    NodeForce load{node, curve};
    if (turns) load.coordinates = turning;
    for (load.axis = 0; load.axis < 3; ++load.axis) {
      const double along = turns ? dot(force, axes[static_cast<std::size_t>(load.axis)]) : force[load.axis];
      load.share = deck_unit::kForce * along;
      if (load.share != 0) write_force(load, out);
    }
  }
}

/// Tangential forces that turn with the wheel.
void write_torque(DeckModel& deck, KeywordDeck& out) {
  const Model& model = deck.model();
  const double full = full_torque(model);
  if (full == 0) return;
  const MotionSpec& motion = *deck.scene().motion;
  out.remark("Torque on the axle over its full value, and forces that turn with the wheel.");
  const std::int64_t curve = write_curve(deck,
                                         sampled(deck.duration(), motion.ramp, 1 + 2 * motion.reversals,
                                                 [&](double time) { return motion.torque_share(time); }),
                                         out);
  // The torque itself spreads one of 1 N m; external forces are subtracted.
  const AlignedVector<double> rest(static_cast<std::size_t>(3 * model.mesh.slots), 0.0);
  AlignedVector<double> force = rest;
  model.torque.apply(1, rest.data(), rest.data(), deck.wheel(), force.data());
  std::map<int, std::vector<std::array<int, 3>>> planes;  // by block
  TurningCoordinates coordinates(deck, out);
  for (const VtkGrid::Point& point : deck.grid().points) {
    const double along = -ConstNodeField(force.data()).at(deck.slot(point)).x;
    if (along == 0) continue;
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(point.block)];
    const auto [at, added] = planes.try_emplace(point.block);
    if (added) at->second = planes_across(block.section);
    const std::array<int, 3>& plane = at->second[static_cast<std::size_t>(point.node)];
    const auto corner = [&](std::size_t i) { return deck.node(block, plane[i], point.station); };
    write_force({deck.node(deck.slot(point)), curve, deck_unit::kForce * full * along,
                 coordinates.of({corner(0), corner(1), corner(2)})},
                out);
  }
}

void write_hammer(DeckModel& deck, KeywordDeck& out) {
  if (!deck.model().hammer) return;
  const HammerSpec& hammer = *deck.scene().hammer;
  out.remark("Blow on the rail head.");
  const std::int64_t curve = write_curve(
      deck, sampled(deck.duration(), hammer.duration, 1, [&](double time) { return hammer.force_at(time); }),
      out);
  deck.for_each_node_of(*deck.model().hammer, [&](std::int64_t node, double weight) {
    write_force({node, curve, -deck_unit::kForce * weight}, out);
  });
}

}  // namespace

void write_restraints(DeckModel& deck, KeywordDeck& out) {
  std::map<int, std::vector<std::int64_t>> all = deck.held;
  for (const auto& [node, directions] : held_directions(deck)) all[directions].push_back(node);
  for (const auto& [directions, nodes] : all) {
    const std::int64_t set = write_node_set(deck, nodes, out);
    out.keyword("*BOUNDARY_SPC_SET");
    out.names({"nsid", "cid", "dofx", "dofy", "dofz"});
    out.card({set, 0, directions & 1, directions >> 1 & 1, directions >> 2 & 1});
  }
}

void write_loads(DeckModel& deck, KeywordDeck& out) {
  const std::int64_t curve = write_static_curve(deck, out);
  write_gravity(deck, curve, out);
  write_journal_load(deck, curve, out);
  write_spring_forces(deck, curve, out);
  write_hourglass_forces(deck, curve, out);
  write_torque(deck, out);
  write_hammer(deck, out);
}

namespace {

/// Nodes that move rigidly together at t = 0.
struct MovingNodes {
  BodyFrame frame;  ///< its origin, velocity and spin
  std::vector<std::int64_t> nodes;
};

void write_moving(DeckModel& deck, const MovingNodes& group, KeywordDeck& out) {
  constexpr int kNodeSet = 3;
  const std::int64_t set = write_node_set(deck, group.nodes, out);
  const Vec3 velocity = group.frame.velocity;
  const Vec3 centre = deck_unit::kLength * group.frame.origin;
  const double spin = group.frame.spin / deck_unit::kTime;
  out.keyword("*INITIAL_VELOCITY_GENERATION");
  out.names({"nsid", "styp", "omega", "vx", "vy", "vz"});
  out.card({set, kNodeSet, spin, velocity.x, velocity.y, velocity.z});
  out.names({"xc", "yc", "zc", "nx", "ny", "nz"});
  out.card({centre.x, centre.y, centre.z, 0.0, spin == 0 ? 0.0 : 1.0, 0.0});
}

}  // namespace

void write_velocities(DeckModel& deck, KeywordDeck& out) {
  out.remark("Velocities at t = 0. A set for each motion: readers may make an entity of each card.");
  MovingNodes wheel{deck.wheel(), {}};
  std::map<std::array<double, 3>, MovingNodes> others;  // by velocity
  const auto add = [&](std::int64_t node, const Vec3& velocity) {
    if (norm(velocity) == 0) return;
    MovingNodes& group = others[{velocity.x, velocity.y, velocity.z}];
    group.frame.velocity = velocity;
    group.nodes.push_back(node);
  };
  for (const VtkGrid::Point& point : deck.grid().points) {
    const std::int64_t node = deck.node(deck.slot(point));
    if (deck.rolls(point))
      wheel.nodes.push_back(node);
    else
      add(node, deck.velocity(point));
  }
  for (const auto& [node, velocity] : deck.moving) add(node, velocity);
  if (!wheel.nodes.empty()) write_moving(deck, wheel, out);
  for (const auto& [velocity, group] : others) write_moving(deck, group, out);
}

}  // namespace tread
