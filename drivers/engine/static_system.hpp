#pragma once
// The constrained stiffness operator of a model: elasticity on the free unknowns, secondary nodes eliminated.

#include <span>
#include <string>
#include <vector>

#include "core/aligned.hpp"
#include "drivers/engine/model.hpp"
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

/// The element of a block or body with the highest frequency of its own.
struct StiffestElement {
  double step = 0;   ///< stable step of the element alone, without damping [s]
  Vec3 at;           ///< a corner of it (wheel blocks: relative to the axis) [m]
  std::string name;  ///< of the block or body
};

/// Limit of the time step, for the report.
struct StepLimit {
  double stable_step = 0;                 ///< largest of the assembled bodies, damping included [s]
  std::vector<StiffestElement> stiffest;  ///< by block, then by body
  std::string reason;                     ///< one sentence

  /// With the shortest step of `stiffest`.
  std::size_t stiffest_block() const;
};

/// InputError where the beta of materials takes more than half of the step that the assembled bodies have
/// without damping.
void refuse_heavy_damping(const Model& model);

/// InputError where refuse_heavy_damping() throws.
StepLimit step_limit(const Model& model);

/// Largest stable step of the assembled bodies, however short [s].
double stable_step_of(const Model& model);

}  // namespace tread
