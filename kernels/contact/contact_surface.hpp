#pragma once
// The running surface of a swept block: exact profile curves plus interpolated nodal displacement.
// [theory.md, Surfaces]

#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/swept_block.hpp"

namespace tread {

/// "exact": cubic Hermite profile curves, true circles and the corrugation's formula carry the geometry,
/// cubics through the nodal values the displacement. "facets": the nodes' bilinear faces carry both.
enum class SurfaceKind { exact, facets };

/// Interpolation in one cell of a line of nodes: weights of the four nodes about it (ordinals along the line;
/// those without weight repeat a neighbour).
struct LineWeights {
  std::array<int, 4> ordinal;
  std::array<double, 4> value;
  std::array<double, 4> slope;  ///< derivative by the cell's fraction
};

/// A cell of a line of nodes: its nodes' ordinals, its length and those of its neighbours (0: there is none).
struct LineCell {
  int before, first, second, after;
  double length_before, length, length_after;
};

/// exact: the C1 cubic whose slopes at nodes are those of the parabola through three nodes: reproduces
/// quadratics, so a flattened circle stays flat between nodes. facets: linear.
LineWeights line_weights(const LineCell& cell, double fraction, SurfaceKind kind);

/// Section curve of a running surface.
class SurfaceProfile {
 public:
  explicit SurfaceProfile(const Section& section);

  struct Point {
    double p, q;    ///< [m]
    double dp, dq;  ///< derivative by the edge parameter [m]
  };

  int edges() const { return static_cast<int>(edges_.size()); }
  /// Section node by its ordinal along the surface, 0 ... edges().
  int node(int ordinal) const {
    return ordinal < edges() ? edges_[static_cast<std::size_t>(ordinal)].node[0] : edges_.back().node[1];
  }
  LineCell cell(int edge) const;

  /// Point at parameter eta in [0, 1] of an edge; straight between the nodes for facets.
  Point evaluate(int edge, double eta, SurfaceKind kind) const;

  /// q of the exact surface at p [m]; the last edge is prolonged beyond the surface.
  double q_at(double p) const;

  /// Edge whose span contains p (the first or last one beyond the ends); constant time.
  int edge_at(double p) const;
  double first_p() const { return edges_.front().p[0]; }
  double last_p() const { return edges_.back().p[1]; }
  double edge_p(int edge, int end) const {
    return edges_[static_cast<std::size_t>(edge)].p[static_cast<std::size_t>(end)];
  }

 private:
  struct Edge {
    std::array<int, 2> node;
    std::array<double, 2> p, q, tp, tq;  ///< ends and Hermite tangents, times the chord length
    double chord;
  };
  std::vector<Edge> edges_;
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

  struct Cell {
    int station;      ///< first station
    int next;         ///< second station
    double pitch;     ///< [m or rad]
    double distance;  ///< from the first station [m or rad]
  };
  /// Closed blocks take any angle; open ones return station -1 outside.
  Cell find(double coordinate) const;

 private:
  const SweptBlock* block_;
  std::vector<int> bucket_;
  double width_ = 1;
  double first_ = 0;
  double span_ = 0;
};

}  // namespace tread
