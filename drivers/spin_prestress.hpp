#pragma once
// Stress of a wheel that spins freely: constant along the sweep. [theory.md, Spin prestress]

#include <array>
#include <vector>

#include "core/mesh/swept_block.hpp"
#include "kernels/tie.hpp"

namespace tread {

struct SpinPrestress {
  /// By block of the wheel, then by quad: (tt, yy, rr, yr) [Pa].
  std::vector<std::vector<std::array<double, 4>>> stress;
  double tread_growth = 0;  ///< largest radial displacement [m]
};

/// Axisymmetric equilibrium under m spin^2 r of the blocks `wheel` of the mesh and the ties among them.
SpinPrestress spin_prestress(const Mesh& mesh, const std::vector<int>& wheel, const std::vector<TieSpec>& ties,
                             double spin);

}  // namespace tread
