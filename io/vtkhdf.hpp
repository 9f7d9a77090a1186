#pragma once
// Meshes and fields for ParaView: static VTKHDF 1.0 files of one unstructured grid.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/swept_block.hpp"
#include "core/vec.hpp"

namespace tread {

/// Where a block's body stands: its frame turned by `angle` about y, then moved to `origin`.
struct Placement {
  Vec3 origin;       ///< [m]
  double angle = 0;  ///< [rad]
};

/// A vector at every node, in the nodes' local bases.
struct VectorField {
  std::string name;
  std::string unit;
  std::span<const double> values;  ///< 3 * mesh.slots values, ordered by dof()
};

/// Writes all blocks as hexahedra: cell arrays `block` and `material` (indices; the arrays' attribute `names`
/// lists the names, comma-separated) and `pitch` (length of the element along the sweep [m]); point arrays:
/// the fields in Cartesian components. Within a block the section nodes of one station follow one another;
/// blocks share no points. `placements` holds one per block or is empty (all at the origin). ParaView 5.11
/// opens the file if its name ends in .hdf. Throws ResourceError; an older file stays until the new one is
/// complete. [VTKHDF 1.0]
void write_vtkhdf(const std::filesystem::path& path, const Mesh& mesh,
                  const std::vector<Placement>& placements = {}, const std::vector<VectorField>& fields = {});

}  // namespace tread
