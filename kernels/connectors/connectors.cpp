#include "kernels/connectors/connectors.hpp"

#include <cmath>

#include "core/contract.hpp"

namespace tread {

void SpringDampers::apply(ConstNodeField u, ConstNodeField v, double dt, NodeField force) {
  TREAD_EXPECT(dt >= 0);
  for (const Element& e : elements_) {
    const double rate = e.stretch(v);
    const double load = e.load(e.stretch(u), rate);
    e.upper.add(force, e.component, load);
    e.lower.add(force, e.component, -load);
    dissipated_ += e.loss(rate) * dt;
  }
}

std::vector<Spring> SpringDampers::springs() const {
  std::vector<Spring> springs;
  for (const Element& e : elements_) {
    Spring spring;
    spring.stiffness = e.stiffness;
    for (std::size_t k = 0; k < 4; ++k) {
      if (e.upper.slot[k] >= 0) {
        spring.dofs.push_back(dof(e.upper.slot[k], e.component));
        spring.weights.push_back(e.upper.weight[k]);
      }
      if (e.lower.slot[k] >= 0) {
        spring.dofs.push_back(dof(e.lower.slot[k], e.component));
        spring.weights.push_back(-e.lower.weight[k]);
      }
    }
    springs.push_back(std::move(spring));
  }
  return springs;
}

double SpringDampers::energy(ConstNodeField u) const {
  double sum = 0;
  for (const Element& e : elements_) sum += e.energy(e.stretch(u));
  return sum;
}

std::vector<std::int64_t> SpringDampers::slots() const {
  std::vector<std::int64_t> slots;
  for (const Element& e : elements_) {
    e.upper.add_slots(slots);
    e.lower.add_slots(slots);
  }
  return slots;
}

namespace {

/// A node's mass, and its weight in means [kg].
struct Weighed {
  double mass, weight;
};

/// Weights of a ring's nodes, node by node and station by station: their masses times 1 + a cos phi + b sin
/// phi, such that the ring is centred on the axis; masses of unequal stations alone leave it micrometres off.
std::vector<Weighed> centred_weights(const SweptBlock& block, const std::vector<int>& path,
                                     const double* mass) {
  const auto visit = [&](auto act) {
    for (const int node : path)
      for (int station = 0; station < block.station_count(); ++station) {
        const double phi = block.stations[static_cast<std::size_t>(station)];
        act(mass[block.base + block.slot(node, station)], block.section.q[static_cast<std::size_t>(node)],
            std::cos(phi), std::sin(phi));
      }
  };
  double c = 0, s = 0, cc = 0, cs = 0, ss = 0;  // moments of m r
  visit([&](double m, double r, double cosine, double sine) {
    c += m * r * cosine;
    s += m * r * sine;
    cc += m * r * cosine * cosine;
    cs += m * r * cosine * sine;
    ss += m * r * sine * sine;
  });
  const double determinant = cc * ss - cs * cs;
  const double a = (cs * s - ss * c) / determinant;
  const double b = (cs * c - cc * s) / determinant;
  std::vector<Weighed> weights;
  visit([&](double m, double, double cosine, double sine) {
    weights.push_back({m, m * (1 + a * cosine + b * sine)});
  });
  return weights;
}

}  // namespace

Journal::Journal(const SweptBlock& block, const std::vector<int>& path, const double* mass) {
  const std::vector<Weighed> weights = centred_weights(block, path, mass);
  double sum = 0;
  for (const Weighed& node : weights) sum += node.weight;
  double mobility = 0;
  for (const int node : path)
    for (int station = 0; station < block.station_count(); ++station) {
      const double phi = block.stations[static_cast<std::size_t>(station)];
      const auto [m, weight] = weights[nodes_.size()];
      nodes_.push_back({block.base + block.slot(node, station), weight / sum, weight / (sum * m),
                        std::cos(phi), std::sin(phi)});
      mobility += nodes_.back().weight * nodes_.back().per_mass;
    }
  mass_ = 1 / mobility;
}

namespace {

struct Turned {
  double c, s;
};

Turned space_angle(double c, double s, double frame_c, double frame_s) {
  return {c * frame_c - s * frame_s, s * frame_c + c * frame_s};
}

}  // namespace

Vec3 Journal::vector_sum(ConstNodeField field, const BodyFrame& frame, double Node::*factor) const {
  const double fc = std::cos(frame.angle);
  const double fs = std::sin(frame.angle);
  Vec3 sum;
  for (const Node& node : nodes_) {
    const auto [c, s] = space_angle(node.cosine, node.sine, fc, fs);
    const double t = field[dof(node.slot, 0)];
    const double r = field[dof(node.slot, 2)];
    sum += node.*factor * Vec3{-c * t - s * r, field[dof(node.slot, 1)], s * t - c * r};
  }
  return sum;
}

Vec3 Journal::displacement(ConstNodeField u, const BodyFrame& frame) const {
  return vector_sum(u, frame, &Node::weight);
}

Vec3 Journal::velocity(ConstNodeField u, ConstNodeField w, const BodyFrame& frame) const {
  return frame.velocity + displacement(w, frame) + cross({0, frame.spin, 0}, displacement(u, frame));
}

Vec3 Journal::acceleration(ConstNodeField force, const BodyFrame& frame) const {
  return vector_sum(force, frame, &Node::per_mass);
}

void Journal::add(NodeField field, const BodyFrame& frame, const Vec3& load) const {
  const double fc = std::cos(frame.angle);
  const double fs = std::sin(frame.angle);
  for (const Node& node : nodes_) {
    const auto [c, s] = space_angle(node.cosine, node.sine, fc, fs);
    field[dof(node.slot, 0)] += node.weight * (-c * load.x + s * load.z);
    field[dof(node.slot, 1)] += node.weight * load.y;
    field[dof(node.slot, 2)] += node.weight * (-s * load.x - c * load.z);
  }
}

AxleTorque::AxleTorque(const SweptBlock& block, const std::vector<int>& path, const double* mass) {
  const std::vector<Weighed> weights = centred_weights(block, path, mass);
  double inertia = 0;
  for (const int node : path)
    for (int station = 0; station < block.station_count(); ++station) {
      const double r = block.section.q[static_cast<std::size_t>(node)];
      const double weight = weights[nodes_.size()].weight;
      nodes_.push_back({block.base + block.slot(node, station), weight * r});
      inertia += weight * r * r;
    }
  for (Node& node : nodes_) node.lever /= inertia;
}

double AxleTorque::apply(double torque, ConstNodeField u, ConstNodeField w, const BodyFrame& frame,
                         NodeField force) const {
  double spin = frame.spin;
  for (const Node& node : nodes_) {
    force[dof(node.slot, 0)] -= torque * node.lever;
    spin += node.lever * (w[dof(node.slot, 0)] + frame.spin * u[dof(node.slot, 2)]);
  }
  return spin;
}

std::vector<std::int64_t> Journal::slots() const {
  std::vector<std::int64_t> slots;
  for (const Node& node : nodes_) slots.push_back(node.slot);
  return slots;
}

void AxleTorque::add(NodeField load, double torque) const {
  for (const Node& node : nodes_) load[dof(node.slot, 0)] += torque * node.lever;
}

std::vector<std::int64_t> AxleTorque::slots() const {
  std::vector<std::int64_t> slots;
  for (const Node& node : nodes_) slots.push_back(node.slot);
  return slots;
}

}  // namespace tread
