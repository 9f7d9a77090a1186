#pragma once
// Integration points of a rail face.

#include <array>
#include <vector>

namespace tread {

/// Gauss points of a unit face: `per_line` lines of points across the rail, `per_line` points in each.
class FaceQuadrature {
 public:
  /// One to four points per direction; InputError otherwise.
  explicit FaceQuadrature(int per_line);

  struct Point {
    double along, across;  ///< on [0, 1]
    double weight;         ///< share of the face
  };

  int size() const { return static_cast<int>(points_.size()); }
  int per_line() const { return static_cast<int>(line_.size()); }
  const Point& point(int k) const { return points_[static_cast<std::size_t>(k)]; }
  /// Place on [0, 1] of the i-th point of a line.
  double place(int i) const { return line_[static_cast<std::size_t>(i)][0]; }
  /// Share of the face's length that the i-th line stands for.
  double weight(int i) const { return line_[static_cast<std::size_t>(i)][1]; }

 private:
  std::vector<std::array<double, 2>> line_;
  std::vector<Point> points_;
};

}  // namespace tread
