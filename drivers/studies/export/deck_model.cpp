#include "drivers/studies/export/deck_model.hpp"

#include <algorithm>

#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/start.hpp"
#include "drivers/results/frame_files.hpp"

namespace tread {

namespace {

AlignedVector<double> copy_of(ConstNodeField field, std::size_t values) {
  AlignedVector<double> copy(values);
  for (std::size_t i = 0; i < values; ++i) copy[i] = field[static_cast<std::int64_t>(i)];
  return copy;
}

}  // namespace

DeckModel::DeckModel(const Model& model, const DeckOptions& options, double step_of_program)
    : step(step_of_program),
      model_(&model),
      options_(options),
      grid_(make_vtk_grid(model.mesh, VtkCells::elements)),
      node_of_slot_(static_cast<std::size_t>(model.mesh.slots), 0),
      displacement_(static_cast<std::size_t>(3 * model.mesh.slots), 0.0),
      velocity_(displacement_) {
  for (const VtkGrid::Point& point : grid_.points)
    node_of_slot_[static_cast<std::size_t>(slot(point))] = static_cast<std::int32_t>(++numbers.node);
  if (options.preload) {
    const Simulation start(model, *options.preload, step);
    displacement_ = copy_of(start.displacement(), displacement_.size());
    velocity_ = copy_of(start.velocity(), velocity_.size());
    wheel_ = start.wheel();
    wheel_.origin.z -= options.overlap;
    return;
  }
  if (model.wheelset)
    wheel_.origin = resting_places(model)[static_cast<std::size_t>(model.index.tread)].origin;
  wheel_.origin.z -= options.overlap;
  start_velocities(model, Preload{}, {displacement_, velocity_, wheel_});
}

std::int64_t DeckModel::slot(const VtkGrid::Point& point) const {
  const SweptBlock& block = model_->mesh.blocks[static_cast<std::size_t>(point.block)];
  return block.base + block.slot(point.node, point.station);
}

Vec3 DeckModel::undeformed_place(const VtkGrid::Point& point) const {
  const SweptBlock& block = model_->mesh.blocks[static_cast<std::size_t>(point.block)];
  const Vec3 at = position(block, point.node, point.station);
  return block.sweep == Sweep::revolved ? wheel_.origin + at : at;
}

Vec3 DeckModel::place(const VtkGrid::Point& point) const {
  const SweptBlock& block = model_->mesh.blocks[static_cast<std::size_t>(point.block)];
  return undeformed_place(point) + to_cartesian(block, point.station, 0, displacement().at(slot(point)));
}

SprungStart DeckModel::sprung_start() const {
  return preloaded() ? tread::sprung_start(options_.preload->run_in) : SprungStart{};
}

bool DeckModel::rolls(const VtkGrid::Point& point) const {
  const SweptBlock& block = model_->mesh.blocks[static_cast<std::size_t>(point.block)];
  return !preloaded() && block.sweep == Sweep::revolved &&
         norm(ConstNodeField(velocity_.data()).at(slot(point))) == 0;
}

Vec3 DeckModel::velocity(const VtkGrid::Point& point) const {
  const SweptBlock& block = model_->mesh.blocks[static_cast<std::size_t>(point.block)];
  const Vec3 own = to_cartesian(block, point.station, 0, ConstNodeField(velocity_.data()).at(slot(point)));
  if (block.sweep == Sweep::extruded) return own;
  return wheel_.velocity + cross({0, wheel_.spin, 0}, place(point) - wheel_.origin) + own;
}

}  // namespace tread
