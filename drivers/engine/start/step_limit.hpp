#pragma once
// The longest stable time step of a model's bodies. [theory.md, Stable step]

#include <cstddef>
#include <string>
#include <vector>

#include "core/math/vec.hpp"
#include "drivers/engine/model/model.hpp"

namespace tread {

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
