#pragma once
// Kernels of a device and their choice, for every kind of team. [kernels/device/march_body.hpp]

#include "kernels/device/device.hpp"
#include "kernels/device/march_body.hpp"

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

}  // namespace tread
