#pragma once
// Meshes of other programs in place of a scene's swept blocks.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/hex_mesh.hpp"
#include "core/mesh/swept_block.hpp"

namespace tread::samples {

/// An Abaqus file of the block's hexahedra in lengths of `unit` [m]. The nodes of these paths of its section
/// are sets: "tread", the same as "all of tread", and "most of tread" without those of the first node of the
/// path. The
/// elements but one are the set "holed". Nodes of no set are moved across by `shift` [m].
inline std::string body_file(const SweptBlock& block,
                             const std::vector<std::pair<std::string, std::string>>& sets, double unit,
                             double shift) {
  const HexMesh mesh = hexahedra_of(block);
  const int nodes = block.section.nodes();
  std::vector<char> in_set(static_cast<std::size_t>(nodes), 0);
  std::string text, lists;
  for (const auto& [path, name] : sets) {
    for (const std::string kind : {"", "all of ", "most of "}) {
      lists += fmt::format("*NSET, NSET={}{}\n", kind, name);
      for (int station = 0; station < block.station_count(); ++station)
        for (const int node : block.section.paths.at(path))
          if (kind != "most of " || node != block.section.paths.at(path).front())
            lists += fmt::format("{}\n", station * nodes + node + 1);
    }
    for (const int node : block.section.paths.at(path)) in_set[static_cast<std::size_t>(node)] = 1;
  }
  const auto is_free = [&](std::int32_t node) { return in_set[static_cast<std::size_t>(node % nodes)] == 0; };
  text = "*NODE\n";
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    Vec3 at = mesh.nodes[n];
    if (is_free(static_cast<std::int32_t>(n))) at.y += shift;
    text += fmt::format("{}, {:.12g}, {:.12g}, {:.12g}\n", n + 1, at.x / unit, at.y / unit, at.z / unit);
  }
  text += "*ELEMENT, TYPE=C3D8, ELSET=all\n";
  std::size_t hole = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    text += fmt::format("{}", e + 1);
    for (const std::int32_t node : mesh.elements[e]) text += fmt::format(", {}", node + 1);
    text += '\n';
    if (std::all_of(mesh.elements[e].begin(), mesh.elements[e].end(), is_free)) hole = e;
  }
  text += "*ELSET, ELSET=holed\n";
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (e != hole) text += fmt::format("{}\n", e + 1);
  return text + lists;
}

}  // namespace tread::samples
