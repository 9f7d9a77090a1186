#pragma once
// Coefficient of friction stated along the rail.

#include "kernels/contact/friction/sliding.hpp"

namespace tread {

/// Linear between the places of the table, constant before the first and after the last. [theory.md, eq. 10a]
/// A view: the arrays outlive the law.
struct TableFriction {
  const double* x = nullptr;            ///< places, increasing, counted from `start` [m]
  const double* coefficient = nullptr;  ///< f at the places [-]
  int places = 0;                       ///< at least one
  double start = 0;                     ///< of the table on the rail [m]

  struct State {};

  template <class Keep>
  void keep_arrays(const Keep& keep) {
    x = keep(x, places);
    coefficient = keep(coefficient, places);
  }

  constexpr double advance(State& /*state*/, const Sliding& sliding) const { return at(sliding.x); }

  /// f at a place on the rail [-].
  constexpr double at(double place) const {
    const double from_start = place - start;
    if (!(from_start > x[0])) return coefficient[0];
    if (from_start >= x[places - 1]) return coefficient[places - 1];
    int before = 0;
    int after = places - 1;
    while (after - before > 1) {
      const int middle = (before + after) / 2;
      (x[middle] <= from_start ? before : after) = middle;
    }
    const double share = (from_start - x[before]) / (x[after] - x[before]);
    return coefficient[before] + share * (coefficient[after] - coefficient[before]);
  }
};

}  // namespace tread
