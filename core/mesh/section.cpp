#include "core/mesh/section.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
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

double QuadPlace::excess() const {
  return std::max({-xi, xi - 1, -eta, eta - 1, 0.0});
}

std::array<double, 4> QuadPlace::weights() const {
  return {(1 - xi) * (1 - eta), xi * (1 - eta), xi * eta, (1 - xi) * eta};
}

std::optional<QuadPlace> place_in_quad(const Section& section, int quad, double p, double q) {
  constexpr double kFar = 1.5;  // parameters so far from the middle belong to other quads
  constexpr double kSame = 1e-12;
  const std::array<int, 4>& nodes = section.quads[static_cast<std::size_t>(quad)];
  QuadPlace place{0.5, 0.5};
  for (int i = 0; i < 20; ++i) {
    const std::array<double, 4> weight = place.weights();
    const std::array<double, 4> by_xi = {place.eta - 1, 1 - place.eta, place.eta, -place.eta};
    const std::array<double, 4> by_eta = {place.xi - 1, -place.xi, place.xi, 1 - place.xi};
    double dp = p, dq = q, p_xi = 0, p_eta = 0, q_xi = 0, q_eta = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto node = static_cast<std::size_t>(nodes[k]);
      dp -= weight[k] * section.p[node];
      dq -= weight[k] * section.q[node];
      p_xi += by_xi[k] * section.p[node];
      p_eta += by_eta[k] * section.p[node];
      q_xi += by_xi[k] * section.q[node];
      q_eta += by_eta[k] * section.q[node];
    }
    const double determinant = p_xi * q_eta - p_eta * q_xi;
    if (determinant == 0) return std::nullopt;
    const double step_xi = (q_eta * dp - p_eta * dq) / determinant;
    const double step_eta = (p_xi * dq - q_xi * dp) / determinant;
    place.xi += step_xi;
    place.eta += step_eta;
    if (std::abs(place.xi - 0.5) > kFar || std::abs(place.eta - 0.5) > kFar) return std::nullopt;
    if (std::abs(step_xi) + std::abs(step_eta) < kSame) break;
  }
  return place;
}

std::array<double, 2> quad_middle(const Section& section, int quad) {
  double p = 0, q = 0;
  for (const int node : section.quads[static_cast<std::size_t>(quad)]) {
    p += section.p[static_cast<std::size_t>(node)];
    q += section.q[static_cast<std::size_t>(node)];
  }
  return {p / 4, q / 4};
}

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
    if (quad_quality(section, quad) <= 1e-3) {
      const std::array<double, 2> middle = quad_middle(section, quad);
      report(fmt::format("quad {} is inverted, flat or not convex about ({:.1f}, {:.1f}) mm", quad,
                         1e3 * middle[0], 1e3 * middle[1]));
    }
  }
  for (std::size_t node = 0; node < used.size(); ++node)
    if (!used[node]) report(fmt::format("node {} belongs to no quad", node));
  if (count > 0)
    throw InputError(fmt::format(
        "section '{}': {} faults in the quad mesh; the outline bends too sharply, or is too thin, "
        "for elements of this size: smooth it, or state another scene.element_size:{}{}",
        name, count, problems, count > 10 ? "\n  ..." : ""));
}

}  // namespace tread
