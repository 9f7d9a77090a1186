#include "core/mesh/section.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"

namespace tread {

namespace {

double corner_jacobian(const Section& s, const std::array<int, 4>& quad, int corner) {
  const auto here = static_cast<std::size_t>(quad[corner]);
  const auto ahead = static_cast<std::size_t>(quad[(corner + 1) % 4]);
  const auto behind = static_cast<std::size_t>(quad[(corner + 3) % 4]);
  return (s.p[ahead] - s.p[here]) * (s.q[behind] - s.q[here]) -
         (s.q[ahead] - s.q[here]) * (s.p[behind] - s.p[here]);
}

}  // namespace

double quad_area(const Section& section, int quad) {
  const auto& nodes = section.quads[static_cast<std::size_t>(quad)];
  return 0.5 * (corner_jacobian(section, nodes, 0) + corner_jacobian(section, nodes, 2));
}

double quad_quality(const Section& section, int quad) {
  const auto& nodes = section.quads[static_cast<std::size_t>(quad)];
  double smallest = corner_jacobian(section, nodes, 0);
  for (int corner = 1; corner < 4; ++corner)
    smallest = std::min(smallest, corner_jacobian(section, nodes, corner));
  const double area = quad_area(section, quad);
  return area > 0 ? smallest / area : std::min(smallest, -1.0);
}

void validate(const Section& section, const std::string& name) {
  std::string problems;
  int count = 0;
  const auto report = [&](const std::string& text) {
    if (++count <= 10) problems += "\n  " + text;
  };
  std::vector<bool> used(section.p.size(), false);
  std::set<std::array<int, 4>> seen;
  for (int quad = 0; quad < static_cast<int>(section.quads.size()); ++quad) {
    auto key = section.quads[static_cast<std::size_t>(quad)];
    for (const int node : key) used[static_cast<std::size_t>(node)] = true;
    std::sort(key.begin(), key.end());
    if (!seen.insert(key).second) report(fmt::format("quad {} repeats an earlier one", quad));
    if (quad_quality(section, quad) <= 1e-3)
      report(fmt::format("quad {} is inverted, flat or not convex (area {:.3e} m2)", quad,
                         quad_area(section, quad)));
  }
  for (std::size_t node = 0; node < used.size(); ++node)
    if (!used[node]) report(fmt::format("node {} belongs to no quad", node));
  if (count > 0)
    throw InputError(fmt::format("section '{}': {} faults in the quad mesh:{}{}", name, count, problems,
                                 count > 10 ? "\n  ..." : ""));
}

}  // namespace tread
