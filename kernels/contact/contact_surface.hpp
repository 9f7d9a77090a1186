#pragma once
// The running surface of a swept block: exact profile curves plus interpolated nodal displacement.
// [theory.md, Surfaces]

#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/swept_block.hpp"
#include "kernels/contact/surface_body.hpp"

namespace tread {

/// Section curve of a running surface.
class SurfaceProfile {
 public:
  explicit SurfaceProfile(const Section& section);

  using Point = ProfileView::Point;
  ProfileView view() const {
    return {edges_.data(), edges(), bucket_.data(), static_cast<int>(bucket_.size()), bucket_width_};
  }

  int edges() const { return static_cast<int>(edges_.size()); }
  /// Section node by its ordinal along the surface, 0 ... edges().
  int node(int ordinal) const { return view().node(ordinal); }
  LineCell cell(int edge) const { return view().cell(edge); }

  /// Point at parameter eta in [0, 1] of an edge; straight between the nodes for facets.
  Point evaluate(int edge, double eta, SurfaceKind kind) const { return view().evaluate(edge, eta, kind); }

  /// q of the exact surface at p [m]; the last edge is prolonged beyond the surface.
  double q_at(double p) const;

  /// Edge whose span contains p (the first or last one beyond the ends); constant time.
  int edge_at(double p) const { return view().edge_at(p); }
  double first_p() const { return edges_.front().p[0]; }
  double last_p() const { return edges_.back().p[1]; }
  double edge_p(int edge, int end) const {
    return edges_[static_cast<std::size_t>(edge)].p[static_cast<std::size_t>(end)];
  }

 private:
  std::vector<ProfileEdge> edges_;
  std::vector<int> bucket_;
  double bucket_width_ = 1;
};

/// The cell of stations that starts at `station`, with its neighbours; not for the last station of an open
/// block.
LineCell station_cell(const SweptBlock& block, int station);

/// Station cell that contains a sweep coordinate; constant time by uniform buckets.
class StationFinder {
 public:
  explicit StationFinder(const SweptBlock& block);

  using Cell = StationLine::Cell;
  /// Closed blocks take any angle; open ones return station -1 outside.
  Cell find(double coordinate) const { return line().find(coordinate); }
  StationLine line() const;

 private:
  const SweptBlock* block_;
  std::vector<double> pitch_;
  std::vector<std::int64_t> slot_;  ///< of section node 0 in node fields
  std::vector<int> bucket_;
  double width_ = 1;
  double first_ = 0;
  double span_ = 0;
};

}  // namespace tread
