#pragma once
// The constrained stiffness operator of a model: elasticity on the free unknowns, secondary nodes eliminated.

#include <span>

#include "core/aligned.hpp"
#include "drivers/engine/model/model.hpp"
#include "kernels/solver/linear_operator.hpp"

namespace tread {

class StaticSystem {
 public:
  explicit StaticSystem(const Model& model) : model_(&model) {}

  /// y = T^T K T x on the free unknowns, springs not included; x is zero elsewhere. Fills secondary nodes and
  /// guided bore of x while it runs. `factors` of the parts' stiffnesses; none: 1.
  void apply(double* x, double* y, std::span<const double> factors = {}) const;

  /// Zero at secondary nodes and restrained unknowns: forces of secondary nodes go to their primaries first.
  void reduce(double* force) const;

  /// Fills the secondary nodes and a guided bore of a displacement field.
  void expand(double* field) const;

  /// Diagonal of the operator, 0 where an unknown is not free and at a guided bore [N/m].
  AlignedVector<double> diagonal() const;

 private:
  void scale(int part, double factor, double* field) const;

  const Model* model_;
};

}  // namespace tread
