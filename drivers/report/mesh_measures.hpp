#pragma once
// Measures of a mesh: counts, extreme elements, masses.

#include <cstdint>
#include <string>
#include <vector>

#include "core/math/vec.hpp"
#include "drivers/engine/model/model.hpp"
#include "io/report/report.hpp"

namespace tread {

/// A value and where it occurs (wheel blocks: relative to the axis).
struct Extreme {
  double value = 0;
  Vec3 at;  ///< [m]
};

struct BlockMeasures {
  std::string name;
  std::int64_t elements = 0, nodes = 0;
  int quads = 0, stations = 0;  ///< 0: not swept
  Extreme shortest_edge;        ///< [m]
  Extreme longest_edge;         ///< [m]
  Extreme worst_quality;        ///< smallest corner Jacobian over the mean of the element's eight: 1 for a
                                ///< parallelepiped [-]
  double mass = 0;              ///< of the elements [kg]
  double swept_mass = 0;        ///< of the section swept without facets or moved nodes [kg]
};

/// By part of the mesh.
std::vector<BlockMeasures> measure_blocks(const Model& model);

/// Parts that tables show as one: all sleepers; every other block or body by itself.
struct BlockGroup {
  std::string name;
  std::vector<int> blocks;  ///< parts of the mesh
};
std::vector<BlockGroup> block_groups(const Model& model);

/// The measures of each group: counts and masses added up, the most extreme elements; quads and stations of
/// one of its blocks.
std::vector<BlockMeasures> by_group(const Model& model, const std::vector<BlockMeasures>& blocks);

/// (x, y, z) for a table.
std::string place(const Vec3& at);

Table count_table(const std::vector<BlockMeasures>& blocks);
Table quality_table(const std::vector<BlockMeasures>& blocks);

}  // namespace tread
