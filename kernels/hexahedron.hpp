#pragma once
// The same element written for any hexahedra, node by node in Cartesian axes, with coefficients of its own:
// simple and slow. It is the oracle of the swept kernels and the form for meshes that are not swept.

#include <array>
#include <vector>

#include "core/material.hpp"
#include "core/vec.hpp"

namespace tread {

using HexahedronStiffness = std::array<std::array<double, 24>, 24>;

/// One element. Node order as in kernels/element.hpp.
struct HexahedronShape {
  std::array<Vec3, 8> nodes;      ///< Cartesian positions [m]
  std::array<Vec3, 8> reference;  ///< positions whose shape sets the hourglass stiffness [m]
  Material material;
  Mat3 initial_stress = {};  ///< Cartesian [Pa]
};

/// Rows and columns [3 node + component], Cartesian. [N/m]
HexahedronStiffness hexahedron_stiffness(const HexahedronShape& shape);

/// Stress at the centre (xx, yy, zz, yz, zx, xy), Cartesian, without the initial stress. [Pa]
std::array<double, 6> hexahedron_stress(const HexahedronShape& shape,
                                        const std::array<Vec3, 8>& displacement);

/// Elements given by node lists.
class GeneralForce {
 public:
  struct Element {
    std::array<int, 8> node;
    HexahedronShape shape;
  };

  explicit GeneralForce(std::vector<Element> elements);

  /// f = K u over the nodes of the lists, Cartesian; nodes without an element get zero. [N]
  std::vector<Vec3> apply(const std::vector<Vec3>& u) const;

 private:
  std::vector<Element> elements_;
  std::vector<HexahedronStiffness> stiffness_;
};

}  // namespace tread
