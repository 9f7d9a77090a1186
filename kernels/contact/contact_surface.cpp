#include "kernels/contact/contact_surface.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace tread {

SurfaceProfile::SurfaceProfile(const Section& section) {
  double shortest = 1e30;
  for (const SurfaceEdge& source : section.surface) {
    ProfileEdge edge{};
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

double SurfaceProfile::q_at(double p) const {
  const int edge = edge_at(p);
  double eta = (p - edge_p(edge, 0)) / (edge_p(edge, 1) - edge_p(edge, 0));
  for (int i = 0; i < 4; ++i) {
    const Point at = evaluate(edge, eta, SurfaceKind::exact);
    eta -= (at.p - p) / at.dp;
  }
  return evaluate(edge, eta, SurfaceKind::exact).q;
}

StationFinder::StationFinder(const SweptBlock& block) : block_(&block), first_(block.stations.front()) {
  for (int station = 0; station < block.station_count(); ++station) {
    pitch_.push_back(block.pitch(station));
    slot_.push_back(block.base + block.slot(0, station));
  }
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

StationLine StationFinder::line() const {
  return {block_->stations.data(),
          pitch_.data(),
          block_->station_count(),
          block_->closed,
          bucket_.data(),
          static_cast<int>(bucket_.size()),
          width_,
          first_,
          span_,
          slot_.data()};
}

LineCell station_cell(const SweptBlock& block, int station) {
  return station_cell(block.station_count(), block.closed, station,
                      [&block](int at) { return block.pitch(at); });
}

}  // namespace tread
