#pragma once
// Eigenfrequencies of the beam on fastenings.

#include <numbers>

#include "drivers/engine/beam/track_beam.hpp"

namespace tread {

/// The n-th undamped eigenfrequency, n from 0, rigid motion included [Hz]. Sylvester's law of inertia: K -
/// omega^2 M has as many negative pivots as there are modes below omega.
inline double eigenfrequency(const TrackBeam& beam, int n) {
  const auto lies_below = [&](double omega) {
    BandMatrix<double> factor = beam.stiffness();
    factor.add(-omega * omega, beam.mass());
    factor.factorise();
    int modes = 0;
    for (int i = 0; i < factor.size(); ++i) modes += factor.at(i, i) < 0 ? 1 : 0;
    return modes > n;
  };
  double low = 0, high = 1;
  while (!lies_below(high)) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (lies_below(middle) ? high : low) = middle;
  }
  return 0.5 * (low + high) / (2 * std::numbers::pi);
}

}  // namespace tread
