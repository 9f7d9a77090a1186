#pragma once
// The element forces of a body of hexahedra on the fields of a mesh, and the motion of its nodes.
// [theory.md, Bodies from files]

#include <array>
#include <optional>
#include <vector>

#include "core/aligned.hpp"
#include "core/material.hpp"
#include "core/mesh/node_field.hpp"
#include "core/mesh/swept_block.hpp"
#include "kernels/blocks/time_update.hpp"
#include "kernels/hexahedra/hex_force.hpp"

namespace tread {

/// Vector fields hold 3 * mesh.slots values in the order of dof(); all but the body's own are left alone.
/// Forces are computed in double for fields of either precision. Results are the same bits for any number of
/// threads. One object serves one caller at a time.
class BodyForce {
 public:
  /// Keeps a reference. A body that `deforms_finitely` turns or deflects beyond small strain.
  BodyForce(const HexBody& body, bool deforms_finitely);

  const HexBody& body() const { return *body_; }
  const HexForce& elements() const { return elements_; }

  /// Stiffness-proportional damping [s], or a Maxwell branch in place of it.
  void set_damping(double beta, const std::optional<MaxwellBranch>& branch);
  double beta() const { return branch_ ? 0 : elements_.damping(); }
  const std::optional<MaxwellBranch>& branch() const { return branch_; }

  /// f = F(u + beta v), or F(u + g q) with a branch of strength g and lag q; f is overwritten. `v`, `q`: null
  /// where they do not matter. [N]
  template <class U, class Real>
  void internal_force(const U* u, const Real* v, const Real* q, Real* f) const {
    elements_.internal_force_at(body_->base, u, branch_ ? q : v, f);
  }
  /// f = K u: linear, without damping. [N]
  void apply(const double* u, double* f) const { elements_.apply_at(body_->base, u, f); }

  /// Energy of u, and that of the linear operator [J].
  DeformationEnergy energy(ConstNodeField u) const { return elements_.energy_at(body_->base, u); }
  DeformationEnergy linear_energy(ConstNodeField u) const {
    return elements_.linear_energy_at(body_->base, u);
  }

  /// Stress at the centre of an element, as hexahedron_stress(); of u + g q with a branch [Pa].
  std::array<double, 6> stress(std::size_t element, ConstNodeField u, ConstNodeField q) const;

  void add_mass(double* mass) const;          ///< lumped; scalar field of mesh.slots values [kg]
  void add_diagonal(double* diagonal) const;  ///< of K [N/m]

  std::int64_t bytes() const { return elements_.bytes(); }

 private:
  const HexBody* body_;
  HexForce elements_;
  std::optional<MaxwellBranch> branch_;
};

/// Moves the nodes of a body.
template <class Real, class U>
class BodyMotion {
 public:
  /// Keeps references; `inverse_mass`: mesh.slots values, 0 where nothing moves [1/kg].
  BodyMotion(const BodyForce& force, const Real* inverse_mass);

  void move(const StepLoads& loads, const BasicUpdateFields<Real, U>& fields) const;

 private:
  const BodyForce* force_;
  const Real* inverse_mass_;
  AlignedVector<Real> x_, z_;  ///< places of the nodes [m]
};

extern template class BodyMotion<double, double>;
extern template class BodyMotion<float, double>;
extern template class BodyMotion<float, float>;

/// By node, the change of a vector field's Cartesian components per way along x [m], or per angle about the
/// axle [rad] in a body that spins.
std::vector<Vec3> along_motion(const HexBody& body, const double* field);

}  // namespace tread
