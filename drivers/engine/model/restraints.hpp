#pragma once
// Unknowns of a model that stay zero: ends of the rail, the foot over the fastenings, slabs, plane strain,
// the wheelset's plane of symmetry.

#include <cstdint>
#include <vector>

#include "core/mesh/swept_block.hpp"
#include "core/scene.hpp"
#include "drivers/engine/model/block_index.hpp"
#include "kernels/ties/tie.hpp"

namespace tread {

/// Blocks that are meshed and tied.
struct TiedBodies {
  const Mesh& mesh;
  const BlockIndex& index;
  const Ties* ties = nullptr;  ///< secondary nodes follow their primaries and need no restraint of their own
};

/// Sorted unknowns (dof()) that stay zero.
std::vector<std::int64_t> restrained_unknowns(const Scene& scene, const TiedBodies& bodies);

/// Restrained unknowns less those that the update leaves alone.
std::vector<std::int64_t> held_unknowns(const Mesh& mesh, std::vector<std::int64_t> restrained);

}  // namespace tread
