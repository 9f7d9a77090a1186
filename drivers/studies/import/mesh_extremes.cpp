#include "drivers/studies/import/mesh_extremes.hpp"

#include <algorithm>
#include <vector>

#include "core/parallel/parallel.hpp"
#include "kernels/element/hexahedron.hpp"
#include "kernels/solver/stable_step.hpp"

namespace tread {

namespace {

void take_smaller(ElementExtreme& extreme, double value, std::int64_t element) {
  if (extreme.element == 0 || value < extreme.value) extreme = {value, element};
}

void take_larger(ElementExtreme& extreme, double value, std::int64_t element) {
  if (extreme.element == 0 || value > extreme.value) extreme = {value, element};
}

}  // namespace

MeshExtremes mesh_extremes(const HexMesh& mesh, const Material& material) {
  MeshExtremes all;
  all.low = all.high = mesh.nodes.front();
  for (const Vec3& at : mesh.nodes)
    for (int i = 0; i < 3; ++i) {
      all.low[i] = std::min(all.low[i], at[i]);
      all.high[i] = std::max(all.high[i], at[i]);
    }
  std::vector<double> omega(mesh.elements.size());
  parallel_ranges(static_cast<std::int64_t>(omega.size()), [&](std::int64_t first, std::int64_t last) {
    for (auto e = static_cast<std::size_t>(first); e < static_cast<std::size_t>(last); ++e) {
      const auto corners = mesh.corners(e);
      omega[e] = hexahedron_frequency({corners, corners, material});
    }
  });
  for (std::size_t e = 0; e < omega.size(); ++e) {
    const HexShape shape = hex_shape(mesh.corners(e));
    const std::int64_t number = mesh.element_number[e];
    all.volume += shape.volume;
    take_smaller(all.shortest_edge, shape.shortest_edge, number);
    take_larger(all.longest_edge, shape.longest_edge, number);
    take_larger(all.edge_ratio, shape.longest_edge / shape.shortest_edge, number);
    take_smaller(all.jacobian, shape.smallest_jacobian, number);
    take_smaller(all.stable_step, stable_step(omega[e], 0), number);
  }
  return all;
}

}  // namespace tread
