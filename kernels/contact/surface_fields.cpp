#include "kernels/contact/surface_fields.hpp"

#include <algorithm>

namespace tread {

namespace {

/// Calls visit(node's place in the grid, node) for the patch's nodes.
template <class Visit>
void for_each_node(const PatchNodes& patch, const Visit& visit) {
  for (int station = patch.first(); station <= patch.last(); ++station)
    for (int row = 0; row < patch.grid().rows(); ++row)
      visit(patch.grid().node(station, row), patch.at(station, row));
}

void raise(double& largest, double value) {
  largest = std::max(largest, value);
}

std::size_t cells(const SurfaceGrid& grid) {
  return (grid.x.size() - 1) * grid.quad.size();
}

}  // namespace

SurfaceFields::SurfaceFields(const SurfaceGrid& grid)
    : grid_(grid),
      max_pressure_(grid.nodes()),
      max_shear_(grid.nodes()),
      max_von_mises_(cells(grid)),
      frictional_work_(grid.nodes()),
      sampled_work_(grid.nodes()) {}

void SurfaceFields::add_step(const PatchNodes& patch) {
  for_each_node(patch, [&](std::size_t i, const NodalContact& node) {
    raise(max_pressure_[i], node.pressure);
    raise(max_shear_[i], node.shear_size());
    frictional_work_[i] += node.frictional_work;
  });
}

void SurfaceFields::add_sample(const PatchNodes& patch, double interval) {
  for_each_node(patch, [&](std::size_t i, const NodalContact& node) {
    sampled_work_[i] += interval * node.frictional_power;
  });
}

void SurfaceFields::add_stress(const PatchNodes& patch, const InternalForce& force, int block,
                               const Deformation& of) {
  patch.for_each_pressed_cell([&](int station, int row) {
    raise(max_von_mises_[grid_.cell(station, row)],
          von_mises(force.stress(block, grid_.quad[static_cast<std::size_t>(row)], station, of.displacement,
                                 of.lag, of.laws)));
  });
}

double SurfaceFields::sum(std::span<const double> per_area) const {
  double all = 0;
  for (int station = 0; station < grid_.stations(); ++station)
    for (int row = 0; row < grid_.rows(); ++row)
      all += grid_.area(station, row) * per_area[grid_.node(station, row)];
  return all;
}

std::int64_t SurfaceFields::bytes(const SurfaceGrid& grid) {
  return static_cast<std::int64_t>((4 * grid.nodes() + cells(grid)) * sizeof(double));
}

}  // namespace tread
