#include "kernels/contact/contact_surface.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace tread {

LineWeights line_weights(const LineCell& cell, double t, SurfaceKind kind) {
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

SurfaceProfile::SurfaceProfile(const Section& section) {
  double shortest = 1e30;
  for (const SurfaceEdge& source : section.surface) {
    Edge edge{};
    edge.node = source.node;
    for (std::size_t end = 0; end < 2; ++end) {
      edge.p[end] = section.p[static_cast<std::size_t>(source.node[end])];
      edge.q[end] = section.q[static_cast<std::size_t>(source.node[end])];
    }
    const double chord = std::hypot(edge.p[1] - edge.p[0], edge.q[1] - edge.q[0]);
    edge.chord = chord;
    for (std::size_t end = 0; end < 2; ++end) {
      edge.tp[end] = chord * source.tangent[end][0];
      edge.tq[end] = chord * source.tangent[end][1];
    }
    const double width = edge.p[1] - edge.p[0];
    if (!(width > 0))
      throw InputError(
          fmt::format("running surface: edge {} does not advance across the profile (from {:.6f} to "
                      "{:.6f} m); leave out vertical parts",
                      edges_.size(), edge.p[0], edge.p[1]));
    shortest = std::min(shortest, width);
    edges_.push_back(edge);
  }
  if (edges_.empty()) throw InputError("the section has no running surface for contact");
  const double span = last_p() - first_p();
  const int buckets = static_cast<int>(span / shortest) + 1;
  bucket_width_ = span / buckets;
  int edge = 0;
  for (int b = 0; b < buckets; ++b) {
    while (edge + 1 < edges() && edge_p(edge, 1) <= first_p() + b * bucket_width_) ++edge;
    bucket_.push_back(edge);
  }
}

LineCell SurfaceProfile::cell(int edge) const {
  const auto length = [&](int e) {
    return e >= 0 && e < edges() ? edges_[static_cast<std::size_t>(e)].chord : 0.0;
  };
  return {std::max(edge - 1, 0), edge,         edge + 1,        std::min(edge + 2, edges()),
          length(edge - 1),      length(edge), length(edge + 1)};
}

double SurfaceProfile::q_at(double p) const {
  const int edge = edge_at(p);
  double eta = (p - edge_p(edge, 0)) / (edge_p(edge, 1) - edge_p(edge, 0));
  for (int i = 0; i < 4; ++i) {
    const Point at = evaluate(edge, eta, SurfaceKind::exact);
    eta -= (at.p - p) / at.dp;
  }
  return evaluate(edge, eta, SurfaceKind::exact).q;
}

SurfaceProfile::Point SurfaceProfile::evaluate(int edge, double eta, SurfaceKind kind) const {
  const Edge& e = edges_[static_cast<std::size_t>(edge)];
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

int SurfaceProfile::edge_at(double p) const {
  const int last = static_cast<int>(bucket_.size()) - 1;
  const int b = std::clamp(static_cast<int>((p - first_p()) / bucket_width_), 0, last);
  int edge = bucket_[static_cast<std::size_t>(b)];
  while (edge + 1 < edges() && edge_p(edge, 1) < p) ++edge;
  return edge;
}

StationFinder::StationFinder(const SweptBlock& block) : block_(&block), first_(block.stations.front()) {
  double pitch = 1e30;
  span_ = 0;
  for (const Tile& tile : block.tiles) {
    const double p = block.classes[static_cast<std::size_t>(tile.pitch_class)].pitch;
    if (tile.elements > 0) pitch = std::min(pitch, p);
    span_ += tile.elements * p;
  }
  const int buckets = static_cast<int>(span_ / pitch) + 1;
  width_ = span_ / buckets;
  int station = 0;
  for (int b = 0; b < buckets; ++b) {
    while (station + 1 < block.station_count() &&
           block.stations[static_cast<std::size_t>(station + 1)] <= first_ + b * width_)
      ++station;
    bucket_.push_back(station);
  }
}

StationFinder::Cell StationFinder::find(double coordinate) const {
  double at = coordinate - first_;
  if (block_->closed) {
    at -= span_ * std::floor(at / span_);
    if (!(at >= 0 && at < span_)) at = 0;  // what is not finite too
  } else if (!(at >= 0 && at <= span_)) {
    return {-1, -1, 0, 0};
  }
  const int last = static_cast<int>(bucket_.size()) - 1;
  int station = bucket_[static_cast<std::size_t>(std::min(static_cast<int>(at / width_), last))];
  const int count = block_->station_count();
  const int cells = block_->closed ? count : count - 1;
  while (station + 1 < cells && block_->stations[static_cast<std::size_t>(station + 1)] - first_ <= at)
    ++station;
  return {station, station + 1 < count ? station + 1 : 0, block_->pitch(station),
          at - (block_->stations[static_cast<std::size_t>(station)] - first_)};
}

LineCell station_cell(const SweptBlock& block, int station) {
  const int count = block.station_count();
  const int second = station + 1 < count ? station + 1 : 0;
  const int before = station > 0 ? station - 1 : (block.closed ? count - 1 : 0);
  const int after = second + 1 < count ? second + 1 : (block.closed ? 0 : second);
  return {before,
          station,
          second,
          after,
          before == station ? 0 : block.pitch(before),
          block.pitch(station),
          after == second ? 0 : block.pitch(second)};
}

}  // namespace tread
