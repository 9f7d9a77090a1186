#include "kernels/lanes/tile_force_body.hpp"

namespace tread {

extern const TileForces tile_forces_baseline;
const TileForces tile_forces_baseline = {"baseline",
                                         tile_loops<double, double>,
                                         tile_loops<float, double>,
                                         tile_loops<float, float>,
                                         tie_sum<double>,
                                         tie_sum<float>,
                                         patch_respond,
                                         cell_to_nodes,
                                         cell_to_points};

}  // namespace tread
