#pragma once
// Places of a tie's secondary nodes on its primary line and along its stations.

#include <array>
#include <string>
#include <vector>

#include "core/mesh/swept_block.hpp"

namespace tread {

/// Primary section edge under a secondary section node.
struct SectionPoint {
  std::array<int, 2> node;
  double fraction;
};

/// By secondary section node. InputError if one lies off the primary line.
std::vector<SectionPoint> locate_in_section(const SweptBlock& fine, const std::vector<int>& fine_path,
                                            const SweptBlock& coarse, const std::vector<int>& coarse_path);

/// Primary stations about a secondary one.
struct StationPoint {
  std::array<int, 2> station;
  double fraction;
};

/// InputError if the station lies beyond the coarse block.
StationPoint locate_along(const SweptBlock& fine, int station, const SweptBlock& coarse);

/// Section nodes of a named path. InputError if there is none.
const std::vector<int>& path_of(const SweptBlock& block, const std::string& name);

}  // namespace tread
