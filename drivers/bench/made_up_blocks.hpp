#pragma once
// Blocks of a wanted number of elements, with the sizes and proportions of the paper's rail and tread, for
// kernels on made-up data.

#include <cstdint>

#include "core/aligned.hpp"
#include "core/mesh/swept_block.hpp"
#include "kernels/ties/tie.hpp"

namespace tread {

inline constexpr double kDampedBeta = 1e-10;  ///< beta of damped blocks [s]

/// One block of about `elements` elements. A revolved block is a full turn. `shifted`: every node is moved a
/// little, so that all elements carry coefficients of their own.
Mesh made_up_mesh(Sweep sweep, bool shifted, std::int64_t elements);

/// Two straight blocks of about `elements` elements in all, tied one to three.
struct MadeUpTie {
  Mesh mesh;
  TieSpec tie;
};
MadeUpTie made_up_tie(std::int64_t elements);

/// A smooth vector field of about the given size: 3 * mesh.slots values, zero in unused lanes.
template <class Real>
AlignedVector<Real> made_up_field(const Mesh& mesh, double size);

/// 1e5 / kg for every node; unused lanes do not move.
template <class Real>
AlignedVector<Real> made_up_inverse_mass(const Mesh& mesh);

}  // namespace tread
