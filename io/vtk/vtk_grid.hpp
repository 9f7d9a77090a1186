#pragma once
// The points and cells of a mesh in VTK's numbering.

#include <cstdint>
#include <vector>

#include "core/math/vec.hpp"
#include "core/mesh/swept_block.hpp"

namespace tread {

/// Place of a block's body: its frame is turned by `angle` about y, then moved to `origin`.
struct Placement {
  Vec3 origin;       ///< [m]
  double angle = 0;  ///< [rad]
};

/// Cells shown of a mesh: its elements as hexahedra, or the outer faces of its blocks as quadrilaterals whose
/// normals point outwards.
enum class VtkCells { elements, faces };

struct VtkGrid {
  /// A node of a block; or of a body, a part of the mesh behind its blocks, whose nodes have no station.
  struct Point {
    int block, node, station;
  };
  /// An element, or the element behind a face. Of a body `quad` is the element's index.
  struct Cell {
    int block, quad, station;
  };

  VtkCells kind = VtkCells::elements;
  std::vector<Point> points;               ///< points that cells use; blocks share none
  std::vector<Cell> cells;                 ///< cells block by block
  std::vector<std::int64_t> connectivity;  ///< [cell][corner]: index in `points`

  int corners() const { return kind == VtkCells::elements ? 8 : 4; }
};

/// Grid of the given kind of cells, for every block and body of the mesh. Faces by which blocks are tied to
/// one another count as outer ones.
VtkGrid make_vtk_grid(const Mesh& mesh, VtkCells kind);

/// Position of a point in the frame of its body [m].
Vec3 position(const Mesh& mesh, const VtkGrid::Point& point);

/// Position of a point of an undeformed body [m].
Vec3 placed(const Placement& placement, const Vec3& at);

}  // namespace tread
