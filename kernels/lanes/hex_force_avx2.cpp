#include "kernels/lanes/body_motion_body.hpp"
#include "kernels/lanes/hex_force_body.hpp"

namespace tread {

extern const HexForces hex_forces_avx2;
const HexForces hex_forces_avx2 = {"avx2",
                                   {hex_force<false>, hex_force<true>},
                                   {hex_energy<false>, hex_energy<true>},
                                   kBodyMoves<double, double>,
                                   kBodyMoves<float, double>,
                                   kBodyMoves<float, float>};

}  // namespace tread
