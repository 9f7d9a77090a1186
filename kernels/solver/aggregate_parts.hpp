#pragma once
// The parts into which sections, sweeps and bodies are cut for aggregates.

#include <cstdint>
#include <vector>

#include "core/mesh/swept_block.hpp"

namespace tread {

struct AggregateOptions {
  double size = 0.05;     ///< approximate largest extent of an aggregate [m]
  int nodes_across = 16;  ///< approximate largest number of nodes along one direction
  int least_across = 3;   ///< number of nodes along one direction that `size` does not split
};

/// Connected parts of the section, each about one aggregate in extent.
std::vector<std::vector<int>> section_parts(const Section& section, const AggregateOptions& options);

/// Ends of the runs of stations at mean distance `radius` [m] from the axis (1 for extruded blocks).
std::vector<int> station_runs(const SweptBlock& block, double radius, const AggregateOptions& options);

/// Mean distance of the nodes from the axis [m]; 1 for extruded blocks.
double mean_radius(const SweptBlock& block, const std::vector<int>& nodes);

/// Nodes of a body that lie together in boxes of an aggregate's extent.
std::vector<std::vector<std::int32_t>> body_parts(const HexBody& body, const AggregateOptions& options);

}  // namespace tread
