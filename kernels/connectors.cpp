#include "kernels/connectors.hpp"

#include <cmath>

namespace tread {

void SpringDampers::apply(const double* u, const double* v, double dt, double* force) {
  for (const Element& e : elements_) {
    const double rate = e.upper.value(v, 2) - e.lower.value(v, 2);
    const double load = e.stiffness * (e.upper.value(u, 2) - e.lower.value(u, 2)) + e.damping * rate;
    e.upper.add(force, 2, load);
    e.lower.add(force, 2, -load);
    dissipated_ += e.damping * rate * rate * dt;
  }
}

std::vector<Spring> SpringDampers::springs() const {
  std::vector<Spring> springs;
  for (const Element& e : elements_) {
    Spring spring;
    spring.stiffness = e.stiffness;
    for (std::size_t k = 0; k < 4; ++k) {
      if (e.upper.slot[k] >= 0) {
        spring.dofs.push_back(dof(e.upper.slot[k], 2));
        spring.weights.push_back(e.upper.weight[k]);
      }
      if (e.lower.slot[k] >= 0) {
        spring.dofs.push_back(dof(e.lower.slot[k], 2));
        spring.weights.push_back(-e.lower.weight[k]);
      }
    }
    springs.push_back(std::move(spring));
  }
  return springs;
}

double SpringDampers::energy(const double* u) const {
  double sum = 0;
  for (const Element& e : elements_) {
    const double stretch = e.upper.value(u, 2) - e.lower.value(u, 2);
    sum += 0.5 * e.stiffness * stretch * stretch;
  }
  return sum;
}

Journal::Journal(const SweptBlock& block, const std::vector<int>& path, const double* mass) {
  for (const int node : path)
    for (int station = 0; station < block.station_count(); ++station) {
      const std::int64_t slot = block.base + block.slot(node, station);
      const double phi = block.stations[static_cast<std::size_t>(station)];
      nodes_.push_back({slot, mass[slot], std::cos(phi), std::sin(phi)});
      mass_ += mass[slot];
    }
  for (Node& node : nodes_) node.weight /= mass_;
}

namespace {

struct Turned {
  double c, s;
};

Turned space_angle(double c, double s, double frame_c, double frame_s) {
  return {c * frame_c - s * frame_s, s * frame_c + c * frame_s};
}

}  // namespace

Vec3 Journal::displacement(const double* u, const BodyFrame& frame) const {
  const double fc = std::cos(frame.angle);
  const double fs = std::sin(frame.angle);
  Vec3 sum;
  for (const Node& node : nodes_) {
    const auto [c, s] = space_angle(node.cosine, node.sine, fc, fs);
    const double t = u[dof(node.slot, 0)];
    const double r = u[dof(node.slot, 2)];
    sum += node.weight * Vec3{-c * t - s * r, u[dof(node.slot, 1)], s * t - c * r};
  }
  return sum;
}

Vec3 Journal::velocity(const double* u, const double* w, const BodyFrame& frame) const {
  return frame.velocity + displacement(w, frame) + cross({0, frame.spin, 0}, displacement(u, frame));
}

Vec3 Journal::total(const double* force, const BodyFrame& frame) const {
  const double fc = std::cos(frame.angle);
  const double fs = std::sin(frame.angle);
  Vec3 sum;
  for (const Node& node : nodes_) {
    const auto [c, s] = space_angle(node.cosine, node.sine, fc, fs);
    const double t = force[dof(node.slot, 0)];
    const double r = force[dof(node.slot, 2)];
    sum += {-c * t - s * r, force[dof(node.slot, 1)], s * t - c * r};
  }
  return sum;
}

void Journal::add(double* field, const BodyFrame& frame, const Vec3& load) const {
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
  double inertia = 0;
  for (const int node : path)
    for (int station = 0; station < block.station_count(); ++station) {
      const std::int64_t slot = block.base + block.slot(node, station);
      const double r = block.section.q[static_cast<std::size_t>(node)];
      nodes_.push_back({slot, mass[slot] * r});
      inertia += mass[slot] * r * r;
    }
  for (Node& node : nodes_) node.lever /= inertia;
}

double AxleTorque::apply(double torque, const double* u, const double* w, const BodyFrame& frame,
                         double* force) const {
  double spin = frame.spin;
  for (const Node& node : nodes_) {
    force[dof(node.slot, 0)] -= torque * node.lever;
    spin += node.lever * (w[dof(node.slot, 0)] + frame.spin * u[dof(node.slot, 2)]);
  }
  return spin;
}

}  // namespace tread
