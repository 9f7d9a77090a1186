#include "io/report/thinning.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace tread {

std::vector<std::size_t> thinned(std::span<const double> values, std::size_t groups) {
  std::vector<std::size_t> kept;
  const std::size_t n = values.size();
  if (n <= 2 * groups) {
    for (std::size_t i = 0; i < n; ++i) kept.push_back(i);
    return kept;
  }
  const auto keep = [&](std::initializer_list<std::size_t> candidates) {
    std::vector<std::size_t> sorted(candidates);
    std::sort(sorted.begin(), sorted.end());
    for (const std::size_t i : sorted)
      if (i < n && (kept.empty() || i > kept.back())) kept.push_back(i);
  };
  keep({0});
  for (std::size_t group = 0; group < groups; ++group) {
    std::size_t lowest = n;
    std::size_t highest = n;
    std::size_t gap = n;
    for (std::size_t i = group * n / groups; i < (group + 1) * n / groups; ++i) {
      if (!std::isfinite(values[i])) {
        gap = i;
        continue;
      }
      if (lowest == n || values[i] < values[lowest]) lowest = i;
      if (highest == n || values[i] > values[highest]) highest = i;
    }
    keep({lowest, highest, gap});
  }
  keep({n - 1});
  return kept;
}

}  // namespace tread
