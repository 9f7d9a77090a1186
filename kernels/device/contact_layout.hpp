#pragma once
// Arrays and bounds of the contact of a step, as plain data in the memory of a device.
// [docs/records/device.md]

#include <cstdint>

#include "core/body_frame.hpp"
#include "core/corrugation.hpp"
#include "core/mesh/node_field.hpp"
#include "kernels/contact/contact_point.hpp"
#include "kernels/contact/friction/point_response.hpp"
#include "kernels/contact/patch_nodes.hpp"
#include "kernels/contact/search_body.hpp"
#include "kernels/lanes/patch_loop.hpp"

namespace tread {

/// A corrugated rail under a smooth wheel.
struct CorrugatedDepths {
  CorrugationView corrugation;

  TREAD_BODY double rail(double x, double y) const { return corrugation.depth(x, y); }
  TREAD_BODY bool wheel_smooth() const { return true; }
  TREAD_BODY SurfaceDepth wheel(double /*angle*/, double /*y*/) const { return {}; }
  TREAD_BODY double wheel_radius() const { return 0; }
};

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

/// Integration points of the window, before the patch is made of them.
struct Candidates {
  ContactPoint* point = nullptr;
  int* kept = nullptr;    ///< nonzero for those of the patch
  int* place = nullptr;   ///< in the patch, of those
  double* gap = nullptr;  ///< [m]
};

/// Nodes and cells of the patch. A cell: points that the same 16 nodes of a body carry. [PatchCells]
struct PatchLinks {
  /// Entries: the rail's support of every point, then the wheel's.
  int* cell = nullptr;              ///< by entry
  PatchWeights* weights = nullptr;  ///< by entry
  int* first_entry = nullptr;       ///< by cell
  int* first_listed = nullptr;      ///< by cell and one more, into listed
  int* listed = nullptr;            ///< entries by cell
  int* cell_node = nullptr;         ///< kCellNodes by cell
  std::int64_t* slot = nullptr;     ///< by node
  double* basis = nullptr;          ///< by node: cosine and sine of its angle
  int* of_wheel = nullptr;          ///< by node
  int* first_term = nullptr;        ///< by node and one more, into term
  int* term = nullptr;              ///< places in the cells' sums, by node
  int* at_slot = nullptr;           ///< by slot; the largest int between two uses
  int* flag = nullptr;              ///< by entry or place in the cells' sums
  int* number = nullptr;            ///< likewise
};

/// Vectors of the solution. [PatchSolver]
struct PatchVectors {
  PointTile* tile = nullptr;
  PatchVector* free = nullptr;      ///< by point
  PatchVector* impulse = nullptr;   ///< by point
  PatchVector* sum = nullptr;       ///< by entry
  PatchVector* change = nullptr;    ///< by node
  PatchVector* cell_sum = nullptr;  ///< kCellNodes by cell
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
  double damping_work;     ///< of the step [J]
  int points;              ///< of the patch
  int at_the_end;          ///< nonzero where one under pressure lies at the end of the searched surface
};

struct ContactTask {
  SurfacePairBody<CorrugatedDepths> surfaces;
  const FaceQuadrature::Point* quadrature = nullptr;
  PointSprings springs;
  SearchEnd end;
  const double* inverse_mass = nullptr;  ///< by slot [1/kg]

  FaceWindow window;
  SearchBounds bounds;
  double dt = 0;    ///< [s]
  BodyFrame wheel;  ///< at the start of the step

  NodeField u;  ///< at the start of the step (search), after the motion without contact (tractions)
  NodeField v;

  PointHistory* history = nullptr;  ///< by integration point of the whole rail
  double* wake_time = nullptr;      ///< by face of the whole rail [s]
  Candidates candidates;
  ContactPoint* point = nullptr;  ///< of the patch
  PatchLinks links;
  PatchVectors vectors;
  RecordView record;
  PatchResult* result = nullptr;
};

}  // namespace tread
