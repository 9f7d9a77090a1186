#pragma once
// Operations and bytes of kernels: the numerators of the roofline. [performance.md, How it is counted]

#include <cstdint>

#include "core/mesh/swept_block.hpp"
#include "drivers/engine/fields/node_fields.hpp"

namespace tread {

/// Work of one step over one unit (an element, a node, ...).
struct Work {
  double flops = 0;  ///< additions, multiplications and divisions
  /// Bytes of fields read once and written once. A value that is written without being read is fetched all
  /// the same.
  double bytes = 0;
};

/// Version of the element that a block runs.
struct ElementVariant {
  Sweep sweep = Sweep::extruded;
  bool damped = false;
  bool finite_rotation = false;
  bool perturbed = false;  ///< true if elements touch moved nodes
  bool moves = false;      ///< true if the nodes move in the same pass
  bool vertical_only = false;
};

/// Work of the internal force of a block of one variant, per element.
Work element_work(const ElementVariant& variant, const SweptBlock& block, ValueBytes bytes);

/// Work of velocities and displacements of an extruded or a revolved block, per node slot.
Work update_work(Sweep sweep, bool vertical_only, ValueBytes bytes);

/// Work of a tie of one to three, per secondary node. tie_hand_over_work: forces of secondary nodes go to the
/// primary ones. tie_follow_work: displacements and velocities follow back.
Work tie_hand_over_work(ValueBytes bytes);
Work tie_follow_work(ValueBytes bytes);

}  // namespace tread
