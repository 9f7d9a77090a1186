#include "kernels/device/device_sums.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "core/index.hpp"

namespace tread {

namespace {

std::int64_t threads_over(std::int64_t tiles, std::int64_t items, int of_thread) {
  return tiles * ((items + of_thread - 1) / of_thread) * kLanes;
}

/// Values of the parts of all sums of a mesh: of those over nodes, or of those over elements.
std::size_t part_values(const Mesh& mesh) {
  std::int64_t of_nodes = 0;
  std::int64_t of_elements = 0;
  for (const SweptBlock& block : mesh.blocks) {
    const std::int64_t tiles = std::ssize(block.tiles);
    of_nodes += threads_over(tiles, block.section.nodes(), NodeSumTask<double, double>::kNodes);
    of_elements +=
        threads_over(tiles, std::ssize(block.section.quads), ElementSumTask<double, double>::kQuads);
  }
  return index(std::max(node_sums * of_nodes, element_sums * of_elements));
}

}  // namespace

template <class Real, class U>
DeviceSums<Real, U>::DeviceSums(Device& device, const Mesh& mesh, const double* mass,
                                const std::vector<std::int64_t>& fixed)
    : device_(&device),
      kernels_(&device.kernels<Real, U>()),
      mesh_(&mesh),
      mass_(device, std::span(mass, index(mesh.slots))),
      parts_(device, part_values(mesh)),
      device_folds_(device, std::size_t{2} * node_sums * FoldTask::kFolds),
      folds_(device, device_folds_.size()) {
  std::vector<unsigned char> bits(index(mesh.slots), 0);
  for (const std::int64_t unknown : fixed)
    bits[index(slot_of(unknown))] |= static_cast<unsigned char>(1U << component_of(unknown));
  fixed_ = DeviceArray<unsigned char>(device, std::span<const unsigned char>(bits));
}

template <class Real, class U>
void DeviceSums<Real, U>::add(const BlockElements<Real>& elements) {
  const SweptBlock& block = elements.block();
  std::vector<int> corners;
  for (const FrontPlan::Quad& entry : elements.plan().quads) {
    const auto& quad = block.section.quads[index(entry.quad)];
    corners.insert(corners.end(), quad.begin(), quad.end());
  }
  Of of{&block, DeviceArray<int>(*device_, std::span<const int>(corners)), {}, {}};
  if (block.sweep == Sweep::revolved) {
    of.y = DeviceArray<double>(*device_, std::span<const double>(block.section.p));
    of.radius = DeviceArray<double>(*device_, std::span<const double>(block.section.q));
  }
  blocks_.push_back(std::move(of));
}

/// Blocks that do not spin come first.
template <class Real, class U>
NodeSums DeviceSums<Real, U>::nodes(MarchFan<Real, U>& marches, const Instant& at, const Real* inverse_mass,
                                    const NodeMotions<Real, U>& motion, const NodeMotions<Real, U>& before) {
  std::int64_t split = 0;
  std::int64_t end = 0;
  for (const Sweep sweep : {Sweep::extruded, Sweep::revolved}) {
    split = end;
    for (int b = 0; b < marches.blocks(); ++b) {
      const Of& of = blocks_[index(b)];
      if (of.swept->sweep != sweep) continue;
      NodeSumTask<Real, U> task;
      task.block = marches.block(b).at(at.loads);
      task.spins = sweep == Sweep::revolved;
      task.vertical_only = of.swept->vertical_only;
      task.mass = mass_.data();
      task.inverse_mass = inverse_mass;
      task.fixed = fixed_.data();
      task.radius = of.radius.data();
      task.motion = motion;
      task.before = before;
      task.frame = at.frame;
      task.half_frame = at.frame.after(-0.5 * at.loads.dt);
      task.to = {parts_.data(), static_cast<std::int64_t>(parts_.size()) / node_sums};
      task.first_part = end;
      const Beside beside(*device_, marches.queue(b));
      kernels_->sum_nodes(task);
      end += task.threads();
    }
  }
  marches.join();
  fold(node_sums, split, end);
  NodeSums sums;
  sums.fixed_kinetic = 0.5 * folded(0, sum_kinetic);
  sums.fixed_moment = folded(0, sum_displacement + 2);
  sums.spinning_kinetic = 0.5 * folded(1, sum_kinetic);
  sums.excess = folded(0, sum_excess) + folded(1, sum_excess);
  for (int c = 0; c < 3; ++c) {
    sums.displacement[c] = folded(1, sum_displacement + c);
    sums.velocity[c] = folded(1, sum_velocity + c);
  }
  sums.rotation = folded(1, sum_rotation);
  sums.spin = folded(1, sum_spin);
  return sums;
}

template <class Real, class U>
std::int64_t DeviceSums<Real, U>::sum_block(MarchFan<Real, U>& marches, int block,
                                            const ElementFields& fields, std::int64_t first_part) {
  ElementSumTask<Real, U> task;
  task.block = marches.block(block).at({});
  task.corner = blocks_[index(block)].corner.data();
  task.u = fields.u;
  task.lag = fields.lag;
  if (fields.branch != nullptr) {
    task.strength = fields.branch->strength;
    task.power = 2 / fields.branch->time;
  }
  task.state = fields.state;
  task.to = {parts_.data(), static_cast<std::int64_t>(parts_.size()) / element_sums};
  task.first_part = first_part;
  const Beside beside(*device_, marches.queue(block));
  kernels_->sum_elements(marches.variant(block), task);
  return first_part + task.threads();
}

template <class Real, class U>
void DeviceSums<Real, U>::fold(int values, std::int64_t split, std::int64_t end) {
  values_ = values;
  kernels_->fold({{parts_.data(), static_cast<std::int64_t>(parts_.size()) / values},
                  values,
                  split,
                  end,
                  device_folds_.data()});
  device_folds_.download(folds_.data(), std::size_t{2} * index(values) * FoldTask::kFolds);
}

template <class Real, class U>
double DeviceSums<Real, U>::folded(int half, int value) const {
  const double* const first = folds_.data() + std::ptrdiff_t{half * values_ + value} * FoldTask::kFolds;
  return std::accumulate(first, first + FoldTask::kFolds, 0.0);
}

template <class Real, class U>
std::int64_t DeviceSums<Real, U>::bytes(const Mesh& mesh) {
  const std::size_t values = part_values(mesh) + std::size_t{2} * node_sums * FoldTask::kFolds;
  return static_cast<std::int64_t>(sizeof(double) * (index(mesh.slots) + values)) + mesh.slots;
}

template class DeviceSums<double, double>;
template class DeviceSums<float, double>;
template class DeviceSums<float, float>;

}  // namespace tread
