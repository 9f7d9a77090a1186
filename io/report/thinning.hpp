#pragma once
// Fewer points for a curve that looks the same.

#include <cstddef>
#include <span>
#include <vector>

namespace tread {

/// Indices of at most about 2 * groups points: the smallest and largest value of each of `groups` runs of
/// equal length, both ends, and one non-finite value of each run that has any.
std::vector<std::size_t> thinned(std::span<const double> values, std::size_t groups);

}  // namespace tread
