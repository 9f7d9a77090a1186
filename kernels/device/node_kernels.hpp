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

/// Values that a lane of a node takes from a field by a tie, summed up in the order of TieSum.
template <class Value>
TREAD_INLINE void tied_values(const TiedNodes& tied, const TiedNode& node, int lane, const Value* field,
                              double (&sum)[3]) {
  for (int l = node.first_link; l < node.last_link; ++l) {
    const NodeLink& link = tied.links[l];
    double taken[3] = {};
    for (int s = node.first_share; s < node.last_share; ++s) {
      const StationLink& station = tied.shares[s];
      const Value* const at = field + station.at[lane] + link.other * kGroupOfValues;
      add_station_values<double>(station.share[lane], station.cosine[lane], station.sine[lane], at[0],
                                 at[kLanes], at[2 * kLanes], taken);
    }
    for (int c = 0; c < 3; ++c) sum[c] += product(link.share, taken[c]);
  }
}

/// FieldKernels::follow
template <class Real, class U>
struct FollowTies {
  TiedNodes tied;
  U* u;
  Real* v;

  std::int64_t count() const { return kLanes * tied.count; }
  TREAD_INLINE void operator()(std::int64_t i) const {
    const TiedNode& node = tied.node[i / kLanes];
    const int lane = static_cast<int>(i % kLanes);
    follow(node, lane, u);
    follow(node, lane, v);
  }

 private:
  template <class Value>
  TREAD_INLINE void follow(const TiedNode& node, int lane, Value* field) const {
    double sum[3] = {};
    tied_values(tied, node, lane, field, sum);
    for (int c = 0; c < 3; ++c) field[node.own + c * kLanes + lane] = static_cast<Value>(sum[c]);
  }
};

/// FieldKernels::move_primary
template <class Real, class U, Sweep sweep, int first>
struct MovePrimary {
  TiedNodes tied;
  MarchBlock<Real> block;
  MarchFields<Real, U> fields;

  std::int64_t count() const { return kLanes * tied.count; }
  TREAD_INLINE void operator()(std::int64_t i) const {
    const TiedNode& node = tied.node[i / kLanes];
    const int lane = static_cast<int>(i % kLanes);
    if (lane >= node.stations) return;
    double sum[3] = {};
    tied_values(tied, node, lane, fields.force, sum);
    Real force[3] = {};
    for (int c = 0; c < 3; ++c)
      force[c] = static_cast<Real>(sum[c] + fields.force[node.own + c * kLanes + lane]);
    Real weight[2] = {};
    if constexpr (sweep == Sweep::revolved) weigh(block, node.station + lane, weight);
    move_on_device<sweep, first>(block, fields, node.section_node, node.own / 3 + lane, node.own + lane,
                                 weight, force);
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
