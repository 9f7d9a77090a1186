#pragma once
// Internal force of the blocks of a mesh: a material law at small strain, with or without finite rotation,
// damping in the same evaluation, and what follows from the same elements (mass, energies, stresses,
// frequencies).

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/aligned.hpp"
#include "core/function_ref.hpp"
#include "core/mesh/node_field.hpp"
#include "core/mesh/swept_block.hpp"
#include "core/mesh/tile_sums.hpp"
#include "core/page_vector.hpp"
#include "kernels/blocks/block_elements.hpp"
#include "kernels/blocks/element_matrices.hpp"
#include "kernels/blocks/time_update.hpp"
#include "kernels/lanes/tile_force.hpp"
#include "kernels/material/law_state.hpp"

namespace tread {

/// Von Mises equivalent of a stress (xx, yy, zz, yz, zx, xy).
double von_mises(const std::array<double, 6>& stress);

/// Fields that the elements' loop reads and moves.
template <class Real, class U>
struct ForceFields {
  U* displacement;                 ///< [m]
  Real* velocity;                  ///< at the half step [m/s]
  Real* force;                     ///< [N]
  const Real* lag = nullptr;       ///< of Maxwell branches, where there are any [m]
  LawState<Real>* laws = nullptr;  ///< advanced; null: all blocks have the linear law
};

/// Work that needs the motion of some tiles, beside the elements of the others.
struct WorkBeside {
  std::span<const TileStretch> near;                    ///< whose nodes it reads, in the order of the sweep
  std::span<const TileStretch> elsewhere;               ///< the others
  std::int64_t n;                                       ///< items of its first part
  FunctionRef<void(std::int64_t, std::int64_t)> first;  ///< on ranges of them, before nodes of `near` move
  FunctionRef<void()> then;                             ///< by one thread, once they have moved

  static constexpr std::size_t kFirst = 0, kThen = 2;  ///< links in ParallelTimes
};

/// Vector fields hold 3 * mesh.slots values in the order of dof(), components in the nodes' local bases;
/// unused lanes hold zero on entry and on return. Precisions as in kernels/lanes/tile_force.hpp. Results are
/// the same bits for any number of threads. One object serves one caller at a time: applying it uses buffers
/// of its own.
template <class Real, class U = Real>
class BasicInternalForce {
 public:
  /// Keeps a reference to the mesh. InputError lists the elements that their shape, or the shift of their
  /// nodes, turns inside out.
  explicit BasicInternalForce(const Mesh& mesh);

  /// Damping of a block: forces are those of u + beta v. [s]
  void set_beta(int block, double beta) { blocks_[static_cast<std::size_t>(block)].beta = beta; }
  /// Maxwell branch of a block: forces are those of u + strength q, whatever its beta. [theory.md, Maxwell
  /// branch]
  void set_branch(int block, double strength) { blocks_[static_cast<std::size_t>(block)].branch = strength; }
  double branch(int block) const { return blocks_[static_cast<std::size_t>(block)].branch; }
  double beta(int block) const { return blocks_[static_cast<std::size_t>(block)].beta; }

  /// Green-Lagrange strain in the one-point stress of a block: forces balance moments about the deformed
  /// positions, rigid rotation is free of stress. [theory.md, Finite rotation]
  void set_finite_rotation(int block, bool on) {
    blocks_[static_cast<std::size_t>(block)].finite_rotation = on;
  }
  const BlockElements<Real>& elements(int block) const {
    return blocks_[static_cast<std::size_t>(block)].elements;
  }
  /// Factor of the lag of a block's branch [-], or else of the velocity [s].
  double damping(int block) const { return blocks_[static_cast<std::size_t>(block)].damping(); }

  /// Number of the block's law in Laws.
  int law(int block) const { return blocks_[static_cast<std::size_t>(block)].elements.law(); }
  bool finite_rotation(int block) const { return blocks_[static_cast<std::size_t>(block)].finite_rotation; }

  /// f = K u, overwritten: the linear operator of all blocks, without damping. [N]
  void apply(const U* u, Real* f) const { evaluate(0, items_.size(), {u, nullptr, nullptr, f, true}); }
  /// f = F(u + beta v), or F(u + strength q), overwritten, with F(u) the linear law; v and q may be null. [N]
  void internal_force(const U* u, const Real* v, Real* f, const Real* q = nullptr) const {
    evaluate(0, items_.size(), {u, v, q, f, false});
  }
  /// The same with the laws that the blocks have, F(u) + beta K v or F(u) + strength K q where they are not
  /// linear; advances their state to the displacement, once.
  void internal_force(const ForceFields<Real, U>& at) const {
    evaluate(0, items_.size(), unmoved_fields(at));
  }
  /// internal_force(at), and nodes whose force is complete move by a step while they are at hand:
  /// those that `update` does not defer, in all tiles but those of unmoved_tiles(). The force in f of what
  /// moved means nothing.
  void move(const BasicTimeUpdate<Real, U>& update, const StepLoads& loads,
            const ForceFields<Real, U>& at) const {
    evaluate(0, items_.size(), moved_fields(update, loads, at));
  }
  /// The same beside other work, which finds those nodes moved that `update` does not defer, but for the
  /// first tile of each stretch that does not follow on the one before.
  void move(const WorkBeside& work, const BasicTimeUpdate<Real, U>& update, const StepLoads& loads,
            const ForceFields<Real, U>& at) const;
  /// Marks of the last move(), in the order of blocks and tiles.
  const std::vector<unsigned char>& unmoved_tiles() const { return unmoved_; }

  /// Cost of a tile against others, in the order of blocks and tiles.
  std::int64_t cost(std::size_t tile) const { return cost_[tile + 1] - cost_[tile]; }
  /// True where the loop takes the tile behind this one along.
  bool joined(std::size_t tile) const {
    const Item& at = items_[tile];
    return elements(at.block).joins_next(at.tile);
  }
  /// move() of some stretches alone, in ascending order, which part no joined tiles. The forces in carry() of
  /// tiles outside that end in them are missing. Other tiles are not marked.
  void move(std::span<const TileStretch> stretches, const BasicTimeUpdate<Real, U>& update,
            const StepLoads& loads, const ForceFields<Real, U>& at) const;
  /// internal_force(at) of some stretches alone, likewise.
  void internal_force(std::span<const TileStretch> stretches, const ForceFields<Real, U>& at) const {
    evaluate(stretches, unmoved_fields(at));
  }
  /// Force of a tile's last element on the station behind it: [section node][3] [N].
  std::span<const Real> carry(std::size_t tile) const;

  /// internal_force for the slots of one block. Pointers are those of the whole fields.
  void internal_force(int block, const U* u, const Real* v, Real* f) const;

  /// Energy of u by the law that the block has; without `laws` by the linear one, whose gradient F is. Reads
  /// the state. [J]
  DeformationEnergy energy(int block, const U* u, const LawState<Real>* laws = nullptr) const;
  /// The same of one of its tiles. [J]
  DeformationEnergy tile_energy(int block, int tile, const U* u, const LawState<Real>* laws = nullptr) const;
  /// q . K q / 2 of the linear law of a block's tile. [J]
  double linear_energy(int block, int tile, const Real* q) const;

  /// Stress at the element's centre by the law that the block has, (xx, yy, zz, yz, zx, xy) with x the sweep
  /// direction: in the middle frame; with finite rotation the second Piola-Kirchhoff stress, which turns with
  /// the material and at small strain is the true one. With the lag q, that of u + strength q; without `laws`
  /// that of the linear law. Reads the state. [Pa]
  std::array<double, 6> stress(int block, int quad, int station, ConstNodeField u, ConstNodeField q = nullptr,
                               ConstLawState laws = nullptr) const;

  /// Row sums of the mass matrix, rho times the integral of N_I: mesh.slots values. [kg]
  void lumped_mass(double* mass) const;

  /// Diagonal of the linear K: 3 * mesh.slots values. [N/m]
  void diagonal(double* d) const;

  /// Stiffness of an element by the linear law [N/m].
  ElementStiffness element_stiffness(int block, int quad, int station) const {
    return tread::element_stiffness(elements(block), elements(block).locate(quad, station));
  }

  /// Largest natural frequency of the element alone with its own lumped mass. [rad/s]
  double element_frequency(int block, int quad, int station) const {
    return tread::element_frequency(elements(block), elements(block).locate(quad, station));
  }

  /// Maximum over the elements of a block: a bound from above on its frequencies when assembled.
  ElementFrequency max_frequency(int block) const { return tread::max_frequency(elements(block)); }

  /// Elements whose shape is their own (whole lanes of a tile's quad), of all blocks or of one.
  std::int64_t perturbed_elements() const;
  std::int64_t perturbed_elements(int block) const { return elements(block).perturbed_elements(); }

  /// Bytes of coefficients and buffers.
  std::int64_t bytes() const;

  /// Instruction sets to choose from, and a choice among them (for tests and benchmarks).
  static std::vector<const char*> instruction_sets();
  void use_instruction_set(const char* name);
  const char* instruction_set() const { return forces_->name; }

 private:
  struct Item {
    int block = -1;
    int tile = -1;
  };
  struct BlockData {
    BlockData(const Mesh& mesh, int block) : elements(mesh, block) {}

    BlockElements<Real> elements;
    std::size_t carry_stride = 0;  ///< padding of one load and [section node][3]
    std::size_t first_item = 0;
    double beta = 0;    ///< [s]
    double branch = 0;  ///< strength of the Maxwell branch [-]
    bool finite_rotation = false;

    /// Factor of the branch's lag [-], or of the velocity [s].
    double damping() const { return branch != 0 ? branch : beta; }
  };
  struct Moved {
    const BasicTimeUpdate<Real, U>* update = nullptr;  ///< null: nothing moves
    const StepLoads* loads = nullptr;
    U* u = nullptr;
    Real* v = nullptr;
  };
  struct Fields {
    const U* u;
    const Real* v;
    const Real* q;
    Real* f;
    bool linear;  ///< in blocks of finite rotation too
    Moved moved = {};
    LawState<Real>* laws = nullptr;
  };

  template <class Value>
  DeformationEnergy sum_elements(int block, int tile, const Value* field, bool finite_rotation,
                                 const LawState<Real>* laws) const;

  Real* carry(const Item& item) const;
  static Fields unmoved_fields(const ForceFields<Real, U>& at) {
    return {at.displacement, at.velocity, at.lag, at.force, false, {}, at.laws};
  }
  static Fields moved_fields(const BasicTimeUpdate<Real, U>& update, const StepLoads& loads,
                             const ForceFields<Real, U>& at) {
    const Moved moved = {&update, &loads, at.displacement, at.velocity};
    return {at.displacement, at.velocity, at.lag, at.force, false, moved, at.laws};
  }
  void evaluate(std::size_t first, std::size_t last, const Fields& fields) const {
    const TileStretch stretch{first, last};
    evaluate({&stretch, 1}, fields);
  }
  void evaluate(std::span<const TileStretch> stretches, const Fields& fields) const;
  std::int64_t cost_of(std::span<const TileStretch> stretches) const;
  void evaluate_share(std::span<const TileStretch> stretches, std::int64_t from, std::int64_t to,
                      const Fields& fields) const;
  std::size_t item_at(std::size_t first, std::size_t last, std::int64_t cost) const;
  /// `before`: the item evaluated before by this thread, in this call; becomes the last one of these.
  void evaluate_items(std::size_t first, std::size_t last, Item& before, const Fields& fields) const;
  /// The item's tile and, if `tiles` is 2, the one behind it.
  void evaluate_tiles(std::size_t first, int tiles, const Real* carry_in, const Fields& fields) const;
  void pass_carry(const Item& item, const Real* carry_in, Real* f) const;
  /// Forgets the marks of the evaluation before.
  void begin() const {
    std::fill(halves_.begin(), halves_.end(), 0);
    std::fill(unmoved_.begin(), unmoved_.end(), 0);
  }
  void leave(const Item& item, const Fields& fields) const;
  void complete(const Item& item, const Fields& fields) const;
  void add_carry(const Item& item, Real* f) const;

  const Mesh& mesh_;
  const TileForces* forces_;
  std::vector<BlockData> blocks_;
  std::vector<Item> items_;
  std::vector<std::int64_t> cost_;                 ///< of all tiles before each, to share the work evenly
  AlignedVector<Real> no_carry_;                   ///< zeros
  mutable std::vector<PageVector<Real>> carries_;  ///< by block: [tile][carry_stride]
  /// By item that did not follow on the one before: how many of both are evaluated.
  mutable std::vector<unsigned char> halves_;
  mutable std::vector<unsigned char>
      unmoved_;  ///< marks of those without both, and of items without elements
};

using InternalForce = BasicInternalForce<double>;
extern template class BasicInternalForce<double>;
extern template class BasicInternalForce<float, double>;
extern template class BasicInternalForce<float>;

}  // namespace tread
