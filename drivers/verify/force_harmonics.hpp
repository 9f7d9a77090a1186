#pragma once
// Curves of F_N over the fastenings and their periodic parts.

#include <vector>

namespace tread {

/// F_N at times and places of a passage [N].
struct ForceHistory {
  std::vector<double> time;   ///< [s]
  std::vector<double> x;      ///< place of the wheel [m]
  std::vector<double> force;  ///< [N]
};

/// Mean, and amplitude and phase of the first harmonics of a period in x over whole periods.
struct Harmonics {
  double mean = 0;
  std::vector<double> amplitude;  ///< amplitudes of harmonics 1, 2, ...
  std::vector<double> phase;      ///< x of the first crest over the period, 0 ... 1
  double low = 0, high = 0;       ///< extremes of the sum of mean and harmonics
};

/// Harmonics over [last - periods * period, last], by trapezoids. Throws NumericalError if the curve does not
/// cover that range.
Harmonics harmonics(const ForceHistory& curve, double period, int periods, double last, int count);

}  // namespace tread
