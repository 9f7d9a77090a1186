#include "drivers/studies/import/mesh_extremes.hpp"

#include <algorithm>
#include <vector>

#include "core/aligned.hpp"
#include "kernels/hexahedra/hex_force.hpp"
#include "kernels/solver/stable_step.hpp"

namespace tread {

namespace {

void take_smaller(ElementExtreme& extreme, double value, std::int64_t element) {
  if (extreme.element == 0 || value < extreme.value) extreme = {value, element};
}

void take_larger(ElementExtreme& extreme, double value, std::int64_t element) {
  if (extreme.element == 0 || value > extreme.value) extreme = {value, element};
}

double assembled_step(const HexForce& force) {
  AlignedVector<double> inverse_mass;
  for (const double mass : force.lumped_mass())
    for (int i = 0; i < kHexNodeValues; ++i) inverse_mass.push_back(i < 3 ? 1 / mass : 0.0);
  const Operator elastic = [&](const double* x, double* y) { force.apply(x, y); };
  return stable_step(highest_frequency(elastic, inverse_mass).omega, 0);
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
  const HexForce force(mesh, std::vector<Material>(mesh.parts.size(), material));
  const HexFrequency highest = force.max_frequency();
  all.stable_step = {stable_step(highest.omega, 0), mesh.element_number[highest.element]};
  all.assembled_step = assembled_step(force);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const HexShape shape = hex_shape(mesh.corners(e));
    const std::int64_t number = mesh.element_number[e];
    all.volume += shape.volume;
    take_smaller(all.shortest_edge, shape.shortest_edge, number);
    take_larger(all.longest_edge, shape.longest_edge, number);
    take_larger(all.edge_ratio, shape.longest_edge / shape.shortest_edge, number);
    take_smaller(all.jacobian, shape.smallest_jacobian, number);
  }
  return all;
}

}  // namespace tread
