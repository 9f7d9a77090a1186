#pragma once
// Internal force of a mesh of hexahedra with a connectivity of its own: the element of the swept blocks with
// the linear law, at small strain or with finite rotation. [theory.md, Element]

#include <cstdint>
#include <span>
#include <vector>

#include "core/aligned.hpp"
#include "core/material.hpp"
#include "core/mesh/hex_mesh.hpp"
#include "core/mesh/node_field.hpp"
#include "kernels/hexahedra/hex_rows.hpp"
#include "kernels/lanes/hex_force.hpp"

namespace tread {

/// The element with the largest natural frequency.
struct HexFrequency {
  double omega = 0;         ///< [rad/s]
  std::size_t element = 0;  ///< index in the mesh
};

/// Vector fields hold kHexNodeValues values a node, [node][component] in Cartesian axes, the last not used;
/// or they are those of a mesh in the order of dof(), from the slot of node 0 on. Results are the same bits
/// for any number of threads. One object serves one caller at a time: applying it uses buffers of its own.
class HexForce {
 public:
  /// Keeps a reference to the mesh. `materials`: by part of the mesh, of a linear law.
  HexForce(const HexMesh& mesh, std::vector<Material> materials);

  const HexForces& instruction_set() const { return *forces_; }
  std::int64_t nodes() const { return static_cast<std::int64_t>(mesh_->nodes.size()); }

  /// Damping: forces are those of u + damping added, where `added` is the velocity and the factor in s, or a
  /// Maxwell branch's lag and its strength [-].
  void set_damping(double damping) { damping_ = damping; }
  double damping() const { return damping_; }
  /// Green-Lagrange strain in the one-point stress, as in BasicInternalForce.
  void set_finite_rotation(bool on) { finite_rotation_ = on; }
  bool finite_rotation() const { return finite_rotation_; }

  /// f = F(u + damping added), overwritten; `added` may be null. [N]
  void internal_force(const double* u, const double* added, double* f) const;
  /// f = K u, overwritten: the linear operator, without damping. [N]
  void apply(const double* u, double* f) const;
  /// Energy of u, whose gradient is F. [J]
  DeformationEnergy energy(const double* u) const;

  /// The same on fields of a mesh, of either precision; what is not the body's is left alone.
  template <class U, class Real>
  void internal_force_at(std::int64_t slot, const U* u, const Real* added, Real* f) const;
  void apply_at(std::int64_t slot, const double* u, double* f) const;
  DeformationEnergy energy_at(std::int64_t slot, ConstNodeField u) const;
  DeformationEnergy linear_energy_at(std::int64_t slot, ConstNodeField u) const;  ///< of the linear operator

  /// Row sums of the mass matrix by node [kg].
  std::vector<double> lumped_mass() const;
  /// Diagonal of K, a vector field [N/m].
  std::vector<double> diagonal() const;
  /// Largest natural frequency of an element alone with its own lumped mass: a bound from above on those of
  /// the assembled mesh.
  HexFrequency max_frequency() const;

  /// Bytes of coefficients and buffers.
  std::int64_t bytes() const;

  /// Instruction sets to choose from, and a choice among them (for tests and benchmarks).
  static std::vector<const char*> instruction_sets();
  void use_instruction_set(const char* name);

 private:
  /// Elements that are worked on together, and their nodes.
  struct Chunk {
    std::size_t first_row = 0, rows = 0;
    std::size_t first_pack = 0, packs = 0;
    std::size_t first_node = 0;  ///< index in `places_`
    std::size_t nodes = 0;
    std::size_t first_position = 0;  ///< of its nodes, index in `positions_` in nodes
  };
  /// A node of several chunks: its forces by chunk, in their order.
  struct SharedNode {
    std::int32_t node = 0;
    std::int32_t first = 0, last = 0;  ///< rows of `partial_`
  };
  /// A chunk's node: where its displacement comes from and its force goes to.
  struct NodePlace {
    std::int32_t node = 0;
    std::int32_t partial = -1;  ///< place among the partial forces; -1: the chunk has the whole force
  };

  void cut_into_chunks();
  void add_chunk(std::span<const std::int32_t> elements, const std::vector<std::int32_t>& nodes);
  void add_row(const ElementRow& row, const std::vector<std::int32_t>& nodes);
  void add_pack(std::span<const std::int32_t> elements, const std::vector<std::int32_t>& nodes);
  void share_nodes();
  template <class U, class V, class F>
  void evaluate(const U& u, const V* added, const F& f, bool finite_rotation) const;
  template <class U, class V>
  void load(const Chunk& chunk, const U& u, const V* added, double* values) const;
  template <class U>
  DeformationEnergy energy_of(const U& u, bool finite_rotation) const;
  HexView view(const Chunk& chunk) const;

  const HexMesh* mesh_;
  std::vector<Material> materials_;
  std::vector<HexMaterial> constants_;
  double damping_ = 0;
  bool finite_rotation_ = false;
  const HexForces* forces_;
  AlignedVector<HexRow> rows_;
  AlignedVector<HexPack> packs_;
  AlignedVector<double> positions_;  ///< rows of the chunks' nodes and of those of idle lanes [m]
  std::vector<Chunk> chunks_;
  std::vector<NodePlace> places_;
  std::vector<SharedNode> shared_;
  std::size_t largest_chunk_ = 0;  ///< nodes, and those of idle lanes
  mutable AlignedVector<double> partial_;
};

}  // namespace tread
