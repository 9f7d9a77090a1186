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
  elements_.set_beta(branch ? branch->strength : beta);
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

/// Shares of the edges at a corner in the way `along`.
struct EdgeShares {
  std::array<double, 3> share;
  double volume;  ///< of the edges [m3]
};

EdgeShares edge_shares(const std::array<Vec3, 3>& edge, const Vec3& along) {
  const double volume = dot(edge[0], cross(edge[1], edge[2]));
  EdgeShares shares{{}, volume};
  for (std::size_t k = 0; k < 3; ++k)
    shares.share[k] = dot(along, cross(edge[(k + 1) % 3], edge[(k + 2) % 3])) / volume;
  return shares;
}

}  // namespace

std::vector<Vec3> along_motion(const HexBody& body, const double* field) {
  const auto value = [&](std::int32_t node) {
    const std::int64_t slot = body.slot(node);
    return Vec3{field[dof(slot, 0)], field[dof(slot, 1)], field[dof(slot, 2)]};
  };
  // The corners' differences, weighted so that those of two elements in a line make a parabola's.
  std::vector<Vec3> change(body.mesh.nodes.size());
  std::vector<double> weights(body.mesh.nodes.size(), 0.0);
  for (const HexCorners& corners : body.mesh.elements)
    for (std::size_t i = 0; i < 8; ++i) {
      const Vec3& here = body.mesh.nodes[index(corners[i])];
      std::array<Vec3, 3> edge, difference;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t other = corners[kHexNeighbours[i][k]];
        edge[k] = body.mesh.nodes[index(other)] - here;
        difference[k] = value(other) - value(corners[i]);
      }
      const Vec3 along = body.spins ? cross({0, 1, 0}, here) : Vec3{1, 0, 0};
      const EdgeShares shares = edge_shares(edge, along);
      const double weight = 1 / shares.volume;
      for (std::size_t k = 0; k < 3; ++k)
        change[index(corners[i])] += weight * shares.share[k] * difference[k];
      weights[index(corners[i])] += weight;
    }
  for (std::size_t node = 0; node < change.size(); ++node) change[node] = (1 / weights[node]) * change[node];
  return change;
}

}  // namespace tread
