#pragma once
// Kernels of a device and their choice, for every kind of team. [kernels/device/march_body.hpp]

#include "kernels/device/device.hpp"
#include "kernels/device/march_body.hpp"
#include "kernels/material/branch_lag.hpp"

namespace tread {

/// launch.template operator()<March>() of the march over blocks of a variant.
template <class Real, class U, class Team, class Launch>
void with_march(TileVariant v, const Launch& launch) {
  constexpr auto extruded = Sweep::extruded;
  constexpr auto revolved = Sweep::revolved;
  Laws::with(v.law, [&]<template <class> class Law>() {
    if constexpr (!Law<Real>::kLinear) {
      if (v.sweep == revolved)
        launch.template operator()<March<Real, U, revolved, true, 0, Law, Team>>();
      else
        launch.template operator()<March<Real, U, extruded, false, 0, Law, Team>>();
    } else if (v.vertical_only) {
      launch.template operator()<March<Real, U, extruded, false, 2, Law, Team>>();
    } else if (v.sweep == revolved && v.finite_rotation) {
      launch.template operator()<March<Real, U, revolved, true, 0, Law, Team>>();
    } else if (v.sweep == revolved) {
      launch.template operator()<March<Real, U, revolved, false, 0, Law, Team>>();
    } else if (v.finite_rotation) {
      launch.template operator()<March<Real, U, extruded, true, 0, Law, Team>>();
    } else {
      launch.template operator()<March<Real, U, extruded, false, 0, Law, Team>>();
    }
    return true;
  });
}

/// Place `i` of a group's packed values in a vector field.
TREAD_INLINE std::int64_t group_place(const std::int64_t* groups, std::int64_t i) {
  constexpr int kValues = 3 * kLanes;
  return groups[i / kValues] * kValues + i % kValues;
}

template <class Real, class U>
TREAD_INLINE void place_value(const GroupValues<Real, U>& values, std::int64_t i, U* u, Real* v) {
  const std::int64_t at = group_place(values.groups, i);
  u[at] = values.u[i];
  v[at] = values.v[i];
}

/// Hands the precisions of a device's kernels to templates of `Own`: march_any, place_any, advance_any_lag.
template <class Own>
class KernelDevice : public Device {
 public:
  void march(TileVariant variant, const MarchBlock<double>& block,
             const MarchFields<double, double>& fields) override {
    own().march_any(variant, block, fields);
  }
  void march(TileVariant variant, const MarchBlock<float>& block,
             const MarchFields<float, double>& fields) override {
    own().march_any(variant, block, fields);
  }
  void march(TileVariant variant, const MarchBlock<float>& block,
             const MarchFields<float, float>& fields) override {
    own().march_any(variant, block, fields);
  }
  void place(const GroupValues<double, double>& values, double* u, double* v) override {
    own().place_any(values, u, v);
  }
  void place(const GroupValues<float, double>& values, double* u, float* v) override {
    own().place_any(values, u, v);
  }
  void place(const GroupValues<float, float>& values, float* u, float* v) override {
    own().place_any(values, u, v);
  }
  void advance_lag(std::int64_t n, double kept, double gained, const double* v, double* q) override {
    own().advance_any_lag(n, LagAdvance<double>{kept, gained}, v, q);
  }
  void advance_lag(std::int64_t n, float kept, float gained, const float* v, float* q) override {
    own().advance_any_lag(n, LagAdvance<float>{kept, gained}, v, q);
  }

 private:
  Own& own() { return static_cast<Own&>(*this); }
};

}  // namespace tread
