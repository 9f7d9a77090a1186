#pragma once
// A measured running surface prepared for its spectrum. [EN 15610:2009]

#include <string>
#include <vector>

#include "io/scene/table_reader.hpp"

namespace tread {

/// Heights at even distances along the rail.
struct RoughnessProfile {
  double spacing = 0;          ///< [m]
  std::vector<double> height;  ///< heights, positive upwards [m]
  bool resampled = false;      ///< true if the file's distances were uneven: linear interpolation

  double length() const { return spacing * static_cast<double>(height.size()); }
};

/// Profile from the rows of a file with ascending x. `name`: name of the file, for messages. Throws
/// InputError if rows are missing.
RoughnessProfile even_profile(const TwoColumns& rows, const std::string& name);

/// Cuts off narrow spikes, dust that no wheel feels, and returns their number. A spike is a local peak more
/// curved than 1e7 um/m2 that stands higher over its edges (slope below 5e3 um/m) than its width squared over
/// 3 m. [EN 15610, 6.5]
int remove_spikes(RoughnessProfile& profile);

/// Replaces the profile by the lowest points of a disc of 0.375 m radius that rolls over it: pits that no
/// wheel enters are closed. Returns the largest change [m]. [EN 15610, 6.6]
double close_pits(RoughnessProfile& profile);

}  // namespace tread
