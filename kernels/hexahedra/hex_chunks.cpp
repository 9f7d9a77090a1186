#include "kernels/hexahedra/hex_chunks.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/index.hpp"
#include "core/mesh/bisection.hpp"
#include "core/mesh/swept_block.hpp"

namespace tread {

std::vector<std::int32_t> nodes_of(const HexMesh& mesh, std::span<const std::int32_t> elements) {
  std::vector<std::int32_t> nodes;
  for (const std::int32_t e : elements)
    nodes.insert(nodes.end(), mesh.elements[index(e)].begin(), mesh.elements[index(e)].end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

namespace {

void cut(const HexMesh& mesh, std::span<std::int32_t> elements,
         std::vector<std::vector<std::int32_t>>& chunks) {
  if (elements.size() <= kChunkElements && nodes_of(mesh, elements).size() <= kChunkNodes) {
    chunks.emplace_back(elements.begin(), elements.end());
    return;
  }
  const auto middle = [&](std::int32_t e) {
    const HexCorners& corners = mesh.elements[index(e)];
    return mesh.nodes[index(corners[0])] + mesh.nodes[index(corners[6])];
  };
  const std::size_t half = elements.size() / 2 / kLanes * kLanes;
  part_along(elements, half, longest_side(elements, middle).axis, middle);
  cut(mesh, elements.first(half), chunks);
  cut(mesh, elements.subspan(half), chunks);
}

}  // namespace

std::vector<std::vector<std::int32_t>> hex_chunks(const HexMesh& mesh) {
  std::vector<std::int32_t> elements(mesh.elements.size());
  std::iota(elements.begin(), elements.end(), 0);
  std::vector<std::vector<std::int32_t>> chunks;
  if (!elements.empty()) cut(mesh, elements, chunks);
  return chunks;
}

void number_by_chunks(HexMesh& mesh) {
  std::vector<std::int32_t> number(mesh.nodes.size(), -1);
  std::int32_t next = 0;
  for (const std::vector<std::int32_t>& elements : hex_chunks(mesh))
    for (const std::int32_t node : nodes_of(mesh, elements))
      if (number[index(node)] < 0) number[index(node)] = next++;
  std::vector<Vec3> nodes(mesh.nodes.size());
  std::vector<std::int64_t> in_file(mesh.node_number.size());
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    nodes[index(number[node])] = mesh.nodes[node];
    in_file[index(number[node])] = mesh.node_number[node];
  }
  mesh.nodes = std::move(nodes);
  mesh.node_number = std::move(in_file);
  for (HexCorners& corners : mesh.elements)
    for (std::int32_t& corner : corners) corner = number[index(corner)];
  for (auto& [name, set] : mesh.node_sets) {
    for (std::int32_t& node : set) node = number[index(node)];
    std::sort(set.begin(), set.end());
  }
}

}  // namespace tread
