#pragma once
// A region of force on a surface, known in harmonics, and sums over many harmonics.

#include <functional>
#include <vector>

#include "core/material.hpp"

namespace tread {

/// A raised cosine along a surface and across it.
struct ForceRegion {
  double centre = 0;  ///< y of its middle [m]
  double half = 0;    ///< half its length and half its width [m]

  /// Force per width over the force at y [1/m].
  double density(double y) const;
  /// Cosine coefficient along the surface at a wave number [1/m]; 1 at 0.
  double coefficient(double wave_number) const;
  /// Wave number beyond which the coefficients hardly count [1/m].
  double last_wave_number() const;
};

/// Deflection of a half-space under a unit force on the region, weighted by the force [m/N].
double half_space_flexibility(const ForceRegion& region, const Material& material);

/// Harmonics 0 to `dense`, each, and ever fewer of those up to `last`.
std::vector<int> some_harmonics(int dense, int last);

/// Sum of weight(n) value(n) over all harmonics from the values at some of them, between which the value is a
/// power of n.
double sum_of_harmonics(const std::vector<int>& some, const std::vector<double>& value,
                        const std::function<double(int)>& weight);

}  // namespace tread
