#pragma once
// Cut of a section into the parts of a march's teams. [docs/records/device.md]

#include <vector>

#include "core/mesh/swept_block.hpp"
#include "kernels/device/march_layout.hpp"
#include "kernels/element/front_plan.hpp"

namespace tread {

/// Cut of sections and tiles for the teams.
struct MarchCut {
  int threads = 192;    ///< of a team
  int part_quads = 90;  ///< quads that a part owns at most
  int run_tiles = 4;    ///< tiles of a run
};

/// Parts of a section, each of compact shape, and the tables of their nodes and quads.
struct SectionCut {
  std::vector<MarchPart> parts;
  std::vector<int> nodes;
  std::vector<MarchQuad> quads;
  int colours = 0;
  std::vector<int> first_of_colour;  ///< [part][colour] and one more colour
};

/// Cuts a section into parts that a team takes soonest: of elements that share no node, whose threads wait
/// for each other, it takes as many at once as it has threads. Quads are numbered by their place in the plan.
/// `moved`: by place, how many elements of the quad touch moved nodes; empty: none do. Threads that run
/// together get quads with similar numbers of them.
SectionCut cut_section(const Section& section, const FrontPlan& plan, const MarchCut& sizes,
                       const std::vector<int>& moved = {});

}  // namespace tread
