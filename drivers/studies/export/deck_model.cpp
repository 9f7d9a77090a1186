#include "drivers/studies/export/deck_model.hpp"

#include <algorithm>

#include "drivers/engine/start.hpp"
#include "drivers/results/frame_files.hpp"

namespace tread {

DeckModel::DeckModel(const Model& model, const DeckOptions& options)
    : model_(&model),
      options_(options),
      grid_(make_vtk_grid(model.mesh, VtkCells::elements)),
      node_of_slot_(static_cast<std::size_t>(model.mesh.slots), 0),
      velocity_(static_cast<std::size_t>(3 * model.mesh.slots), 0.0) {
  for (const VtkGrid::Point& point : grid_.points)
    node_of_slot_[static_cast<std::size_t>(slot(point))] = static_cast<std::int32_t>(++numbers.node);
  if (model.wheelset)
    wheel_.origin = resting_places(model)[static_cast<std::size_t>(model.index.tread)].origin;
  AlignedVector<double> displacement(velocity_.size(), 0.0);
  start_velocities(model, Preload{}, {displacement, velocity_, wheel_});
}

std::int64_t DeckModel::slot(const VtkGrid::Point& point) const {
  const SweptBlock& block = model_->mesh.blocks[static_cast<std::size_t>(point.block)];
  return block.base + block.slot(point.node, point.station);
}

Vec3 DeckModel::place(const VtkGrid::Point& point) const {
  const SweptBlock& block = model_->mesh.blocks[static_cast<std::size_t>(point.block)];
  const Vec3 at = position(block, point.node, point.station);
  return block.sweep == Sweep::revolved ? wheel_.origin + at : at;
}

bool DeckModel::rolls(const VtkGrid::Point& point) const {
  return model_->mesh.blocks[static_cast<std::size_t>(point.block)].sweep == Sweep::revolved &&
         norm(ConstNodeField(velocity_.data()).at(slot(point))) == 0;
}

Vec3 DeckModel::velocity(const VtkGrid::Point& point) const {
  const SweptBlock& block = model_->mesh.blocks[static_cast<std::size_t>(point.block)];
  const Vec3 own = to_cartesian(block, point.station, 0, ConstNodeField(velocity_.data()).at(slot(point)));
  if (block.sweep == Sweep::extruded) return own;
  return wheel_.velocity + cross({0, wheel_.spin, 0}, position(block, point.node, point.station)) + own;
}

}  // namespace tread
