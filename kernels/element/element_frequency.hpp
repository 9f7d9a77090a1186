#pragma once
// Largest natural frequency of a single element.

#include <array>

namespace tread {

/// Rows and columns [3 node + component], nodes as in kernels/element/element.hpp. [N/m]
using ElementStiffness = std::array<std::array<double, 24>, 24>;

/// Largest natural frequency of an element alone with its own lumped mass. `nodal_volume`: integrals of the
/// shape functions [m3]; `density` [kg/m3]. [rad/s]
double largest_frequency(const ElementStiffness& stiffness, const std::array<double, 8>& nodal_volume,
                         double density);

}  // namespace tread
