#include "io/profiles/profile_cleaning.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

#include "core/millimetre.hpp"

namespace tread {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
const double kSteep = std::tan(80 * kDegree);

void keep(std::vector<double>& values, const std::vector<std::size_t>& kept) {
  std::vector<double> result;
  result.reserve(kept.size());
  for (const std::size_t i : kept) result.push_back(values[i]);
  values = std::move(result);
}

/// Points outwards from `start`, each farther out than all before.
struct Walk {
  std::vector<std::size_t> kept;
  int folded = 0;
  int cut = 0;
};

/// Walks from `start` with the step `step` (1 or -1) until `ends` says that the surface ends at a point.
Walk outwards(const std::vector<double>& y, std::size_t start, int step,
              const std::function<bool(std::size_t)>& ends) {
  Walk walk;
  const auto count = static_cast<std::ptrdiff_t>(y.size());
  double farthest = y[start];
  bool ended = ends(start);
  for (std::ptrdiff_t i = static_cast<std::ptrdiff_t>(start) + step; i >= 0 && i < count; i += step) {
    const auto at = static_cast<std::size_t>(i);
    if (ended) {
      ++walk.cut;
    } else if (step * (y[at] - farthest) <= 1e-9) {
      ++walk.folded;
    } else {
      walk.kept.push_back(at);
      farthest = y[at];
      ended = ends(at);
    }
  }
  return walk;
}

/// Slope dz/dy outwards from the point `at` over `depth` [m] of z; 0 where the rows end before.
double slope_below(const std::vector<double>& y, const std::vector<double>& z, std::size_t at, int step,
                   double depth) {
  const auto count = static_cast<std::ptrdiff_t>(y.size());
  for (std::ptrdiff_t i = static_cast<std::ptrdiff_t>(at) + step; i >= 0 && i < count; i += step) {
    const auto there = static_cast<std::size_t>(i);
    const double drop = z[at] - z[there];
    if (drop >= depth) return drop / std::max(step * (y[there] - y[at]), 1e-9);
  }
  return 0;
}

/// Keeps the points of both walks and `start`.
Kept take(std::vector<double>& y, std::vector<double>& z, std::size_t start, const Walk& left,
          const Walk& right) {
  std::vector<std::size_t> kept(left.kept.rbegin(), left.kept.rend());
  kept.push_back(start);
  kept.insert(kept.end(), right.kept.begin(), right.kept.end());
  keep(y, kept);
  keep(z, kept);
  return {left.folded + right.folded, left.cut + right.cut};
}

}  // namespace

int remove_duplicates(std::vector<double>& y, std::vector<double>& z) {
  constexpr double kSame = 1e-6;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < y.size(); ++i)
    if (kept.empty() || std::hypot(y[i] - y[kept.back()], z[i] - z[kept.back()]) >= kSame) kept.push_back(i);
  const int removed = static_cast<int>(y.size() - kept.size());
  keep(y, kept);
  keep(z, kept);
  return removed;
}

namespace {

/// Angle by which the way from point a over b to c turns [rad].
double turn(const std::vector<double>& y, const std::vector<double>& z, std::size_t a, std::size_t b,
            std::size_t c) {
  const double ay = y[b] - y[a], az = z[b] - z[a], by = y[c] - y[b], bz = z[c] - z[b];
  return std::atan2(std::abs(ay * bz - az * by), ay * by + az * bz);
}

/// Distance of point i from the line between its neighbours [m].
double off_line(const std::vector<double>& y, const std::vector<double>& z, std::size_t i) {
  const double cy = y[i + 1] - y[i - 1], cz = z[i + 1] - z[i - 1];
  return std::abs(cy * (z[i] - z[i - 1]) - cz * (y[i] - y[i - 1])) / std::max(std::hypot(cy, cz), 1e-12);
}

/// Tells a spike from a corner: without a spike the outline turns much less than with it.
bool is_spike(const std::vector<double>& y, const std::vector<double>& z, std::size_t i) {
  constexpr double kHeight = 0.05 * mm, kTurn = 60 * kDegree;
  if (i < 2 || i + 2 >= y.size() || turn(y, z, i - 1, i, i + 1) < kTurn || off_line(y, z, i) < kHeight)
    return false;
  const double with = turn(y, z, i - 2, i - 1, i) + turn(y, z, i - 1, i, i + 1) + turn(y, z, i, i + 1, i + 2);
  const double without = turn(y, z, i - 2, i - 1, i + 1) + turn(y, z, i - 1, i + 1, i + 2);
  return without < 0.5 * with;
}

}  // namespace

int remove_spikes(std::vector<double>& y, std::vector<double>& z) {
  int removed = 0;
  for (int pass = 0; pass < 5; ++pass) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < y.size(); ++i) {
      const bool beside = !kept.empty() && i > 0 && kept.back() + 1 != i;  // of one that is removed already
      if (beside || !is_spike(y, z, i)) kept.push_back(i);
    }
    const int found = static_cast<int>(y.size() - kept.size());
    if (found == 0) break;
    removed += found;
    keep(y, kept);
    keep(z, kept);
  }
  return removed;
}

Kept keep_head(std::vector<double>& y, std::vector<double>& z) {
  const auto crown = static_cast<std::size_t>(std::max_element(z.begin(), z.end()) - z.begin());
  const auto ends = [&](int step) {
    return [&y, &z, step](std::size_t at) { return slope_below(y, z, at, step, 1 * mm) > kSteep; };
  };
  return take(y, z, crown, outwards(y, crown, -1, ends(-1)), outwards(y, crown, 1, ends(1)));
}

Kept keep_tread_and_flange(std::vector<double>& y, std::vector<double>& z) {
  std::size_t circle = 0, tip = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (std::abs(y[i]) < std::abs(y[circle])) circle = i;
    if (y[i] < 0 && (z[i] > z[tip] || y[tip] >= 0)) tip = i;
  }
  constexpr double kChamfer = 0.6, kChamferDrop = 0.8 * mm;
  const auto chamfer = [&](std::size_t at) { return slope_below(y, z, at, 1, kChamferDrop) > kChamfer; };
  const auto back = [&](std::size_t at) { return at <= tip && slope_below(y, z, at, -1, 1 * mm) > kSteep; };
  return take(y, z, circle, outwards(y, circle, -1, back), outwards(y, circle, 1, chamfer));
}

}  // namespace tread
