#pragma once
// What a march over a block reads, as plain data in the memory of a device. [docs/records/device.md]
//
// A block of the mesh is cut twice: its section into parts, its tiles into runs. A team of threads takes one
// part over one run and marches along the sweep, tile by tile.

#include <cstdint>

#include "kernels/element/element.hpp"
#include "kernels/lanes/tile_force.hpp"
#include "kernels/update/node_motion_body.hpp"

namespace tread {

/// A part of a section. Nodes: those that it owns, then the others of its quads. Quads: all that touch a node
/// that it owns, those of neighbouring parts too, by colour, then in the order of the front plan.
struct MarchPart {
  int first_node = 0;  ///< into MarchBlock::part_nodes
  int nodes = 0;
  int own_nodes = 0;
  int first_quad = 0;  ///< into MarchBlock::part_quads
  int quads = 0;
};

/// A quad of a part.
struct MarchQuad {
  std::uint16_t node[4];     ///< its corners among the part's nodes
  std::uint32_t place : 27;  ///< in the front plan, by which coefficients are ordered
  std::uint32_t own : 1;     ///< in the one part that writes the state of its elements
  std::uint32_t begins : 4;  ///< a bit by corner: no quad before this one adds forces to the node
};

/// Successive runs of a block, which may pass the end of a full turn.
struct MarchRuns {
  int first = 0, count = 0;
};

/// Cosine and sine of half a pitch.
struct HalfPitch {
  double cosine, sine;
};

/// A block; arrays by tile and by station have one entry for each, those by class one for each pitch class.
template <class Real>
struct MarchBlock {
  int tiles = 0;
  int closed = 0;         ///< nonzero for a full turn
  int quads = 0;          ///< of the section
  int section_nodes = 0;  ///< of the section
  int origin_node = 0;    ///< BlockElements::origin_node
  int colours = 0;        ///< quads of one colour share no node
  int parts = 0;
  int run_tiles = 0;          ///< tiles of a run; the last one has the rest
  MarchRuns marched;          ///< of the runs, in this march
  const int* list = nullptr;  ///< its teams instead, numbered run by run, part by part
  int listed = 0;             ///< number of these
  MarchRuns left_out;         ///< runs of the list that another march takes
  int most_nodes = 0;         ///< of a part
  int most_own_nodes = 0;     ///< of a part
  int most_quads = 0;         ///< of a part

  const MarchPart* part = nullptr;
  const int* part_nodes = nullptr;  ///< section nodes
  const MarchQuad* part_quads = nullptr;
  const int* first_of_colour = nullptr;  ///< [part][colour] and one more colour: among the part's quads

  std::int64_t first_group = 0;           ///< of kLanes slots, among all
  const Tile* tile = nullptr;             ///< SweptBlock::tiles
  const HalfPitch* half_pitch = nullptr;  ///< by class (revolved)
  const Real* radius = nullptr;           ///< by section node (revolved) [m]
  const double* angle = nullptr;          ///< by station (revolved) [rad]

  const SweptConstants<Real>* constants = nullptr;  ///< [class][place]
  const void* laws = nullptr;                       ///< ElementLaw likewise, of a law that is not linear
  const int* row = nullptr;                  ///< by tile, of what follows; -1: no moved node near; null: none
  const unsigned char* perturbed = nullptr;  ///< [row][place]: elements touch moved nodes
  const int* shifted = nullptr;              ///< [row][section node]: index into `shifts`, or -1
  const LaneShifts<Real>* shifts = nullptr;  ///< the first one is zero

  Real damping = 0;  ///< factor of what is added to the displacements for damping
  StepConstants<Real> step;
  double gravity = 0;      ///< downwards, where the block spins [m/s2]
  double frame_angle = 0;  ///< of the frame of a spinning block [rad]

  /// Row of a tile in the tables of moved nodes; -1: none near, or no tile.
  constexpr int row_of(int number) const { return row == nullptr || number < 0 ? -1 : row[number]; }
  /// True where the elements of a quad, by its place, touch moved nodes of a row.
  constexpr bool perturbs(int of_row, std::int64_t place) const {
    return of_row >= 0 && perturbed[std::int64_t{of_row} * quads + place] != 0;
  }
  /// Shifts of a section node in a row.
  constexpr const LaneShifts<Real>& shift(int of_row, int section_node) const {
    const int entry = of_row < 0 ? 0 : shifted[std::int64_t{of_row} * section_nodes + section_node];
    return shifts[entry > 0 ? entry : 0];
  }
  constexpr int runs() const { return (tiles + run_tiles - 1) / run_tiles; }
  constexpr int teams() const { return list != nullptr ? listed : parts * marched.count; }
  constexpr int part_of(int team) const { return list != nullptr ? list[team] % parts : team % parts; }
  constexpr int run_of(int team) const {
    return list != nullptr ? list[team] / parts : (marched.first + team / parts) % runs();
  }
  constexpr bool leaves_out(int run) const {
    return (run - left_out.first + runs()) % runs() < left_out.count;
  }
};

/// Groups that move with their elements; tied ones, whose forces stay in MarchFields::force; those that move
/// but for some unknowns.
inline constexpr int kMoves = -1;
inline constexpr int kKeeps = -2;
inline constexpr int kHolds = -3;

/// Node fields on the device, of 3 * slots values in the order of dof(), and states of laws.
template <class Real, class U>
struct MarchFields {
  const U* u = nullptr;                ///< displacement [m]
  const Real* v = nullptr;             ///< velocity [m/s]
  const Real* added = nullptr;         ///< velocity or lag, times MarchBlock::damping; null: no damping
  const Real* inverse_mass = nullptr;  ///< by slot [1/kg]
  U* moved_u = nullptr;                ///< after the step
  Real* moved_v = nullptr;
  Real* force = nullptr;  ///< [N]
  /// By group of kLanes slots: where the host's groups have their forces in `host_force`; or kMoves, kKeeps,
  /// kHolds.
  const int* group_mark = nullptr;
  const unsigned char* held = nullptr;  ///< by slot of the last: a bit for each component that stays zero
  Real* host_force = nullptr;           ///< [group][component][lane] [N]
  const Real* state = nullptr;          ///< of the block: [tile][place][value][lane]
  Real* moved_state = nullptr;
};

}  // namespace tread
