#include "kernels/hexahedra/body_force.hpp"

#include <algorithm>
#include <array>

#include "core/index.hpp"
#include "core/parallel/parallel.hpp"
#include "kernels/element/hexahedron.hpp"

namespace tread {

namespace {

constexpr std::int64_t kRow = kHexNodeValues;

/// Copies the body's values from a field to rows.
template <class Real>
void read_rows(const HexBody& body, const Real* field, double* rows) {
  parallel_ranges(body.nodes(), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t node = first; node < last; ++node)
      for (int c = 0; c < 3; ++c) rows[kRow * node + c] = static_cast<double>(field[dof(body.slot(node), c)]);
  });
}

template <class Real>
void write_rows(const HexBody& body, const double* rows, Real* field) {
  parallel_ranges(body.nodes(), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t node = first; node < last; ++node)
      for (int c = 0; c < 3; ++c) field[dof(body.slot(node), c)] = static_cast<Real>(rows[kRow * node + c]);
  });
}

void read_rows(const HexBody& body, ConstNodeField field, double* rows) {
  for (std::int64_t node = 0; node < body.nodes(); ++node) {
    const Vec3 value = field.at(body.slot(node));
    for (int c = 0; c < 3; ++c) rows[kRow * node + c] = value[c];
  }
}

}  // namespace

BodyForce::BodyForce(const HexBody& body, bool deforms_finitely)
    : body_(&body),
      elements_(body.mesh, body.materials),
      u_(index(kRow * body.nodes()), 0.0),
      v_(u_.size(), 0.0),
      f_(u_.size(), 0.0) {
  elements_.set_finite_rotation(deforms_finitely);
}

void BodyForce::set_damping(double beta, const std::optional<MaxwellBranch>& branch) {
  branch_ = branch;
  elements_.set_beta(branch ? branch->strength : beta);
}

template <class U, class Real>
void BodyForce::internal_force(const U* u, const Real* v, const Real* q, Real* f) const {
  const Real* const damped = branch_ ? q : v;
  const bool is_damped = damped != nullptr && elements_.beta() != 0;
  read_rows(*body_, u, u_.data());
  if (is_damped) read_rows(*body_, damped, v_.data());
  elements_.internal_force(u_.data(), is_damped ? v_.data() : nullptr, f_.data());
  write_rows(*body_, f_.data(), f);
}

template void BodyForce::internal_force(const double*, const double*, const double*, double*) const;
template void BodyForce::internal_force(const double*, const float*, const float*, float*) const;
template void BodyForce::internal_force(const float*, const float*, const float*, float*) const;

void BodyForce::apply(const double* u, double* f) const {
  read_rows(*body_, u, u_.data());
  elements_.apply(u_.data(), f_.data());
  write_rows(*body_, f_.data(), f);
}

DeformationEnergy BodyForce::energy(ConstNodeField u) const {
  read_rows(*body_, u, u_.data());
  return elements_.energy(u_.data());
}

double BodyForce::linear_energy(ConstNodeField u) const {
  read_rows(*body_, u, u_.data());
  elements_.apply(u_.data(), f_.data());
  double twice = 0;
  for (std::size_t i = 0; i < u_.size(); ++i) twice += u_[i] * f_[i];
  return 0.5 * twice;
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
    for (int c = 0; c < 3; ++c) diagonal[dof(body_->slot(node), c)] += own[index(kRow * node + c)];
}

std::int64_t BodyForce::bytes() const {
  return elements_.bytes() + static_cast<std::int64_t>(3 * u_.size() * sizeof(double));
}

template <class Real, class U>
void move_body(const HexBody& body, const StepLoads& loads, const Real* inverse_mass,
               const BasicUpdateFields<Real, U>& fields) {
  const auto step = step_constants<Real>(body.spins ? Sweep::revolved : Sweep::extruded, loads);
  const GravityInSweep gravity = gravity_in_sweep(loads.gravity, kCartesianAngle + loads.frame.angle);
  const auto outwards = static_cast<Real>(gravity.outwards);
  const auto along = static_cast<Real>(gravity.along);
  parallel_ranges(body.nodes(), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t node = first; node < last; ++node) {
      const std::int64_t slot = body.slot(node);
      const Vec3& place = body.mesh.nodes[index(node)];
      Real f[3], v[3];
      U u[3];
      for (int c = 0; c < 3; ++c) {
        f[c] = fields.force[dof(slot, c)];
        v[c] = fields.velocity[dof(slot, c)];
        u[c] = fields.displacement[dof(slot, c)];
      }
      if (body.spins) {
        const Real weight[2] = {along + product(step.spin2, static_cast<Real>(place.x)), outwards};
        move_spinning(step, weight, static_cast<Real>(place.z), inverse_mass[slot], f, u, v);
      } else {
        move_fixed<0>(step, inverse_mass[slot], f, u, v);
      }
      for (int c = 0; c < 3; ++c) {
        fields.velocity[dof(slot, c)] = v[c];
        fields.displacement[dof(slot, c)] = u[c];
      }
    }
  });
}

template void move_body(const HexBody&, const StepLoads&, const double*, const BasicUpdateFields<double>&);
template void move_body(const HexBody&, const StepLoads&, const float*,
                        const BasicUpdateFields<float, double>&);
template void move_body(const HexBody&, const StepLoads&, const float*, const BasicUpdateFields<float>&);

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
