#pragma once
// The same element written for any hexahedra, node by node in Cartesian axes, with coefficients of its own:
// simple and slow. It is the oracle of the swept kernels and the form for meshes that are not swept.

#include <array>
#include <vector>

#include "core/material.hpp"
#include "core/math/vec.hpp"

namespace tread {

/// One element. Node order as in kernels/element/element.hpp.
struct HexahedronShape {
  std::array<Vec3, 8> nodes;      ///< Cartesian positions [m]
  std::array<Vec3, 8> reference;  ///< positions whose shape sets the hourglass stiffness [m]
  Material material;
  bool finite_rotation = false;  ///< Green-Lagrange strain in the one-point stress
};

/// Coefficients of the force of an element.
struct HexahedronCoefficients {
  double volume = 0;             ///< [m3]
  std::array<Vec3, 8> gradient;  ///< mean gradients of the shape functions [1/m]
  std::array<std::array<double, 24>, 24> hourglass_stiffness;  ///< [3 node + component], Cartesian [N/m]
};
HexahedronCoefficients hexahedron_coefficients(const HexahedronShape& shape);

/// Stress at the centre (xx, yy, zz, yz, zx, xy), Cartesian; with finite rotation the second Piola-Kirchhoff
/// stress. [Pa]
std::array<double, 6> hexahedron_stress(const HexahedronShape& shape,
                                        const std::array<Vec3, 8>& displacement);

/// Largest natural frequency of the element alone with its own lumped mass, by the linear law. [rad/s]
double hexahedron_frequency(const HexahedronShape& shape);

/// Elements given by node lists.
class GeneralForce {
 public:
  struct Element {
    std::array<int, 8> node;
    HexahedronShape shape;
  };

  explicit GeneralForce(std::vector<Element> elements);

  /// Internal force of u over the nodes of the lists, Cartesian; nodes without an element get zero. [N]
  std::vector<Vec3> apply(const std::vector<Vec3>& u) const;

 private:
  std::vector<Element> elements_;
  std::vector<HexahedronCoefficients> coefficients_;
};

}  // namespace tread
