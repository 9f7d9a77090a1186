#pragma once
// Copies of the motion of both running surfaces about the patch, from a device to the host.

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/contact/contact.hpp"
#include "kernels/device/device.hpp"
#include "kernels/device/host_array.hpp"

namespace tread {

template <class Real, class U>
class SurfaceCopies {
 public:
  /// With room for the whole surfaces. Keeps a reference to the device.
  SurfaceCopies(Device& device, const Mesh& mesh, const Contact& contact);

  /// Brings the values of these parts of both surfaces from the device's fields.
  void fetch(const std::array<SurfacePart, 2>& parts, const U* u, const Real* v);

  /// Groups of the whole surfaces.
  std::size_t capacity() const { return u_.size() / (3 * kLanes); }
  /// Number of a fetched group of kLanes slots among all, and its values, [component][lane].
  std::int64_t groups() const { return windows_.groups(); }
  std::int64_t group(std::int64_t i) const {
    const std::int64_t of_rail = windows_.of[0].groups();
    const std::size_t body = i < of_rail ? 0 : 1;
    return windows_.of[body].group(i < of_rail ? i : i - of_rail, nodes_[body].data() + first_node_[body]);
  }
  const U* u(std::int64_t i) const { return u_.data() + 3 * kLanes * i; }
  const Real* v(std::int64_t i) const { return v_.data() + 3 * kLanes * i; }

 private:
  Device* device_;
  std::array<const SweptBlock*, 2> blocks_;  ///< of rail and wheel
  std::array<std::vector<int>, 2> nodes_;    ///< section nodes by their ordinal along the surface
  std::array<DeviceArray<int>, 2> device_nodes_;
  std::array<int, 2> first_node_{};
  SurfaceWindows windows_;
  HostArray<U> u_;
  HostArray<Real> v_;
  DeviceArray<U> device_u_;
  DeviceArray<Real> device_v_;
};

extern template class SurfaceCopies<double, double>;
extern template class SurfaceCopies<float, double>;
extern template class SurfaceCopies<float, float>;

}  // namespace tread
