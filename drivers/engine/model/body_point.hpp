#pragma once
// A point inside a swept body: its element, and the nodes that carry it.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/node_field.hpp"
#include "core/mesh/swept_block.hpp"

namespace tread {

struct BodyPoint {
  int block = 0;    ///< index into Mesh::blocks
  int quad = 0;     ///< of its section
  int station = 0;  ///< at which the element starts
  std::array<std::int64_t, 8> slot = {};
  std::array<double, 8> weight = {};  ///< trilinear

  /// The field at the point, in the basis of an extruded body's nodes.
  Vec3 value(ConstNodeField field) const {
    Vec3 sum;
    for (std::size_t k = 0; k < slot.size(); ++k) sum += weight[k] * field.at(slot[k]);
    return sum;
  }
};

/// A place in a body's section, below its running surface.
struct SectionPlace {
  double y = 0;      ///< across [m]
  double depth = 0;  ///< below the running surface at y, towards the inside [m]
};

/// The point of the blocks (indices; the first one carries the running surface) at `along`, x [m] or an angle
/// [rad]. InputError, which begins with `what`, the scene's table of the point, where no element holds it.
BodyPoint find_point(const Mesh& mesh, const std::vector<int>& blocks, double along,
                     const SectionPlace& place, const std::string& what);

/// A quad below the running surface.
struct QuadBelow {
  int block = 0;     ///< index into Mesh::blocks
  int quad = 0;      ///< of its section
  double depth = 0;  ///< of its middle below the running surface [m]
};

/// Quads of the blocks under the running surface at y [m], down to a depth [m], the uppermost first.
std::vector<QuadBelow> quads_below(const Mesh& mesh, const std::vector<int>& blocks,
                                   const SectionPlace& deepest);

}  // namespace tread
