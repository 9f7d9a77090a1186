#pragma once
// Tied surfaces between blocks of different pitch: the fine side's nodes lie on the chords of the coarse side
// and follow its faces by Cartesian bilinear interpolation; their forces and masses go to the primary nodes.
// [theory.md, Ties]

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/mesh/swept_block.hpp"
#include "kernels/solver/coarse_solver.hpp"

namespace tread {

/// Which lines of two blocks' sections are tied. Both blocks sweep the same way.
struct TieSpec {
  int secondary = -1;          ///< fine block
  std::string secondary_path;  ///< nodes ordered by increasing p
  int primary = -1;            ///< coarse block
  std::string primary_path;    ///< nodes ordered by increasing p
};

/// Moves the secondary nodes onto the chords of the primary faces (node_shift). Call before coefficients are
/// made. Throws InputError where a secondary node lies off the primary line in the section or has no primary
/// station.
void place_on_chords(Mesh& mesh, const TieSpec& spec);

class Ties {
 public:
  Ties(const Mesh& mesh, const std::vector<TieSpec>& specs);

  bool empty() const { return secondary_.empty(); }
  std::int64_t secondary_count() const { return static_cast<std::int64_t>(secondary_.size()); }
  const std::vector<std::int64_t>& secondary_slots() const { return secondary_; }
  const std::vector<std::int64_t>& primary_slots() const { return primary_; }

  /// Bytes of the links.
  std::int64_t bytes() const;

  /// Who follows whom, for the solver's coarse level.
  std::vector<TiedSlot> tied_slots() const;

  /// Secondary values from the primary ones; vector fields of 3 * slots values.
  void follow(std::initializer_list<double*> fields) const;

  /// Adds the secondary values to the primary ones (transpose of follow) and sets the secondary ones to zero.
  void gather(double* force) const;

  /// Diagonal of T^T D T for a diagonal D given as a vector field (its turn between the bases left out).
  void gather_diagonal(double* diagonal) const;

  /// The same for lumped masses, a scalar field of `slots` values [kg].
  void gather_mass(double* mass) const;

 private:
  struct Link {
    std::int64_t other;  ///< slot
    double weight;
    double cosine, sine;  ///< of the angle from the primary's to the secondary's local basis
  };
  std::vector<std::int64_t> secondary_;
  std::vector<std::array<Link, 4>> primaries_of_;  ///< by secondary
  std::vector<std::int64_t> primary_;
  std::vector<std::int64_t> first_secondary_;  ///< by primary, into secondaries_of_
  std::vector<Link> secondaries_of_;
};

}  // namespace tread
