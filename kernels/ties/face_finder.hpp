#pragma once
// The face of a surface that is nearest to a point.

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/math/vec.hpp"

namespace tread {

/// Bilinear face; corners run about it.
using FaceCorners = std::array<Vec3, 4>;

double longest_edge(const FaceCorners& face);  ///< [m]
double face_area(const FaceCorners& face);     ///< [m2]

/// A point of a face.
struct FacePlace {
  std::ptrdiff_t face = -1;          ///< -1: no face is near
  std::array<double, 4> share = {};  ///< of the corners
  Vec3 at;                           ///< [m]
  double distance = 0;               ///< from the sought point [m]

  bool is_within(double reach) const { return face >= 0 && distance <= reach; }
};

class FaceFinder {
 public:
  /// `reach`: faces further away than this need not be found [m].
  FaceFinder(std::vector<FaceCorners> faces, double reach);

  /// The nearest point of the faces.
  FacePlace nearest(const Vec3& point) const;

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };
  Cell cell_of(const Vec3& point) const;

  std::vector<FaceCorners> faces_;
  double size_ = 1;  ///< of a cell [m]
  std::unordered_map<Cell, std::vector<std::size_t>, CellHash> cells_;
};

}  // namespace tread
