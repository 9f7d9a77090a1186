#pragma once
// Geometry and coefficients of the 8-node hexahedron: one stress point with volume-averaged gradients and an
// assumed-strain hourglass stiffness. [theory.md, Element; Flanagan and Belytschko 1981; Belytschko and
// Bindeman 1993]
//
// Nodes 0 ... 3 are the quad's corners (eta, zeta) = (-1,-1), (1,-1), (1,1), (-1,1) at xi = -1, nodes 4 ... 7
// the same at xi = +1. A nodal field is the sum of eight base vectors of +-1; its amplitudes here are the
// plain sums A_m = sum_I base_mI u_I, without the factor 1/8.

#include <array>

#include "core/material.hpp"
#include "core/math/vec.hpp"
#include "core/mesh/swept_block.hpp"

namespace tread {

/// Non-constant base vectors: three linear ones and the hourglass shapes h1 = eta zeta, h2 = zeta xi,
/// h3 = xi eta, h4 = xi eta zeta.
enum Mode { mode_xi, mode_eta, mode_zeta, mode_h1, mode_h2, mode_h3, mode_h4, kModes };
inline constexpr int kHourglassModes = 4;

/// Modes that mean gradients see: h4 has none, in any shape.
inline constexpr int kGradientModes = 6;

/// The kernels' modes: of the sums s and differences d of both ends, the differences along the diagonals of
/// the quad, from corner 0 to 2 and from 1 to 3, which take fewer operations than eta = s02 - s13,
/// zeta = s02 + s13, h2 = d02 + d13 and h3 = d02 - d13.
enum KernelMode { kernel_xi, kernel_s02, kernel_s13, kernel_h1, kernel_d02, kernel_d13, kernel_h4 };

using HexNodes = std::array<Vec3, 8>;

/// Value of a base vector at a node: +1 or -1.
int mode_value(Mode mode, int node);

/// Exact integrals over the trilinear map of one element.
struct ElementGeometry {
  double volume = 0;                        ///< [m3]
  double smallest_jacobian = 0;             ///< over the corners, by volume / 8 [-]
  std::array<double, 8> nodal_volume = {};  ///< integral of N_I [m3]
  /// Amplitudes of the positions. Those of the hourglass modes are what a linear field leaves in them. [m]
  std::array<Vec3, kModes> position = {};
  /// Mean gradients of a field of amplitudes A: g_ij = sum_m A_im gradient[m][j]. [1/m]
  std::array<Vec3, kGradientModes> gradient = {};
};

ElementGeometry element_geometry(const HexNodes& nodes);

/// Nodes of the unperturbed elements of (quad, pitch) in the frame of the element's middle: extruded (x, y,
/// z) about the middle of the length; revolved (t, y, r) about the axis at the middle angle.
HexNodes swept_nodes(const Section& section, int quad, Sweep sweep, double pitch);

/// Hourglass stiffness over Q_(i alpha) = A_(i alpha) - sum_j g_ij position[h_alpha][j] in the order [4 i +
/// alpha], i = x, y, z of the element's middle frame. Energy = Q^T C Q / 2. The element must be swept:
/// symmetric about xi = 0, so that its local axes turn about the sweep only. [N/m]
using HourglassMatrix = std::array<std::array<double, 12>, 12>;
HourglassMatrix hourglass_matrix(const HexNodes& swept, double volume, const Material& material);

/// The entries that the symmetry of a swept element leaves of HourglassMatrix, in the kernels' modes: x1 ...
/// x4 are component x of the gap, d02, d13, h4.
template <class Real>
struct HourglassConstants {
  Real even_diagonal[4];  ///< of (x2, x3, y1, z1)
  Real x2_x3, x2_y1, x2_z1, x3_y1, x3_z1, y1_z1;
  Real x4;
  Real odd_diagonal[5];  ///< of (x1, y2, z2, y3, z3)
  Real odd_upper[10];    ///< their upper triangle by rows
  Real y4, z4, y4_z4;
};

/// Constants shared by all elements of (quad, pitch class). The symmetry about xi = 0 couples d/dx to the
/// modes (xi, d02, d13) only, d/dy and d/dz to (s02, s13, gap) only. In extruded elements the gradients of
/// the gap and the positions of d02, d13, h4 vanish too. Aligned, so that a card loads 16 bytes at once.
template <class Real>
struct alignas(16) SweptConstants {
  Real gradient_x[3];  ///< of xi, d02, d13 [1/m]
  Real gradient_y[3];  ///< of s02, s13, gap [1/m]
  Real gradient_z[3];
  Real position_x[4];  ///< of xi, d02, d13, h4 [m]
  Real position_y[3];  ///< of s02, s13, h1 [m]
  Real position_z[3];
  /// Place on either diagonal of the quad where they cross, from corner 0 and 1. The gap between both
  /// diagonals' values there, s0 + crossing[0] s02 - (s1 + crossing[1] s13), is q of h1 times gap_by_h1. [-]
  Real crossing[2];
  Real gap_by_h1;
  Real lambda, mu;      ///< Lame's constants times the volume [N m]
  Real inverse_volume;  ///< [1/m3]
  HourglassConstants<Real> hourglass;
};

template <class Real>
SweptConstants<Real> swept_constants(const ElementGeometry& geometry, const HourglassMatrix& hourglass,
                                     const Material& material);

}  // namespace tread
