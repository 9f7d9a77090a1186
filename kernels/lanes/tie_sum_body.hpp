#pragma once
// Included by one source per instruction set; internal linkage keeps the versions apart.

#include "kernels/lanes/registers.hpp"
#include "kernels/lanes/tie_station_body.hpp"
#include "kernels/lanes/tie_sum.hpp"

namespace tread {
namespace {

using TieRegister = Lanes<double>::Register;

template <class Real>
TREAD_INLINE TieRegister pick(const Real* field, const std::int64_t* at) {
  TieRegister value;
  for (int l = 0; l < Lanes<double>::kWidth; ++l) value[l] = field[at[l]];
  return value;
}

/// Adds the share of a station in a section node's values.
template <class Real>
TREAD_INLINE void add_station(const StationLink& station, int lane, const Real* values,
                              TieRegister (&sum)[3]) {
  const auto share = load<TieRegister>(station.share + lane);
  const auto c = load<TieRegister>(station.cosine + lane);
  const auto s = load<TieRegister>(station.sine + lane);
  const TieRegister t = pick(values, station.at + lane);
  const TieRegister y = pick(values + kLanes, station.at + lane);
  const TieRegister r = pick(values + 2 * kLanes, station.at + lane);
  add_station_values(share, c, s, t, y, r, sum);
}

/// Values that the tile's lanes take from the other block's section nodes.
using TakenValues = double[kMostTiedNodes][3][kLanes];

constexpr std::ptrdiff_t kNodeValues = 3 * kLanes;
constexpr int kTieAhead = 4;  // nodes fetched ahead: they come from memory in an order that the processor
                              // does not foresee

/// Places, section nodes left out, of the other block's tiles from which a tile takes values.
struct OtherTiles {
  std::int64_t at[kLanes + 1];
  int count = 0;

  constexpr explicit OtherTiles(const TieTile& tile) {
    for (int lane = 0; lane < kLanes; ++lane)
      if (tile.stations[0].share[lane] > 0) add(tile.stations[0].at[lane]);
    add(tile.stations[tile.station_count - 1].at[kLanes - 1]);
  }
  constexpr void add(std::int64_t station) {
    constexpr std::int64_t kTileOfLane = ~std::int64_t{kLanes - 1};
    const std::int64_t begin = station & kTileOfLane;
    if (count == 0 || at[count - 1] != begin) at[count++] = begin;
  }
};

template <class Real>
TREAD_INLINE void prefetch_other(const TieTile& tile, const OtherTiles& tiles, int other, const Real* field) {
  if (other >= tile.other_count) return;
  for (int i = 0; i < tiles.count; ++i)
    prefetch_vector<0>(field + tiles.at[i] + tile.others[other] * kNodeValues);
}

template <class Real>
TREAD_INLINE void prefetch_own(const TieTile& tile, int node, const Real* field) {
  if (node < tile.node_count) prefetch_vector<1>(field + tile.own + tile.nodes[node].node * kNodeValues);
}

template <class Real>
TREAD_INLINE void take(const TieTile& tile, const Real* field, TakenValues& taken) {
  const OtherTiles tiles(tile);
  for (int i = 0; i < kTieAhead; ++i) prefetch_other(tile, tiles, i, field);
  for (int i = 0; i < tile.other_count; ++i) {
    prefetch_other(tile, tiles, i + kTieAhead, field);
    const Real* values = field + tile.others[i] * kNodeValues;
    for (int lane = 0; lane < kLanes; lane += Lanes<double>::kWidth) {
      TieRegister sum[3] = {};
      for (int k = 0; k < tile.station_count; ++k) add_station(tile.stations[k], lane, values, sum);
      for (int c = 0; c < 3; ++c) store(taken[i][c] + lane, sum[c]);
    }
  }
}

template <class Real>
void tie_sum(const TieTile& tile, bool add, Real* field) {
  using Stored = typename Vector<Real, Lanes<double>::kWidth>::type;
  TakenValues taken;
  for (int n = 0; n < kTieAhead; ++n) prefetch_own(tile, n, field);
  take(tile, field, taken);
  for (int n = 0; n < tile.node_count; ++n) {
    prefetch_own(tile, n + kTieAhead, field);
    const LinkedNode& own = tile.nodes[n];
    for (int lane = 0; lane < kLanes; lane += Lanes<double>::kWidth) {
      TieRegister sum[3] = {};
      for (int link = own.first; link < own.last; ++link)
        for (int c = 0; c < 3; ++c)
          sum[c] +=
              product(tile.links[link].share, load<TieRegister>(taken[tile.links[link].other][c] + lane));
      Real* at = field + tile.own + own.node * kNodeValues + lane;
      for (int c = 0; c < 3; ++c, at += kLanes) {
        if (add) sum[c] += converted<TieRegister>(load<Stored>(at));
        store(at, converted<Stored>(sum[c]));
      }
    }
  }
}

}  // namespace
}  // namespace tread
