#pragma once
// What kernels compute and move: the numerators of the roofline. [docs/performance.md, How it is counted]

#include <cstdint>

#include "core/mesh/swept_block.hpp"
#include "drivers/engine/node_fields.hpp"

namespace tread {

/// Of one step over one unit (an element, a node, ...).
struct Work {
  double flops = 0;  ///< additions, multiplications and divisions
  /// Fields read once and written once; what is written without being read is fetched all the same.
  double bytes = 0;
};

/// Which version of the element a block runs.
struct ElementVariant {
  Sweep sweep = Sweep::extruded;
  bool damped = false;
  bool finite_rotation = false;
  bool perturbed = false;  ///< touches moved nodes
  bool moves = false;      ///< its nodes move in the same pass
  bool vertical_only = false;
};

/// Internal force of a block of one such variant, by element.
Work element_work(const ElementVariant& variant, const SweptBlock& block, ValueBytes bytes);

/// Velocities and displacements of an extruded or a revolved block, by node slot.
Work update_work(Sweep sweep, bool vertical_only, ValueBytes bytes);

/// Forces of secondary nodes handed to the primary ones; displacements and velocities that follow back; by
/// secondary node, in a tie of one to three.
Work tie_hand_over_work(ValueBytes bytes);
Work tie_follow_work(ValueBytes bytes);

}  // namespace tread
