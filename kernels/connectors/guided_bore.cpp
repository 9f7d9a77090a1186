#include "kernels/connectors/guided_bore.hpp"

#include <cmath>

namespace tread {

GuidedBore::GuidedBore(const SweptBlock& block, const std::vector<int>& path, const double* mass) {
  for (int station = 0; station < block.station_count(); ++station) {
    const double phi = block.stations[static_cast<std::size_t>(station)];
    double moment = 0;
    for (int node = 0; node < block.section.nodes(); ++node)
      moment +=
          mass[block.base + block.slot(node, station)] * block.section.q[static_cast<std::size_t>(node)];
    imbalance_down_ += moment * std::cos(phi);
    imbalance_behind_ += moment * std::sin(phi);
  }
  for (const int node : path)
    for (int station = 0; station < block.station_count(); ++station) {
      const double phi = block.stations[static_cast<std::size_t>(station)];
      const std::int64_t slot = block.base + block.slot(node, station);
      nodes_.push_back(
          {slot, mass[slot], block.section.q[static_cast<std::size_t>(node)], std::cos(phi), std::sin(phi)});
      mass_ += mass[slot];
      unknowns_.push_back(dof(slot, 0));
      unknowns_.push_back(dof(slot, 2));
      // The lowest node's radial displacement sees a rise best.
      if (std::abs(std::cos(phi)) <= std::abs(per_rise_)) continue;
      per_rise_ = -std::cos(phi);
      unknown_ = dof(slot, 2);
    }
}

void GuidedBore::expand(double* field) const {
  const double rise = field[unknown_] / per_rise_;
  for (const Node& node : nodes_) {
    field[dof(node.slot, 0)] = node.sine * rise;
    field[dof(node.slot, 2)] = -node.cosine * rise;
  }
}

void GuidedBore::reduce(double* force) const {
  double sum = 0;
  for (const Node& node : nodes_) {
    double& t = force[dof(node.slot, 0)];
    double& r = force[dof(node.slot, 2)];
    sum += node.sine * t - node.cosine * r;
    t = r = 0;
  }
  force[unknown_] = sum / per_rise_;
}

double GuidedBore::counterweight(double spin, double angle) const {
  return spin * spin * (imbalance_down_ * std::cos(angle) - imbalance_behind_ * std::sin(angle));
}

void GuidedBore::settle(ConstNodeField displacement) {
  rise_ = displacement[unknown_] / per_rise_;
  rotation_ = rise_speed_ = spin_ = 0;
}

MeanMotion GuidedBore::motion() const {
  MeanMotion motion;
  motion.displacement.z = rise_;
  motion.velocity.z = rise_speed_;
  motion.rotation = rotation_;
  motion.spin = spin_;
  return motion;
}

void GuidedBore::move(const BoreFields& fields, const BodyFrame& frame, double dt, const CarrierLoad& load) {
  const NodeField u = fields.displacement;
  const NodeField w = fields.velocity;
  // Per node: displacement of the rigid carrier, its change per rise and per rotation.
  const double after_c = std::cos(frame.angle + frame.spin * dt);
  const double after_s = std::sin(frame.angle + frame.spin * dt);
  const auto upwards = [&](const Node& node) {
    return Vec3{node.sine * after_c + node.cosine * after_s, 0,
                -(node.cosine * after_c - node.sine * after_s)};
  };
  const auto place = [&](const Node& node, double rise, double rotation) {
    const Vec3 reference{0, 0, node.radius};
    return turn(reference, rotation) - reference + rise * upwards(node);
  };

  // In the spinning frame half of an impulse acts before the turn of the relative velocity by 2 w dt, half
  // after it: together as if the frame had turned by w dt.
  // Momentum along z, and about the axis, of the free nodes' motion over that of the guessed rigid one.
  double rise = rise_ + dt * rise_speed_;
  double rotation = rotation_ + dt * spin_;
  double moment = load.torque * dt;
  double impulse = load.up * dt;
  double coupling = 0;
  double inertia = 0;
  for (const Node& node : nodes_) {
    const Vec3 velocity{w[dof(node.slot, 0)], 0, w[dof(node.slot, 2)]};
    const Vec3 displacement{u[dof(node.slot, 0)], 0, u[dof(node.slot, 2)]};
    const Vec3 more = velocity - (1 / dt) * (place(node, rise, rotation) - (displacement - dt * velocity));
    const Vec3 up = upwards(node);
    const Vec3 around = turn(spin_cross(1, turn({0, 0, node.radius}, rotation_)), -frame.spin * dt);
    impulse += node.mass * dot(up, more);
    moment += node.mass * dot(around, more);
    coupling += node.mass * dot(up, around);
    inertia += node.mass * node.radius * node.radius;
  }
  const double determinant = mass_ * inertia - coupling * coupling;
  rise += dt * (inertia * impulse - coupling * moment) / determinant;
  rotation += dt * (mass_ * moment - coupling * impulse) / determinant;
  rise_speed_ = (rise - rise_) / dt;
  spin_ = (rotation - rotation_) / dt;
  rise_ = rise;
  rotation_ = rotation;

  guide_impulse_ = 0;
  for (const Node& node : nodes_) {
    NodeField::Value u_t = u[dof(node.slot, 0)];
    NodeField::Value u_r = u[dof(node.slot, 2)];
    NodeField::Value w_t = w[dof(node.slot, 0)];
    NodeField::Value w_r = w[dof(node.slot, 2)];
    const Vec3 at = place(node, rise_, rotation_);
    const Vec3 velocity = (1 / dt) * (at - Vec3{u_t - dt * w_t, 0, u_r - dt * w_r});
    const Vec3 up = upwards(node);
    const Vec3 ahead{up.z, 0, -up.x};
    guide_impulse_ += node.mass * dot(ahead, velocity - Vec3{w_t, 0, w_r});
    u_t = at.x;
    u_r = at.z;
    w_t = velocity.x;
    w_r = velocity.z;
  }
}

}  // namespace tread
