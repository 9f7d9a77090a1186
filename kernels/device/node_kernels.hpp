#pragma once
// Kernels that take one value or node a thread, as functions of its number, for every kind of device.

#include "kernels/device/field_kernels.hpp"
#include "kernels/device/march_node.hpp"
#include "kernels/lanes/tie_station_body.hpp"
#include "kernels/material/branch_lag.hpp"

namespace tread {

inline constexpr std::int64_t kGroupOfValues = 3 * kLanes;  ///< values of a group in a vector field

/// FieldKernels::place
template <class Real, class U>
struct PlaceGroups {
  GroupValues<Real, U> values;
  U* u;
  Real* v;

  std::int64_t count() const { return kGroupOfValues * values.count; }
  TREAD_INLINE void operator()(std::int64_t i) const {
    const std::int64_t at = values.groups[i / kGroupOfValues] * kGroupOfValues + i % kGroupOfValues;
    u[at] = values.u[i];
    v[at] = values.v[i];
  }
};

/// FieldKernels::take
template <class Real, class U>
struct TakeGroups {
  GroupValues<Real, U> values;
  const U* u;
  const Real* v;

  std::int64_t count() const { return kGroupOfValues * values.count; }
  TREAD_INLINE void operator()(std::int64_t i) const {
    const std::int64_t at = values.groups[i / kGroupOfValues] * kGroupOfValues + i % kGroupOfValues;
    values.u[i] = u[at];
    values.v[i] = v[at];
  }
};

/// FieldKernels::anchor
template <class Real, class U>
struct AnchorNodes {
  AnchoredNodes<Real> nodes;
  U* u;
  Real* v;

  std::int64_t count() const { return nodes.count(); }
  TREAD_BODY void operator()(std::int64_t i) const {
    const int lane = static_cast<int>(i % kLanes);
    const std::int64_t group = i / kLanes;
    const Tile& tile = nodes.block.tile[group / nodes.block.section_nodes];
    if (lane >= tile.stations) return;
    const auto node = group % nodes.block.section_nodes;
    const std::int64_t at = (nodes.block.first_group + group) * kGroupOfValues + lane;
    Vec3 displacement;
    Vec3 velocity;
    for (int c = 0; c < 3; ++c) {
      displacement[c] = u[at + c * kLanes];
      velocity[c] = v[at + c * kLanes];
    }
    const Anchoring::Station station = nodes.anchoring.at(nodes.block.angle[tile.first_station + lane]);
    nodes.anchoring.move(station, {0, nodes.y[node], nodes.radius[node]}, displacement, velocity);
    for (int c = 0; c < 3; ++c) {
      u[at + c * kLanes] = static_cast<U>(displacement[c]);
      v[at + c * kLanes] = static_cast<Real>(velocity[c]);
    }
  }
};

/// FieldKernels::collect
template <class Real, class U>
struct CollectWindows {
  SurfaceWindows windows;
  const U* u;
  const Real* v;
  U* to_u;
  Real* to_v;

  std::int64_t count() const { return kGroupOfValues * windows.groups(); }
  TREAD_INLINE void operator()(std::int64_t i) const {
    std::int64_t group = i / kGroupOfValues;
    const std::int64_t of_rail = std::int64_t{windows.of[0].nodes} * windows.of[0].tiles;
    const SurfaceWindow& window = windows.of[group < of_rail ? 0 : 1];
    if (group >= of_rail) group -= of_rail;
    const std::int64_t at = window.group(group, window.node) * kGroupOfValues + i % kGroupOfValues;
    to_u[i] = u[at];
    to_v[i] = v[at];
  }
};

/// FieldKernels::hold
template <class Real, class U>
struct HoldUnknowns {
  std::int64_t unknowns;
  const std::int64_t* unknown;
  U* u;
  Real* v;

  std::int64_t count() const { return unknowns; }
  TREAD_INLINE void operator()(std::int64_t i) const {
    u[unknown[i]] = 0;
    v[unknown[i]] = 0;
  }
};

/// Adds what a lane takes from a section node, over stations in their order. `other`: its place in the field,
/// the station's left out.
template <class Value>
TREAD_INLINE void add_stations(const StationLink* shares, int first, int last, int lane, std::int64_t other,
                               const Value* field, double (&taken)[3]) {
  for (int s = first; s < last; ++s) {
    const StationLink& station = shares[s];
    const Value* const at = field + station.at[lane] + other;
    add_station_values<double>(station.share[lane], station.cosine[lane], station.sine[lane], at[0],
                               at[kLanes], at[2 * kLanes], taken);
  }
}

/// FieldKernels::follow: a thread for each field, too.
template <class Real, class U>
struct FollowTies {
  TiedNodes tied;
  U* u;
  Real* v;

  std::int64_t count() const { return 2 * kLanes * tied.count; }
  TREAD_INLINE void operator()(std::int64_t i) const {
    const TiedNode& node = tied.node[i / (2 * kLanes)];
    const int lane = static_cast<int>(i % kLanes);
    if (i / kLanes % 2 == 0)
      follow(node, lane, u);
    else
      follow(node, lane, v);
  }

 private:
  template <class Value>
  TREAD_INLINE void follow(const TiedNode& node, int lane, Value* field) const {
    double sum[3] = {};
    for (int l = node.first_link; l < node.last_link; ++l) {
      const NodeLink& link = tied.links[l];
      double taken[3] = {};
      add_stations(tied.shares, node.first_share, node.last_share, lane, link.other * kGroupOfValues, field,
                   taken);
      for (int c = 0; c < 3; ++c) sum[c] += product(link.share, taken[c]);
    }
    for (int c = 0; c < 3; ++c) field[node.own + c * kLanes + lane] = static_cast<Value>(sum[c]);
  }
};

/// FieldKernels::sum_stations
template <class Real>
struct SumStations {
  StationSums sums;
  const Real* force;

  std::int64_t count() const { return kLanes * sums.count; }
  TREAD_INLINE void operator()(std::int64_t i) const {
    const StationSum& sum = sums.sum[i / kLanes];
    const int lane = static_cast<int>(i % kLanes);
    double taken[3] = {};
    add_stations(sums.shares, sum.first_share, sum.last_share, lane, sum.other, force, taken);
    double* const to = sums.value + i / kLanes * kGroupOfValues + lane;
    for (int c = 0; c < 3; ++c) to[c * kLanes] = taken[c];
  }
};

/// FieldKernels::move_primary
template <class Real, class U>
struct MovePrimary {
  PrimaryBlocks<Real> primary;
  MarchFields<Real, U> fields;

  std::int64_t count() const { return kLanes * primary.count(); }
  TREAD_INLINE void operator()(std::int64_t i) const {
    std::int64_t at = i / kLanes;
    int b = 0;
    while (at >= primary.of[b].nodes.count) at -= primary.of[b++].nodes.count;
    const auto& of = primary.of[b];
    const PrimaryNode& node = of.nodes.node[at];
    const int lane = static_cast<int>(i % kLanes);
    if (lane >= node.stations) return;
    if (of.revolved)
      move<Sweep::revolved, 0>(of, node, lane);
    else if (of.vertical_only)
      move<Sweep::extruded, 2>(of, node, lane);
    else
      move<Sweep::extruded, 0>(of, node, lane);
  }

 private:
  template <Sweep sweep, int first>
  TREAD_INLINE void move(const typename PrimaryBlocks<Real>::Of& of, const PrimaryNode& node,
                         int lane) const {
    double sum[3] = {};
    for (int l = node.first_link; l < node.last_link; ++l) {
      const NodeLink& link = of.nodes.links[l];
      const double* const taken = of.nodes.sums + (node.first_sum + link.other) * kGroupOfValues + lane;
      for (int c = 0; c < 3; ++c) sum[c] += product(link.share, taken[c * kLanes]);
    }
    Real force[3] = {};
    for (int c = 0; c < 3; ++c)
      force[c] = static_cast<Real>(sum[c] + fields.force[node.own + c * kLanes + lane]);
    Real weight[2] = {};
    if constexpr (sweep == Sweep::revolved) weigh(of.block, node.station + lane, weight);
    NodeBefore<Real, U> before;
    before.template load<sweep, first>(of.block, fields, node.section_node, node.own / 3 + lane,
                                       node.own + lane);
    move_on_device<sweep, first>(of.block, fields, node.own + lane, weight, force, 0U, before);
  }
};

/// FieldKernels::advance_lag
template <class Real>
struct LagValues {
  std::int64_t values;
  LagAdvance<Real> advance;
  const Real* v;
  Real* q;

  std::int64_t count() const { return values; }
  TREAD_INLINE void operator()(std::int64_t i) const { q[i] = advance.of(q[i], v[i]); }
};

/// Device::triad
struct Triad {
  std::int64_t values;
  double* a;
  const double* b;
  const double* c;

  std::int64_t count() const { return values; }
  TREAD_INLINE void operator()(std::int64_t i) const { a[i] = b[i] + 3 * c[i]; }
};

}  // namespace tread
