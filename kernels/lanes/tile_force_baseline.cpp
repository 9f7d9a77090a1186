#include "kernels/lanes/tile_force_body.hpp"

namespace tread {

extern const TileForces tile_forces_baseline;
const TileForces tile_forces_baseline = {
    "baseline",           select_variant<double>, select_variant<float>, select_energy<double>,
    select_energy<float>, select_move<double>,    select_move<float>,    tie_sum<double>,
    tie_sum<float>};

}  // namespace tread
