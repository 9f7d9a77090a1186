#include "drivers/studies/roughness/roughness_profile.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace tread {

namespace {

/// Throws InputError for values that no instrument gives. With wrong units, work and sums would grow without
/// bounds.
void require_plausible(double spacing, const std::vector<double>& height, const std::string& name) {
  constexpr double kLeast = 1e-5, kMost = 1;  // spacing [m]
  constexpr double kHighest = 1;              // [m]
  if (spacing < kLeast || spacing > kMost)
    throw InputError(
        fmt::format("{}: a row every {:.3g} mm, expected 0.01 to 1000 mm; mend the unit of the first column",
                    name, 1e3 * spacing));
  for (const double value : height)
    if (std::abs(value) > kHighest)
      throw InputError(fmt::format(
          "{}: a height of {:.3g} m, expected at most 1 m; mend the unit of the second column", name, value));
}

}  // namespace

RoughnessProfile even_profile(const TwoColumns& rows, const std::string& name) {
  constexpr double kEven = 0.01;  // tolerance as a share of the spacing
  constexpr double kGap = 3.5;    // largest gap in spacings
  const std::vector<double>& x = rows.first;
  RoughnessProfile profile;
  profile.spacing = (x.back() - x.front()) / static_cast<double>(x.size() - 1);
  require_plausible(profile.spacing, rows.second, name);
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double step = x[i] - x[i - 1];
    if (step > kGap * profile.spacing)
      throw InputError(fmt::format(
          "{}: no rows between x = {:.6g} m and {:.6g} m, where a row every {:.3g} mm is usual; cut the file "
          "there",
          name, x[i - 1], x[i], 1e3 * profile.spacing));
    profile.resampled = profile.resampled || std::abs(step / profile.spacing - 1) > kEven;
  }
  if (!profile.resampled) {
    profile.height = rows.second;
    return profile;
  }
  std::size_t i = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double at = std::min(x.front() + static_cast<double>(n) * profile.spacing, x.back());
    while (i + 2 < x.size() && x[i + 1] < at) ++i;
    const double share = (at - x[i]) / (x[i + 1] - x[i]);
    profile.height.push_back((1 - share) * rows.second[i] + share * rows.second[i + 1]);
  }
  return profile;
}

int remove_spikes(RoughnessProfile& profile) {
  constexpr double kCurvature = -10;   // [1/m]
  constexpr double kEdgeSlope = 5e-3;  // [-]
  constexpr double kHeightLength = 3;  // height = width^2 / this [m]
  std::vector<double>& r = profile.height;
  const double dx = profile.spacing;
  const auto slope = [&](std::size_t i) { return (r[i + 1] - r[i]) / dx; };  // slope between i and i + 1
  int removed = 0;
  for (std::size_t i = 1; i + 1 < r.size(); ++i) {
    const double before = slope(i - 1);
    const double after = slope(i);
    if (before < 0 || after > 0 || (after - before) / dx >= kCurvature) continue;
    std::size_t left = i;
    while (left > 0 && slope(left - 1) >= kEdgeSlope) --left;
    std::size_t right = i;
    while (right + 1 < r.size() && slope(right) <= -kEdgeSlope) ++right;
    if (left == i || right == i) continue;
    const double width = dx * static_cast<double>(right - left);
    const auto line = [&, low = r[left], high = r[right]](std::size_t at) {
      return low + (high - low) * static_cast<double>(at - left) / static_cast<double>(right - left);
    };
    if (r[i] - line(i) <= width * width / kHeightLength) continue;
    for (std::size_t at = left + 1; at < right; ++at) r[at] = line(at);
    ++removed;
    i = right;
  }
  return removed;
}

double close_pits(RoughnessProfile& profile) {
  constexpr double kRadius = 0.375;  // [m]
  constexpr double kReach = 0.05;    // a disc touches no farther out on slopes below 0.13 [m]
  const std::vector<double> r = profile.height;
  const auto reach = static_cast<std::size_t>(kReach / profile.spacing);
  std::vector<double> sag;
  for (std::size_t k = 0; k <= reach; ++k) {
    const double x = static_cast<double>(k) * profile.spacing;
    sag.push_back(kRadius - std::sqrt(kRadius * kRadius - x * x));
  }
  double change = 0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    double highest = r[i];
    for (std::size_t k = 1; k <= reach; ++k) {
      if (k <= i) highest = std::max(highest, r[i - k] - sag[k]);
      if (i + k < r.size()) highest = std::max(highest, r[i + k] - sag[k]);
    }
    change = std::max(change, highest - r[i]);
    profile.height[i] = highest;
  }
  return change;
}

}  // namespace tread
