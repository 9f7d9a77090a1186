#include "drivers/engine/attachments.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "kernels/contact/contact_surface.hpp"

namespace tread {

namespace {

/// Attachment on the line `nodes` of the section, called `path` in messages.
Attachment attach_to_line(const SweptBlock& block, const std::vector<int>& nodes, const std::string& path,
                          const std::array<double, 2>& at_xy) {
  const auto [x, y] = at_xy;
  const auto p = [&](std::size_t i) { return block.section.p[static_cast<std::size_t>(nodes[i])]; };
  if (y < p(0) - 1e-9 || y > p(nodes.size() - 1) + 1e-9)
    throw InputError(
        fmt::format("attachment at y = {:.4f} m lies beyond '{}' of block '{}' ({:.4f} ... {:.4f} m)", y,
                    path, block.name, p(0), p(nodes.size() - 1)));
  std::size_t i = 0;
  while (i + 2 < nodes.size() && p(i + 1) < y) ++i;
  const double across = std::clamp((y - p(i)) / (p(i + 1) - p(i)), 0.0, 1.0);
  const auto cell = StationFinder(block).find(x);
  if (cell.station < 0)
    throw InputError(fmt::format("attachment at x = {:.4f} m lies beyond block '{}' ({:.4f} ... {:.4f} m)", x,
                                 block.name, block.stations.front(), block.stations.back()));
  const double along = cell.distance / cell.pitch;
  Attachment at;
  for (std::size_t k = 0; k < 4; ++k) {
    at.slot[k] = block.base + block.slot(nodes[i + k % 2], k / 2 == 0 ? cell.station : cell.next);
    at.weight[k] = (k % 2 == 0 ? 1 - across : across) * (k / 2 == 0 ? 1 - along : along);
  }
  return at;
}

}  // namespace

Attachment attach(const SweptBlock& block, const std::string& path, double x, double y) {
  const auto found = block.section.paths.find(path);
  if (found == block.section.paths.end())
    throw InputError(fmt::format("block '{}' has no line '{}' to attach to", block.name, path));
  return attach_to_line(block, found->second, path, {x, y});
}

Attachment attach_to_surface(const SweptBlock& block, double x, double y) {
  std::vector<int> nodes;
  for (const SurfaceEdge& edge : block.section.surface) {
    if (nodes.empty()) nodes.push_back(edge.node[0]);
    nodes.push_back(edge.node[1]);
  }
  return attach_to_line(block, nodes, "running surface", {x, y});
}

std::vector<SpringDampers::Element> fastening_elements(const Scene& scene, const SweptBlock& rail,
                                                       const SweptBlock* slab) {
  const FasteningSpec& f = *scene.fastenings;
  const auto& foot = rail.section.paths.at("foot");
  const double middle = 0.5 * (rail.section.p[static_cast<std::size_t>(foot.front())] +
                               rail.section.p[static_cast<std::size_t>(foot.back())]);
  std::vector<SpringDampers::Element> elements;
  const int groups = f.columns * f.rows;
  for (int i = 0; i < f.count; ++i)
    for (int column = 0; column < f.columns; ++column)
      for (int row = 0; row < f.rows; ++row) {
        const double x =
            -scene.rail->origin + f.first + i * f.spacing + f.pad_length * ((column + 0.5) / f.columns - 0.5);
        const double y = middle + f.pad_width * ((row + 0.5) / f.rows - 0.5);
        SpringDampers::Element element{
            attach(rail, "foot", x, y), {}, f.stiffness / groups, f.damping / groups};
        if (slab) element.lower = attach(*slab, "top", x, y);
        elements.push_back(element);
      }
  return elements;
}

}  // namespace tread
