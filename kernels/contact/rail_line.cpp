#include "kernels/contact/rail_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tread {

RailLine::RailLine(const SweptBlock& rail, double y)
    : x_(rail.stations), at_rest_(x_.size(), 0.0), rolling_(x_.size(), 0.0) {
  const auto distance = [&](int node) {
    return std::abs(rail.section.p[static_cast<std::size_t>(node)] - y);
  };
  int nearest = rail.section.surface.front().node[0];
  for (const SurfaceEdge& edge : rail.section.surface)
    for (const int node : edge.node)
      if (distance(node) < distance(nearest)) nearest = node;
  for (int station = 0; station < rail.station_count(); ++station)
    slot_.push_back(rail.base + rail.slot(nearest, station));
}

std::vector<double> RailLine::rise(ConstNodeField displacement) const {
  std::vector<double> values(slot_.size());
  for (std::size_t i = 0; i < slot_.size(); ++i) values[i] = displacement.at(slot_[i]).z;
  return values;
}

void RailLine::note_static(std::span<const double> at_rest) {
  std::ranges::copy(at_rest.first(std::min(at_rest.size(), at_rest_.size())), at_rest_.begin());
}

void RailLine::note_rolling(ConstNodeField displacement, double wheel_x) {
  for (std::size_t i = 0; i < slot_.size(); ++i) rolling_[i] = displacement.at(slot_[i]).z;
  wheel_x_ = wheel_x;
}

}  // namespace tread
