#pragma once
// Arrays and bounds of the contact of a step, as plain data in the memory of a device.
// [docs/records/device.md]

#include <cstdint>

#include "core/body_frame.hpp"
#include "core/mesh/node_field.hpp"
#include "kernels/contact/contact_point.hpp"
#include "kernels/contact/friction/point_response.hpp"
#include "kernels/contact/patch_nodes.hpp"
#include "kernels/contact/search_body.hpp"
#include "kernels/lanes/patch_loop.hpp"

namespace tread {

/// Rail faces about the wheel: stations [first_station, first_station + stations), edges likewise.
struct FaceWindow {
  int first_station = 0, stations = 0;
  int first_edge = 0, edges = 0;
  int rail_edges = 0;  ///< of the rail's profile
  int points = 0;      ///< of a face

  std::int64_t count() const { return std::int64_t{stations} * edges * points; }
  /// Number among all of the rail's faces of the i-th face of the window.
  TREAD_BODY std::int64_t face(int i) const {
    return std::int64_t{first_station + i / edges} * rail_edges + first_edge + i % edges;
  }
};

/// Integration points of the window, and the patch that is made of them.
struct Candidates {
  ContactPoint* point = nullptr;
  int* kept = nullptr;    ///< nonzero for those of the patch
  double* gap = nullptr;  ///< [m]
  int* origin = nullptr;  ///< by point of the patch: candidate
};

/// Points of the patch, where the search left them.
struct PatchPoints {
  ContactPoint* candidate = nullptr;
  const int* origin = nullptr;  ///< Candidates::origin

  TREAD_BODY ContactPoint& operator[](int i) const { return candidate[origin[i]]; }
};

struct PatchNode {
  std::int64_t slot;
  double cosine, sine;  ///< of the angle of its basis
  int of_wheel;
};

/// Nodes and cells of the patch. A cell: points that the same 16 nodes of a body carry. An entry: the rail's
/// support of every point, then the wheel's. [PatchCells]
struct PatchLinks {
  int* cell = nullptr;             ///< by entry
  int* first_entry = nullptr;      ///< by cell and one more, into entry
  int* entry = nullptr;            ///< cell by cell
  int* cell_node = nullptr;        ///< kCellNodes by cell
  PatchNode* node = nullptr;       ///< by node
  double* inverse_mass = nullptr;  ///< by node [1/kg]
  int* first_term = nullptr;       ///< by node and one more, into term
  int* term = nullptr;             ///< by node: places in cell_node
  // While cells and nodes are found: a table of keys, and lists.
  int* known = nullptr;   ///< by place in the table: key
  int* first = nullptr;   ///< by place in the table: first item of the key
  int* number = nullptr;  ///< by place in the table: of the key
  int* mark = nullptr;    ///< by item: place in the table
  int* sample = nullptr;  ///< by cell: its first entry
  int* nth = nullptr;     ///< by item: others of its owner that came before
  int* item = nullptr;    ///< by owner
  int* owned = nullptr;   ///< by owner: number of items
};

/// kLanes points of a team. Consecutive points lie in different banks, in two of these too.
struct TeamTile : PointTile {
  double free[3][kLanes];  ///< velocity without contact, Cartesian [m/s]
};

/// A point's support in one body. Its size lets threads of consecutive points read from different banks.
struct TeamSupport {
  PatchWeights weights;
  int node[kCellNodes];
  double mobility;  ///< sum over the nodes of the square of the weight times the inverse mass [1/kg]
};

/// A point in the sum of a node.
struct NodeItem {
  double weight;  ///< of the node in the point, times its inverse mass [1/kg]
  int point;
};

/// Values that record and result take of a point.
struct PointOutcome {
  static constexpr int kSums = 5;
  double pressure;         ///< [Pa]
  Traction shear;          ///< [Pa]
  double frictional_work;  ///< [J/m2]
  double share[4];         ///< area at the face's corners [m2]
  double sum[kSums];       ///< force on the rail [N], work of friction and loss [J]
};

/// Parts of the sum of a node, taken by threads of their own, and the room for them.
inline constexpr int kNodeParts = 8;
inline constexpr int kPartStride = 3 * kNodeParts + 1;  ///< odd, for the banks
/// Parts of the sums over all points.
inline constexpr int kPatchParts = 32;
/// Teams of a patch at most.
inline constexpr int kMostTeams = 16;
/// Teams of a patch in a card's code for this architecture, 900 for 9.0. Older code knows no clusters, on
/// newer cards either.
constexpr int teams_of_code(int architecture) {
  return architecture >= 900 ? 8 : 1;
}

struct PatchCounts {
  int points, nodes;
  int at_the_end;    ///< points under pressure at the end of the searched surface
  double unsettled;  ///< PatchSolver::unsettled()
};

/// Input of the solution, and its arrays where the memory of the teams is too small. [PatchSolution]
struct PatchVectors {
  TeamSupport* support = nullptr;  ///< 2 by point: of the rail, of the wheel
  NodeItem* item = nullptr;        ///< node by node
  int* first_item = nullptr;       ///< by node and one more
  int* item_of_term = nullptr;     ///< by place in PatchLinks::term
  double* impulse = nullptr;       ///< 3 by point
  double* change = nullptr;        ///< 3 by node
  double* part = nullptr;          ///< kPartStride by node
  double* sum = nullptr;           ///< 6 by point
  TeamTile* tile = nullptr;
  PointOutcome* outcome = nullptr;  ///< by point
  double* total = nullptr;          ///< PointOutcome::kSums by part of the points
};

/// Largest stresses and frictional work of a passage, [station][row]. [SurfaceFields]
struct RecordView {
  double* max_pressure = nullptr;
  double* max_shear = nullptr;
  double* frictional_work = nullptr;
  const double* length = nullptr;  ///< of the rail that a station stands for [m]
  const double* width = nullptr;   ///< of the profile that a row stands for [m]
  int rows = 0;
  int* first_point = nullptr;  ///< by face of the window and one more
};

/// Outcome of a step for the host.
struct PatchResult {
  Vec3 force_on_rail;      ///< [N]
  double frictional_work;  ///< of the step [J]
  double contact_loss;     ///< of the step [J]
  int points;              ///< of the patch
  int at_the_end;          ///< nonzero where one under pressure lies at the end of the searched surface
  double unsettled;        ///< PatchSolver::unsettled()
};

struct ContactTask {
  SurfacePairBody surfaces;
  const FaceQuadrature::Point* quadrature = nullptr;
  PointSprings springs;
  SearchEnd end;
  const double* mass = nullptr;  ///< by slot [kg]

  FaceWindow window;
  SearchBounds bounds;
  double dt = 0;    ///< [s]
  BodyFrame wheel;  ///< at the start of the step

  NodeField u;  ///< at the start of the step (search), after the motion without contact (tractions)
  NodeField v;

  PointHistory* history = nullptr;  ///< by integration point of the whole rail
  double* wake_time = nullptr;      ///< by face of the whole rail [s]
  Candidates candidates;
  ContactPoint* point = nullptr;  ///< of the patch, for the host
  PatchLinks links;
  PatchCounts* counts = nullptr;
  PatchVectors vectors;
  RecordView record;
  PatchResult* result = nullptr;
};

}  // namespace tread
