#include "kernels/hexahedra/body_force.hpp"

#include <algorithm>
#include <array>

#include "core/index.hpp"
#include "core/parallel/parallel.hpp"
#include "kernels/element/hexahedron.hpp"

namespace tread {

BodyForce::BodyForce(const HexBody& body, bool deforms_finitely)
    : body_(&body), elements_(body.mesh, body.materials) {
  elements_.set_finite_rotation(deforms_finitely);
}

void BodyForce::set_damping(double beta, const std::optional<MaxwellBranch>& branch) {
  branch_ = branch;
  elements_.set_damping(branch ? branch->strength : beta);
}

std::array<double, 6> BodyForce::stress(std::size_t element, ConstNodeField u, ConstNodeField q) const {
  const HexMesh& mesh = body_->mesh;
  const std::array<Vec3, 8> corners = mesh.corners(element);
  std::array<Vec3, 8> moved;
  for (std::size_t k = 0; k < 8; ++k) {
    const std::int64_t slot = body_->slot(mesh.elements[element][k]);
    moved[k] = u.at(slot);
    if (branch_ && q) moved[k] += branch_->strength * q.at(slot);
  }
  return hexahedron_stress(
      {corners, corners, body_->materials[index(mesh.part[element])], elements_.finite_rotation()}, moved);
}

void BodyForce::add_mass(double* mass) const {
  const std::vector<double> own = elements_.lumped_mass();
  for (std::int64_t node = 0; node < body_->nodes(); ++node) mass[body_->slot(node)] += own[index(node)];
}

void BodyForce::add_diagonal(double* diagonal) const {
  const std::vector<double> own = elements_.diagonal();
  for (std::int64_t node = 0; node < body_->nodes(); ++node)
    for (int c = 0; c < 3; ++c)
      diagonal[dof(body_->slot(node), c)] += own[index(std::int64_t{kHexNodeValues} * node + c)];
}

template <class Real, class U>
BodyMotion<Real, U>::BodyMotion(const BodyForce& force, const Real* inverse_mass)
    : force_(&force), inverse_mass_(inverse_mass) {
  const HexBody& body = force.body();
  if (!body.spins) return;
  x_.assign(index(body.slots()), Real{0});
  z_.assign(index(body.slots()), Real{0});
  for (std::size_t node = 0; node < body.mesh.nodes.size(); ++node) {
    x_[node] = static_cast<Real>(body.mesh.nodes[node].x);
    z_[node] = static_cast<Real>(body.mesh.nodes[node].z);
  }
}

template <class Real, class U>
void BodyMotion<Real, U>::move(const StepLoads& loads, const BasicUpdateFields<Real, U>& fields) const {
  const HexBody& body = force_->body();
  const GravityInSweep gravity = gravity_in_sweep(loads.gravity, kCartesianAngle + loads.frame.angle);
  BodyGroups<Real, U> groups;
  groups.step = step_constants<Real>(body.spins ? Sweep::revolved : Sweep::extruded, loads);
  groups.gravity[0] = static_cast<Real>(gravity.along);
  groups.gravity[1] = static_cast<Real>(gravity.outwards);
  groups.x = x_.data();
  groups.z = z_.data();
  groups.inverse_mass = inverse_mass_ + body.base;
  groups.u = fields.displacement + dof(body.base, 0);
  groups.v = fields.velocity + dof(body.base, 0);
  groups.f = fields.force + dof(body.base, 0);
  const auto move = force_->elements().instruction_set().moves<Real, U>().move[body.spins ? 1 : 0];
  parallel_ranges(body.slots() / kLanes, [&](std::int64_t first, std::int64_t last) {
    BodyGroups<Real, U> some = groups;
    some.first = first;
    some.last = last;
    move(some);
  });
}

template class BodyMotion<double, double>;
template class BodyMotion<float, double>;
template class BodyMotion<float, float>;

namespace {

using Edges = std::array<Vec3, 3>;

Edges edges_at(const std::array<Vec3, 8>& corners, std::size_t corner) {
  Edges edges;
  for (std::size_t k = 0; k < 3; ++k) edges[k] = corners[kHexNeighbours[corner][k]] - corners[corner];
  return edges;
}

double volume_of(const Edges& edges) {
  return dot(edges[0], cross(edges[1], edges[2]));
}

/// Mean volume of the edges at the corners [m3].
double mean_volume(const std::array<Vec3, 8>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < 8; ++i) sum += volume_of(edges_at(corners, i));
  return sum / 8;
}

}  // namespace

std::vector<Vec3> along_motion(const HexBody& body, const double* field) {
  const auto value = [&](std::int32_t node) {
    const std::int64_t slot = body.slot(node);
    return Vec3{field[dof(slot, 0)], field[dof(slot, 1)], field[dof(slot, 2)]};
  };
  // The corners' gradients, weighted by volume / mean^2: those of two bricks in a line make a parabola's, and
  // a flat corner, whose gradient is uncertain, counts for little.
  std::vector<Vec3> change(body.mesh.nodes.size());
  std::vector<double> weights(body.mesh.nodes.size(), 0.0);
  for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
    const HexCorners& nodes = body.mesh.elements[e];
    const std::array<Vec3, 8> corners = body.mesh.corners(e);
    const double mean = mean_volume(corners);
    const double scale = 1 / (mean * mean);
    for (std::size_t i = 0; i < 8; ++i) {
      const Edges edges = edges_at(corners, i);
      const Vec3 along = body.spins ? cross({0, 1, 0}, corners[i]) : Vec3{1, 0, 0};
      for (std::size_t k = 0; k < 3; ++k) {
        const double share = dot(along, cross(edges[(k + 1) % 3], edges[(k + 2) % 3]));
        change[index(nodes[i])] += scale * share * (value(nodes[kHexNeighbours[i][k]]) - value(nodes[i]));
      }
      weights[index(nodes[i])] += scale * volume_of(edges);
    }
  }
  for (std::size_t node = 0; node < change.size(); ++node) change[node] = (1 / weights[node]) * change[node];
  return change;
}

}  // namespace tread
