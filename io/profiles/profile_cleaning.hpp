#pragma once
// Removal of points that are no part of a running surface.

#include <vector>

namespace tread {

/// Removes points less than 1 um from the one before and returns their number. [m]
int remove_duplicates(std::vector<double>& y, std::vector<double>& z);

/// Removes single points at which the outline turns by more than 60 degrees, more than 0.05 mm off the line
/// between their neighbours, if it turns less than half as much without them. Returns their number. [m]
int remove_spikes(std::vector<double>& y, std::vector<double>& z);

/// Numbers of points that were left out.
struct Kept {
  int folded = 0;  ///< below the outline, where y folds back
  int cut = 0;     ///< beyond the ends of the surface
};

/// Keeps a rail's head from side to side, up to the places where it leans by 80 degrees. Rows by growing y, z
/// up. [m]
Kept keep_head(std::vector<double>& y, std::vector<double>& z);

/// Keeps a wheel from the flange's back, where it leans by 80 degrees, to the chamfer of the rim, which is
/// steeper than 0.6. Rows by growing y, z towards the flange tip. [m]
Kept keep_tread_and_flange(std::vector<double>& y, std::vector<double>& z);

}  // namespace tread
