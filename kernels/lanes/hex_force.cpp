#include "kernels/lanes/hex_force.hpp"

#include <string_view>

namespace tread {

extern const HexForces hex_forces_baseline;
#ifdef TREAD_X86_LANES
extern const HexForces hex_forces_avx2;
extern const HexForces hex_forces_avx512;
#endif

const std::vector<const HexForces*>& hex_forces() {
  static const std::vector<const HexForces*> available = [] {
    std::vector<const HexForces*> list;
    for (const TileForces* tiles : tile_forces()) {
      const std::string_view name = tiles->name;
#ifdef TREAD_X86_LANES
      if (name == hex_forces_avx512.name) list.push_back(&hex_forces_avx512);
      if (name == hex_forces_avx2.name) list.push_back(&hex_forces_avx2);
#endif
      if (name == hex_forces_baseline.name) list.push_back(&hex_forces_baseline);
    }
    return list;
  }();
  return available;
}

}  // namespace tread
