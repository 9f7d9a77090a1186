#include "kernels/ties/tie_places.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace tread {

std::vector<SectionPoint> locate_in_section(const SweptBlock& fine, const std::vector<int>& fine_path,
                                            const SweptBlock& coarse, const std::vector<int>& coarse_path) {
  std::vector<SectionPoint> points;
  for (const int node : fine_path) {
    const double p = fine.section.p[static_cast<std::size_t>(node)];
    const double q = fine.section.q[static_cast<std::size_t>(node)];
    SectionPoint best{{-1, -1}, 0};
    double distance = 1e30;
    for (std::size_t i = 0; i + 1 < coarse_path.size(); ++i) {
      const auto a = static_cast<std::size_t>(coarse_path[i]);
      const auto b = static_cast<std::size_t>(coarse_path[i + 1]);
      const double dp = coarse.section.p[b] - coarse.section.p[a];
      const double dq = coarse.section.q[b] - coarse.section.q[a];
      const double length2 = dp * dp + dq * dq;
      const double fraction =
          std::clamp(((p - coarse.section.p[a]) * dp + (q - coarse.section.q[a]) * dq) / length2, 0.0, 1.0);
      const double off =
          std::hypot(coarse.section.p[a] + fraction * dp - p, coarse.section.q[a] + fraction * dq - q);
      if (off < distance) {
        distance = off;
        best = {{coarse_path[i], coarse_path[i + 1]}, fraction};
      }
    }
    if (distance > 1e-9)
      throw InputError(
          fmt::format("tie of '{}' to '{}': section node {} at ({:.6f}, {:.6f}) m lies {:.3e} m off the "
                      "coarse line; make both lines coincide",
                      fine.name, coarse.name, node, p, q, distance));
    if (best.fraction < 1e-9) best.fraction = 0;
    if (best.fraction > 1 - 1e-9) best.fraction = 1;
    points.push_back(best);
  }
  return points;
}

StationPoint locate_along(const SweptBlock& fine, int station, const SweptBlock& coarse) {
  constexpr double turn = 2 * std::numbers::pi;
  constexpr double tolerance = 1e-9;
  double at = fine.stations[static_cast<std::size_t>(station)];
  const double first = coarse.stations.front();
  if (coarse.closed) at = first + std::fmod(std::fmod(at - first, turn) + turn, turn);
  if (coarse.closed && first + turn - at < tolerance) at = first;
  const auto above = std::upper_bound(coarse.stations.begin(), coarse.stations.end(), at + tolerance);
  int j = static_cast<int>(above - coarse.stations.begin()) - 1;
  const int count = coarse.station_count();
  if (!coarse.closed && j == count - 1 && at < coarse.stations.back() + tolerance) j = count - 2;
  if (j < 0 || (!coarse.closed && j >= count - 1))
    throw InputError(fmt::format("tie of '{}' to '{}': station {} at {:.6f} lies beyond the coarse block",
                                 fine.name, coarse.name, station, at));
  const int next = j + 1 < count ? j + 1 : 0;
  const double span = next > 0 ? coarse.stations[static_cast<std::size_t>(next)] : first + turn;
  const double here = coarse.stations[static_cast<std::size_t>(j)];
  double fraction = (at - here) / (span - here);
  if (fraction < tolerance) fraction = 0;
  if (fraction > 1 - tolerance) fraction = 1;
  return {{j, next}, fraction};
}

const std::vector<int>& path_of(const SweptBlock& block, const std::string& name) {
  const auto found = block.section.paths.find(name);
  if (found == block.section.paths.end())
    throw InputError(fmt::format("block '{}' has no section path '{}' to tie", block.name, name));
  return found->second;
}

}  // namespace tread
