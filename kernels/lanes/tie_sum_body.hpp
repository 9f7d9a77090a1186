#pragma once
// Included by one source per instruction set; internal linkage keeps the versions apart.

#include "kernels/lanes/registers.hpp"
#include "kernels/lanes/tie_sum.hpp"
#include "kernels/node_motion_body.hpp"

namespace tread {
namespace {

template <class V, class Real>
TREAD_INLINE V pick(const Real* field, const std::int64_t* at) {
  V value;
  for (int l = 0; l < static_cast<int>(sizeof(V) / sizeof(Real)); ++l) value[l] = field[at[l]];
  return value;
}

template <class V, class Real>
TREAD_INLINE void add_link(const StationLink<Real>& station, int lane, const NodeLink<Real>& link,
                           const Real* field, V (&sum)[3]) {
  const V c = load<V>(station.cosine + lane);
  const V s = load<V>(station.sine + lane);
  const V weight = link.share * load<V>(station.share + lane);
  const Real* values = field + static_cast<std::ptrdiff_t>(link.node) * 3 * kLanes;
  const V t = pick<V>(values, station.at + lane);
  const V y = pick<V>(values + kLanes, station.at + lane);
  const V r = pick<V>(values + 2 * kLanes, station.at + lane);
  sum[0] += product(weight, product(c, t) - product(s, r));
  sum[1] += product(weight, y);
  sum[2] += product(weight, product(s, t) + product(c, r));
}

template <class Real>
void tie_sum(const TieTile<Real>& tile, bool add, Real* field) {
  using Register = typename Lanes<Real>::Register;
  for (const LinkedNode* own = tile.nodes; own != tile.nodes + tile.node_count; ++own)
    for (int lane = 0; lane < kLanes; lane += Lanes<Real>::kWidth) {
      Register sum[3] = {};
      for (int k = 0; k < tile.station_count; ++k)
        for (int link = own->first; link < own->last; ++link)
          add_link(tile.stations[k], lane, tile.links[link], field, sum);
      Real* at = field + tile.own + static_cast<std::ptrdiff_t>(own->node) * 3 * kLanes + lane;
      for (int i = 0; i < 3; ++i, at += kLanes) store(at, add ? load<Register>(at) + sum[i] : sum[i]);
    }
}

}  // namespace
}  // namespace tread
