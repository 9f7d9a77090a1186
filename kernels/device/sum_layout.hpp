#pragma once
// Sums over nodes and elements of a run on a device: what their kernels read and write, as plain data.
// [docs/records/device.md]

#include <cstdint>

#include "core/body_frame.hpp"
#include "kernels/device/march_layout.hpp"

namespace tread {

/// A motion of all nodes: fields of 3 * slots values in the order of dof().
template <class Real, class U>
struct NodeMotions {
  const U* u = nullptr;     ///< [m]
  const Real* v = nullptr;  ///< at the half step before [m/s]
};

/// Sums that many threads share, by value: [value][part]. Their order is that of the parts, and so are the
/// bits.
struct SumParts {
  double* part = nullptr;
  std::int64_t parts = 0;
};

/// Sums over the nodes of a block. Those of bodies that do not spin are one component long.
enum NodeSum : int {
  sum_displacement = 0,  ///< mass times displacement, three in space; upwards alone [kg m]
  sum_velocity = 3,      ///< mass times velocity relative to the frame, three in space [kg m/s]
  sum_rotation = 6,      ///< mass times radius times tangential displacement [kg m2]
  sum_spin = 7,          ///< mass times radius times tangential relative velocity [kg m2/s]
  sum_kinetic = 8,       ///< twice the kinetic energy [J]
  sum_excess = 9,        ///< mass times the square of the velocity that forces have changed in a step [J]
  node_sums = 10
};

/// The sums of a block.
template <class Real, class U>
struct NodeSumTask {
  static constexpr int kNodes = 16;  ///< that a thread takes, of one station

  MarchBlock<Real> block;  ///< with the step that has led to the motion
  bool spins = false;      ///< revolved
  bool vertical_only = false;
  const double* mass = nullptr;  ///< by slot [kg]
  const Real* inverse_mass = nullptr;
  const unsigned char* fixed = nullptr;  ///< by slot: a bit for each component that forces do not move
  const double* radius = nullptr;        ///< by section node (revolved) [m]
  NodeMotions<Real, U> motion;
  NodeMotions<Real, U> before;  ///< a step ago; null: without sum_excess
  BodyFrame frame;              ///< at the time of the displacements
  BodyFrame half_frame;         ///< at the time of the velocities
  SumParts to;
  std::int64_t first_part = 0;

  constexpr int chunks() const { return (block.section_nodes + kNodes - 1) / kNodes; }
  constexpr std::int64_t threads() const { return std::int64_t{block.tiles} * chunks() * kLanes; }
};

/// Sums over the elements of a block [J]; the last one in watts.
enum ElementSum : int { sum_stored, sum_dissipated, sum_branch, sum_power, element_sums };

template <class Real, class U>
struct ElementSumTask {
  static constexpr int kQuads = 8;  ///< that a thread takes, of one station

  MarchBlock<Real> block;
  const int* corner = nullptr;  ///< section nodes of the quads: [place][4]
  const U* u = nullptr;         ///< [m]
  const Real* lag = nullptr;    ///< of a Maxwell branch [m]; null: none
  double strength = 0;          ///< of the branch [-]
  double power = 0;             ///< of its dashpot, over what its spring stores [1/s]
  const Real* state = nullptr;  ///< of the law: [tile][place][value][lane]
  SumParts to;
  std::int64_t first_part = 0;

  constexpr int chunks() const { return (block.quads + kQuads - 1) / kQuads; }
  constexpr std::int64_t threads() const { return std::int64_t{block.tiles} * chunks() * kLanes; }
};

/// Sums parts up to kFolds for each value, of the parts before `split` and of the others.
struct FoldTask {
  static constexpr int kFolds = 512;

  SumParts from;
  int values = 0;
  std::int64_t split = 0;
  std::int64_t end = 0;
  double* to = nullptr;  ///< [half][value][fold]

  constexpr std::int64_t threads() const { return std::int64_t{2} * values * kFolds; }
};

}  // namespace tread
