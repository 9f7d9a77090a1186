#include "kernels/lanes/tile_force.hpp"

namespace tread {

extern const TileForces tile_forces_baseline;
#ifdef TREAD_X86_LANES
extern const TileForces tile_forces_avx2;
extern const TileForces tile_forces_avx512;
#endif

const std::vector<const TileForces*>& tile_forces() {
  static const std::vector<const TileForces*> available = [] {
    std::vector<const TileForces*> list;
#ifdef TREAD_X86_LANES
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
      list.push_back(&tile_forces_avx512);
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) list.push_back(&tile_forces_avx2);
#endif
    list.push_back(&tile_forces_baseline);
    return list;
  }();
  return available;
}

}  // namespace tread
