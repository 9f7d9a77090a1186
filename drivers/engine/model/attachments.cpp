#include "drivers/engine/model/attachments.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "kernels/contact/contact_surface.hpp"

namespace tread {

namespace {

/// Line of the points that [hammer] strikes.
const std::string kCrown = "running surface";

/// Keys that bring a point onto the line of this name of the block, for messages.
std::string_view keys_across(const std::string& block, const std::string& path) {
  if (path == kCrown) return "; [hammer] strikes y = 0: change rail.profile_shift";
  if (path == "foot") return "; state a smaller fastenings.pad_width";
  if (path != "top") return "";
  if (block == "slab")
    return "; state a smaller fastenings.pad_width, a larger slab.width or another slab.offset";
  if (block.starts_with("sleeper "))
    return "; state a smaller fastenings.pad_width, a larger sleepers.length or another sleepers.offset";
  return "";
}

/// Attachment on the line `nodes` of the section, called `path` in messages.
Attachment attach_to_line(const SweptBlock& block, const std::vector<int>& nodes, const std::string& path,
                          const std::array<double, 2>& at_xy) {
  const auto [x, y] = at_xy;
  const auto p = [&](std::size_t i) { return block.section.p[static_cast<std::size_t>(nodes[i])]; };
  if (y < p(0) - 1e-9 || y > p(nodes.size() - 1) + 1e-9)
    throw InputError(
        fmt::format("attachment at y = {:.4f} m lies beyond '{}' of block '{}' ({:.4f} ... {:.4f} m){}", y,
                    path, block.name, p(0), p(nodes.size() - 1), keys_across(block.name, path)));
  std::size_t i = 0;
  while (i + 2 < nodes.size() && p(i + 1) < y) ++i;
  const double across = std::clamp((y - p(i)) / (p(i + 1) - p(i)), 0.0, 1.0);
  const auto cell = StationFinder(block).find(x);
  if (cell.station < 0)
    throw InputError(fmt::format("attachment at x = {:.4f} m lies beyond block '{}' ({:.4f} ... {:.4f} m){}",
                                 x, block.name, block.stations.front(), block.stations.back(),
                                 path == kCrown ? "; change hammer.position" : ""));
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
  return attach_to_line(block, nodes, kCrown, {x, y});
}

std::vector<SpringDampers::Element> bed_elements(const SleeperSpec& spec, double share,
                                                 const SweptBlock& sleeper) {
  const std::vector<int>& bottom = sleeper.section.paths.at("bottom");
  const std::size_t columns = bottom.size() - 1;
  const double middle = 0.5 * (sleeper.stations.front() + sleeper.stations.back());
  const double part = share / (2 * static_cast<double>(columns));
  std::vector<SpringDampers::Element> elements;
  for (std::size_t i = 0; i < columns; ++i) {
    const double y = 0.5 * (sleeper.section.p[static_cast<std::size_t>(bottom[i])] +
                            sleeper.section.p[static_cast<std::size_t>(bottom[i + 1])]);
    for (const double side : {-0.25, 0.25})
      elements.push_back({attach(sleeper, "bottom", middle + side * spec.width, y),
                          {},
                          part * spec.stiffness,
                          part * spec.damping,
                          2});
  }
  return elements;
}

}  // namespace tread
