#pragma once
// Running surfaces as plain data, and their points, for one index; on a device too. [theory.md, Surfaces]

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/inline.hpp"
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
TREAD_BODY LineWeights line_weights(const LineCell& cell, double t, SurfaceKind kind) {
  LineWeights w{{cell.before, cell.first, cell.second, cell.after}, {0, 1 - t, t, 0}, {0, -1, 1, 0}};
  if (kind == SurfaceKind::facets) return w;
  const double r = 1 - t;
  // Hermite basis: values at the ends, then slopes times the cell's length.
  const std::array<double, 4> basis = {r * r * (1 + 2 * t), t * t * (1 + 2 * r), t * r * r, -t * t * r};
  const std::array<double, 4> derivative = {-6 * t * r, 6 * t * r, r * (1 - 3 * t), t * (3 * t - 2)};
  const double h = cell.length;
  // Slopes times h as weights of the four nodes.
  std::array<double, 4> start = {0, -1, 1, 0};
  std::array<double, 4> end = {0, -1, 1, 0};
  if (cell.length_before > 0) {
    const double a =
        h / cell.length_before;  // parabola: the slopes of both cells, weighted by the other's length
    start = {-a * a / (1 + a), (a * a - 1) / (1 + a), 1 / (1 + a), 0};
  }
  if (cell.length_after > 0) {
    const double a = h / cell.length_after;
    end = {0, -1 / (1 + a), (1 - a * a) / (1 + a), a * a / (1 + a)};
  }
  for (std::size_t k = 0; k < 4; ++k) {
    w.value[k] = basis[2] * start[k] + basis[3] * end[k];
    w.slope[k] = derivative[2] * start[k] + derivative[3] * end[k];
  }
  for (std::size_t k = 0; k < 2; ++k) {
    w.value[k + 1] += basis[k];
    w.slope[k + 1] += derivative[k];
  }
  return w;
}

/// An edge of a section's running surface.
struct ProfileEdge {
  std::array<int, 2> node;
  std::array<double, 2> p, q, tp, tq;  ///< ends and Hermite tangents, times the chord length
  double chord;
};

/// Section curve of a running surface; a view.
struct ProfileView {
  const ProfileEdge* edge = nullptr;
  int edges = 0;
  const int* bucket = nullptr;  ///< first edge of each bucket
  int buckets = 0;
  double bucket_width = 1;  ///< [m]

  struct Point {
    double p, q;    ///< [m]
    double dp, dq;  ///< derivative by the edge parameter [m]
  };

  TREAD_BODY int node(int ordinal) const {
    return ordinal < edges ? edge[ordinal].node[0] : edge[edges - 1].node[1];
  }
  TREAD_BODY double first_p() const { return edge[0].p[0]; }
  TREAD_BODY double last_p() const { return edge[edges - 1].p[1]; }
  TREAD_BODY double edge_p(int of, int end) const { return edge[of].p[static_cast<std::size_t>(end)]; }

  TREAD_BODY double chord(int of) const { return of >= 0 && of < edges ? edge[of].chord : 0.0; }
  TREAD_BODY LineCell cell(int of) const {
    return {of > 0 ? of - 1 : 0, of,        of + 1,       of + 2 < edges ? of + 2 : edges,
            chord(of - 1),       chord(of), chord(of + 1)};
  }

  /// Point at parameter eta in [0, 1] of an edge; straight between the nodes for facets.
  TREAD_BODY Point evaluate(int of, double eta, SurfaceKind kind) const {
    const ProfileEdge& e = edge[of];
    if (kind == SurfaceKind::facets) {
      const double dp = e.p[1] - e.p[0];
      const double dq = e.q[1] - e.q[0];
      return {e.p[0] + eta * dp, e.q[0] + eta * dq, dp, dq};
    }
    const double r = 1 - eta;
    const std::array<double, 4> h = {r * r * (1 + 2 * eta), eta * r * r, eta * eta * (1 + 2 * r),
                                     -eta * eta * r};
    const std::array<double, 4> d = {-6 * eta * r, r * (1 - 3 * eta), 6 * eta * r, eta * (3 * eta - 2)};
    return {h[0] * e.p[0] + h[1] * e.tp[0] + h[2] * e.p[1] + h[3] * e.tp[1],
            h[0] * e.q[0] + h[1] * e.tq[0] + h[2] * e.q[1] + h[3] * e.tq[1],
            d[0] * e.p[0] + d[1] * e.tp[0] + d[2] * e.p[1] + d[3] * e.tp[1],
            d[0] * e.q[0] + d[1] * e.tq[0] + d[2] * e.q[1] + d[3] * e.tq[1]};
  }

  /// Edge whose span contains p (the first or last one beyond the ends); constant time.
  TREAD_BODY int edge_at(double p) const {
    const int of_bucket = static_cast<int>((p - first_p()) / bucket_width);
    int at = bucket[of_bucket < 0 ? 0 : (of_bucket < buckets ? of_bucket : buckets - 1)];
    while (at + 1 < edges && edge[at].p[1] < p) ++at;
    return at;
  }
};

/// Stations of a swept block; a view.
struct StationLine {
  const double* stations = nullptr;  ///< [m or rad]
  const double* pitches = nullptr;   ///< of the cell that starts at a station [m or rad]
  int count = 0;
  bool closed = false;
  const int* bucket = nullptr;  ///< first station of each bucket
  int buckets = 0;
  double bucket_width = 1;             ///< [m or rad]
  double first = 0;                    ///< [m or rad]
  double span = 0;                     ///< [m or rad]
  const std::int64_t* slot = nullptr;  ///< of section node 0 in node fields, by station

  int station_count() const { return count; }
  TREAD_BODY double pitch(int station) const { return pitches[station]; }

  struct Cell {
    int station;      ///< first station
    int next;         ///< second station
    double pitch;     ///< [m or rad]
    double distance;  ///< from the first station [m or rad]
  };
  /// Closed blocks take any angle; open ones return station -1 outside, by more than rounding.
  TREAD_BODY Cell find(double coordinate) const {
    constexpr double kRounding = 1e-10;  // of the span, which is a sum of pitches
    double at = coordinate - first;
    if (closed) {
      at -= span * std::floor(at / span);
      if (!(at >= 0 && at < span)) at = 0;  // what is not finite too
    } else if (!(at >= -kRounding * span && at <= (1 + kRounding) * span)) {
      return {-1, -1, 0, 0};
    }
    const int of_bucket = static_cast<int>(at / bucket_width);
    int station = bucket[of_bucket < buckets - 1 ? of_bucket : buckets - 1];
    const int cells = closed ? count : count - 1;
    while (station + 1 < cells && stations[station + 1] - first <= at) ++station;
    return {station, station + 1 < count ? station + 1 : 0, pitches[station],
            at - (stations[station] - first)};
  }
};

/// The cell of stations that starts at `station`, with its neighbours; not for the last station of an open
/// line. `pitch`: pitch(station).
template <class Pitch>
TREAD_BODY LineCell station_cell(int count, bool closed, int station, const Pitch& pitch) {
  const int second = station + 1 < count ? station + 1 : 0;
  const int before = station > 0 ? station - 1 : (closed ? count - 1 : 0);
  const int after = second + 1 < count ? second + 1 : (closed ? 0 : second);
  return {before,
          station,
          second,
          after,
          before == station ? 0 : pitch(before),
          pitch(station),
          after == second ? 0 : pitch(second)};
}

TREAD_BODY LineCell station_cell(const StationLine& line, int station) {
  const double* const pitches = line.pitches;
  return station_cell(line.count, line.closed, station, [pitches](int at) { return pitches[at]; });
}

}  // namespace tread
