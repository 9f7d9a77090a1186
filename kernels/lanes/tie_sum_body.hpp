#pragma once
// Included by one source per instruction set; internal linkage keeps the versions apart.

#include "kernels/lanes/registers.hpp"
#include "kernels/lanes/tie_sum.hpp"
#include "kernels/node_motion_body.hpp"

namespace tread {
namespace {

using TieRegister = Lanes<double>::Register;

template <class Real>
TREAD_INLINE TieRegister pick(const Real* field, const std::int64_t* at) {
  TieRegister value;
  for (int l = 0; l < Lanes<double>::kWidth; ++l) value[l] = field[at[l]];
  return value;
}

template <class Real>
TREAD_INLINE void add_link(const StationLink& station, int lane, const NodeLink& link, const Real* field,
                           TieRegister (&sum)[3]) {
  const auto c = load<TieRegister>(station.cosine + lane);
  const auto s = load<TieRegister>(station.sine + lane);
  const TieRegister weight = link.share * load<TieRegister>(station.share + lane);
  const Real* values = field + static_cast<std::ptrdiff_t>(link.node) * 3 * kLanes;
  const TieRegister t = pick(values, station.at + lane);
  const TieRegister y = pick(values + kLanes, station.at + lane);
  const TieRegister r = pick(values + 2 * kLanes, station.at + lane);
  sum[0] += product(weight, product(c, t) - product(s, r));
  sum[1] += product(weight, y);
  sum[2] += product(weight, product(s, t) + product(c, r));
}

/// A node's own values and what it takes from the outermost stations: from memory, in an order that the
/// processor does not foresee.
template <class Real>
TREAD_INLINE void prefetch_node(const TieTile& tile, const LinkedNode& own, const Real* field) {
  constexpr std::ptrdiff_t kValues = 3 * kLanes;
  constexpr std::int64_t kTileOfLane = ~std::int64_t{kLanes - 1};
  prefetch_vector<0>(field + tile.own + own.node * kValues);
  const std::int64_t first = tile.stations[0].at[0] & kTileOfLane;
  const std::int64_t last = tile.stations[tile.station_count - 1].at[kLanes - 1] & kTileOfLane;
  for (int link = own.first; link < own.last; ++link) {
    const std::ptrdiff_t node = tile.links[link].node * kValues;
    prefetch_vector<0>(field + first + node);
    if (last != first) prefetch_vector<0>(field + last + node);
  }
}

template <class Real>
void tie_sum(const TieTile& tile, bool add, Real* field) {
  using Stored = typename Vector<Real, Lanes<double>::kWidth>::type;
  constexpr int kAhead = 4;
  for (int n = 0; n < tile.node_count; ++n) {
    if (n + kAhead < tile.node_count) prefetch_node(tile, tile.nodes[n + kAhead], field);
    const LinkedNode& own = tile.nodes[n];
    for (int lane = 0; lane < kLanes; lane += Lanes<double>::kWidth) {
      TieRegister sum[3] = {};
      for (int k = 0; k < tile.station_count; ++k)
        for (int link = own.first; link < own.last; ++link)
          add_link(tile.stations[k], lane, tile.links[link], field, sum);
      Real* at = field + tile.own + static_cast<std::ptrdiff_t>(own.node) * 3 * kLanes + lane;
      for (int i = 0; i < 3; ++i, at += kLanes) {
        if (add) sum[i] += converted<TieRegister>(load<Stored>(at));
        store(at, converted<Stored>(sum[i]));
      }
    }
  }
}

}  // namespace
}  // namespace tread
