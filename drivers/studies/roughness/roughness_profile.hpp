#pragma once
// A measured running surface made ready for its spectrum. [EN 15610:2009]

#include <string>
#include <vector>

#include "io/scene/table_reader.hpp"

namespace tread {

/// Heights at even distances along the rail.
struct RoughnessProfile {
  double spacing = 0;          ///< [m]
  std::vector<double> height;  ///< upwards [m]
  bool resampled = false;      ///< the file's distances were uneven: linear interpolation

  double length() const { return spacing * static_cast<double>(height.size()); }
};

/// From the rows of a file, x growing. `name`: of the file, for messages. InputError where rows are missing.
RoughnessProfile even_profile(const TwoColumns& rows, const std::string& name);

/// Cuts off narrow spikes, dust that no wheel feels: a local peak more curved than 1e7 um/m2 that stands
/// higher over its edges (slope below 5e3 um/m) than its width squared over 3 m. How many. [EN 15610, 6.5]
int remove_spikes(RoughnessProfile& profile);

/// The lowest points of a disc of 0.375 m radius that rolls over the profile: pits that no wheel enters are
/// closed. The largest change [m]. [EN 15610, 6.6]
double close_pits(RoughnessProfile& profile);

}  // namespace tread
