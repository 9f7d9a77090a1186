#pragma once
// The loop over hexahedra with shapes of their own, eight abreast. Its source is compiled once per
// instruction set. [kernels/hexahedra/hex_force.hpp]

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "kernels/element/element.hpp"
#include "kernels/lanes/body_motion.hpp"
#include "kernels/lanes/tile_force.hpp"

namespace tread {

/// Coefficients of the elements of a material; those of the stress are without volume.
struct HexMaterial {
  SweptConstants<double> point = {};  ///< Lame's constants [Pa]; no positions, inverse volume 1
  double mu = 0;                      ///< shear modulus [Pa]
  double youngs_third = 0;            ///< E / 3 [Pa]
  double plate = 0;                   ///< E / (1 - nu^2) [Pa]
  double plate_nu = 0;                ///< nu times that [Pa]
};

/// Values of a node in a vector field: three components and one that is not used.
inline constexpr int kHexNodeValues = 4;

/// Factor of a node's number in HexPack::corner: the values that a node has in HexView::nodes.
inline constexpr int kHexPlace = 2 * kHexNodeValues;

/// Shapes of eight elements of one material.
struct HexShapes {
  double turn[4][kLanes];   ///< rotation of the element as a unit quaternion, real part first
  double scale[3][kLanes];  ///< square root of volume / 192, by the half length along an axis [m^0.5]
  std::int32_t material;
};

/// Any elements. A lane without an element has the corners of a cube that stays at rest.
struct HexPack {
  HexShapes shapes;
  std::uint16_t corner[8][kLanes];  ///< the chunk's node, times kHexPlace
};

/// Elements one behind the other, with their corners on four lines: lane l joins the nodes l and l + 1.
struct HexRow {
  HexShapes shapes;
  std::uint16_t corner[4][kLanes + 1];  ///< likewise
};

/// Elements of a chunk; adds to `f`.
struct HexView {
  const HexRow* rows = nullptr;
  std::ptrdiff_t row_count = 0;
  const HexPack* packs = nullptr;
  std::ptrdiff_t pack_count = 0;
  const HexMaterial* materials = nullptr;
  const double* nodes = nullptr;  ///< by node: position, from any origin, and displacement [m]
  double* f = nullptr;            ///< by node [N]
};

using HexChunkForce = void (*)(const HexView& view);
/// Strain and hourglass energy of the chunk's elements; `f` is not used. [J]
using HexChunkEnergy = DeformationEnergy (*)(const HexView& view);

/// One instruction set's versions; forces and energies by finite rotation: 0 small strain, 1 Green-Lagrange
/// strain.
struct HexForces {
  const char* name;
  HexChunkForce force[2];
  HexChunkEnergy energy[2];
  BodyMoves<double, double> moves_double;
  BodyMoves<float, double> moves_mixed;
  BodyMoves<float, float> moves_single;

  template <class Real, class U>
  const BodyMoves<Real, U>& moves() const {
    if constexpr (std::is_same_v<Real, double>)
      return moves_double;
    else if constexpr (std::is_same_v<U, double>)
      return moves_mixed;
    else
      return moves_single;
  }
};

/// In the order of tile_forces(), which says what the choice depends on.
const std::vector<const HexForces*>& hex_forces();

}  // namespace tread
