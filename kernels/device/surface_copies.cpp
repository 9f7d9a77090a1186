#include "kernels/device/surface_copies.hpp"

#include <span>

#include "core/index.hpp"

namespace tread {

template <class Real, class U>
SurfaceCopies<Real, U>::SurfaceCopies(Device& device, const Mesh& mesh, const Contact& contact)
    : device_(&device),
      blocks_{&mesh.blocks[index(contact.options().rail_block)],
              &mesh.blocks[index(contact.options().wheel_block)]} {
  std::size_t values = 0;
  for (const std::size_t body : {0, 1}) {
    const SurfaceProfile profile(blocks_[body]->section);
    for (int ordinal = 0; ordinal <= profile.edges(); ++ordinal)
      nodes_[body].push_back(profile.node(ordinal));
    device_nodes_[body] = DeviceArray<int>(device, std::span<const int>(nodes_[body]));
    values += 3 * kLanes * nodes_[body].size() * blocks_[body]->tiles.size();
  }
  u_ = HostArray<U>(device, values);
  v_ = HostArray<Real>(device, values);
  device_u_ = DeviceArray<U>(device, values);
  device_v_ = DeviceArray<Real>(device, values);
}

template <class Real, class U>
void SurfaceCopies<Real, U>::fetch(const std::array<SurfacePart, 2>& parts, const U* u, const Real* v) {
  for (const std::size_t body : {0, 1}) {
    const SurfacePart& part = parts[body];
    const SweptBlock& block = *blocks_[body];
    SurfaceWindow& window = windows_.of[body];
    const TileSpan tiles = tiles_of(block, part);
    first_node_[body] = part.first_node;
    window = {device_nodes_[body].data() + part.first_node,
              part.last_node - part.first_node,
              block.base / kLanes,
              block.section.nodes(),
              static_cast<int>(block.tiles.size()),
              tiles.first,
              tiles.count};
  }
  device_->kernels<Real, U>().collect(windows_, u, v, device_u_.data(), device_v_.data());
  const std::size_t values = 3 * kLanes * index(windows_.groups());
  device_u_.download(u_.data(), values);
  device_v_.download(v_.data(), values);
}

template class SurfaceCopies<double, double>;
template class SurfaceCopies<float, double>;
template class SurfaceCopies<float, float>;

}  // namespace tread
