#include "drivers/engine/model/body_point.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "kernels/contact/contact_surface.hpp"

namespace tread {

namespace {

/// A quad of one of the blocks.
struct FoundQuad {
  int block = -1;
  int quad = -1;
  QuadPlace place{};
};

/// The quad that holds the point (p, q) [m]; between the curved surface and a straight edge, the nearest one.
/// Block -1 where none is near.
FoundQuad find_quad(const Mesh& mesh, const std::vector<int>& blocks, double p, double q) {
  constexpr double kNear = 0.1;  // of a quad's edge
  FoundQuad found;
  double least = kNear;
  for (const int block : blocks) {
    const Section& section = mesh.blocks[static_cast<std::size_t>(block)].section;
    for (int quad = 0; quad < static_cast<int>(section.quads.size()); ++quad) {
      const std::optional<QuadPlace> place = place_in_quad(section, quad, p, q);
      if (!place || place->excess() >= least) continue;
      least = place->excess();
      found = {block, quad, *place};
      if (least == 0) return found;
    }
  }
  return found;
}

/// Direction from the running surface into the body along q: -1 or 1.
double inwards(const Section& section) {
  const SurfaceEdge& edge = section.surface.front();
  const double surface = 0.5 * (section.q[static_cast<std::size_t>(edge.node[0])] +
                                section.q[static_cast<std::size_t>(edge.node[1])]);
  return quad_middle(section, edge.quad)[1] < surface ? -1 : 1;
}

/// Depths between which the section is body [m].
struct BodyDepths {
  double first = 0, last = 0;
};

/// Stretches of body below the height `surface` at p [m], the uppermost first; seams between blocks count as
/// body.
std::vector<BodyDepths> depths_of_body(const Mesh& mesh, const std::vector<int>& blocks, double p,
                                       double surface, double direction) {
  constexpr double kSeam = 1e-4;  // [m]
  std::vector<BodyDepths> list;
  for (const int block : blocks) {
    const Section& section = mesh.blocks[static_cast<std::size_t>(block)].section;
    for (const std::array<int, 4>& nodes : section.quads) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto a = static_cast<std::size_t>(nodes[k]), b = static_cast<std::size_t>(nodes[(k + 1) % 4]);
        const double begin = section.p[a], end = section.p[b];
        if (p < std::min(begin, end) || p > std::max(begin, end)) continue;
        const double share = begin == end ? 0 : (p - begin) / (end - begin);
        const double q = section.q[a] + share * (section.q[b] - section.q[a]);
        low = std::min(low, (q - surface) * direction);
        high = std::max(high, (q - surface) * direction);
      }
      if (low <= high) list.push_back({low, high});
    }
  }
  std::sort(list.begin(), list.end(),
            [](const BodyDepths& a, const BodyDepths& b) { return a.first < b.first; });
  std::vector<BodyDepths> joined;
  for (const BodyDepths& one : list) {
    if (joined.empty() || one.first > joined.back().last + kSeam) joined.push_back(one);
    joined.back().last = std::max(joined.back().last, one.last);
  }
  return joined;
}

/// Throws InputError, which begins with `what`, where the place lies outside the body.
void require_inside(const std::vector<BodyDepths>& body, const SectionPlace& place, const std::string& what) {
  constexpr double kRounding = 1e-6;  // [m]
  double fits = 0;                    // the greatest depth above the place that does
  for (const BodyDepths& stretch : body) {
    // The running surface may lie above the straight edges.
    if (stretch.first - kRounding > place.depth && &stretch != &body.front()) break;
    if (place.depth <= stretch.last + kRounding) return;
    fits = stretch.last;
  }
  throw InputError(
      fmt::format("{}: {:.6g} mm below the running surface at y = {:.4g} mm there is no element of the body; "
                  "state a depth of {:.6g} mm at most",
                  what, 1e3 * place.depth, 1e3 * place.y, 1e3 * fits));
}

}  // namespace

BodyPoint find_point(const Mesh& mesh, const std::vector<int>& blocks, double along,
                     const SectionPlace& place, const std::string& what) {
  const SweptBlock& top = mesh.blocks[static_cast<std::size_t>(blocks.front())];
  const SurfaceProfile profile(top.section);
  if (place.y < profile.first_p() || place.y > profile.last_p())
    throw InputError(fmt::format("{}: y = {:.4g} mm lies beyond the running surface, {:.4g} ... {:.4g} mm",
                                 what, 1e3 * place.y, 1e3 * profile.first_p(), 1e3 * profile.last_p()));
  const double surface = profile.q_at(place.y), direction = inwards(top.section);
  require_inside(depths_of_body(mesh, blocks, place.y, surface, direction), place, what);
  const double q = surface + direction * place.depth;
  const FoundQuad found = find_quad(mesh, blocks, place.y, q);
  if (found.block < 0)
    throw InputError(fmt::format(
        "{}: {:.4g} mm below the running surface at y = {:.4g} mm there is no element of the body; state a "
        "smaller depth",
        what, 1e3 * place.depth, 1e3 * place.y));
  const SweptBlock& block = mesh.blocks[static_cast<std::size_t>(found.block)];
  const StationFinder::Cell cell = StationFinder(block).find(along);
  if (cell.station < 0) {
    const char* unit = block.sweep == Sweep::extruded ? "m" : "rad";
    throw InputError(fmt::format(
        "{}: the place along the body, {:.6g} {}, lies beyond it, {:.6g} ... {:.6g} {}; change {}.x", what,
        along, unit, block.stations.front(), block.stations.back(), unit, what));
  }
  const QuadPlace inside{std::clamp(found.place.xi, 0.0, 1.0), std::clamp(found.place.eta, 0.0, 1.0)};
  const double c = cell.distance / cell.pitch;
  const std::array<double, 4> corner = inside.weights();
  BodyPoint point{found.block, found.quad, cell.station, {}, {}};
  const std::array<int, 4>& nodes = block.section.quads[static_cast<std::size_t>(found.quad)];
  for (std::size_t k = 0; k < 4; ++k) {
    point.slot[k] = block.base + block.slot(nodes[k], cell.station);
    point.slot[k + 4] = block.base + block.slot(nodes[k], cell.next);
    point.weight[k] = corner[k] * (1 - c);
    point.weight[k + 4] = corner[k] * c;
  }
  return point;
}

std::vector<QuadBelow> quads_below(const Mesh& mesh, const std::vector<int>& blocks,
                                   const SectionPlace& deepest) {
  const SweptBlock& top = mesh.blocks[static_cast<std::size_t>(blocks.front())];
  const double surface = SurfaceProfile(top.section).q_at(deepest.y);
  std::vector<QuadBelow> list;
  for (const int block : blocks) {
    const Section& section = mesh.blocks[static_cast<std::size_t>(block)].section;
    for (int quad = 0; quad < static_cast<int>(section.quads.size()); ++quad) {
      const double middle = quad_middle(section, quad)[1];
      const double depth = std::abs(middle - surface);
      if (depth > deepest.depth) continue;
      const std::optional<QuadPlace> place = place_in_quad(section, quad, deepest.y, middle);
      if (place && place->excess() == 0) list.push_back({block, quad, depth});
    }
  }
  std::sort(list.begin(), list.end(),
            [](const QuadBelow& a, const QuadBelow& b) { return a.depth < b.depth; });
  return list;
}

}  // namespace tread
