#pragma once
// Sums over a run's motion on a device: for looks at the energies, and for the mean motion of the wheel.

#include <optional>
#include <vector>

#include "core/contract.hpp"
#include "drivers/engine/model/model.hpp"
#include "kernels/device/device_sums.hpp"

namespace tread {

template <class Real, class U>
class DeviceLooks {
 public:
  /// Fields of the device.
  struct Motions {
    NodeMotions<Real, U> present;
    NodeMotions<Real, U> before;  ///< a step ago; in measured steps alone
    const Real* inverse_mass;
  };

  /// `unforced`: unknowns that forces do not move.
  DeviceLooks(Device& device, const Model& model, const std::vector<std::int64_t>& unforced)
      : sums_(device, model.mesh, model.mass.data(), unforced) {}

  DeviceSums<Real, U>& sums() { return sums_; }

  /// The forces of a step are at hand: until close(), sums are those of the motion before it.
  void open(const StepLoads& loads, bool measured);
  void close();
  /// The motion has changed.
  void forget() { nodes_.reset(); }
  bool opening() const { return opening_; }
  bool measured() const { return measured_; }

  /// `wheel`: its frame at the time of the displacements.
  const NodeSums& nodes(MarchFan<Real, U>& marches, const Motions& of, const BodyFrame& wheel);
  /// For sums that do not depend on the wheel's frame.
  const NodeSums& nodes(MarchFan<Real, U>& marches, const Motions& of);

  /// While it opens; fields_of(block): DeviceSums::ElementFields.
  template <class FieldsOf>
  const ElementSums& elements(MarchFan<Real, U>& marches, const FieldsOf& fields_of) {
    TREAD_EXPECT(opening_);
    if (!elements_) elements_ = sums_.elements(marches, fields_of);
    return *elements_;
  }

 private:
  struct NodesAt {
    BodyFrame wheel;
    NodeSums sums;
  };

  DeviceSums<Real, U> sums_;
  StepLoads loads_;  ///< of the step
  bool measured_ = false, opening_ = false;
  std::optional<NodesAt> nodes_;
  std::optional<ElementSums> elements_;
};

extern template class DeviceLooks<double, double>;
extern template class DeviceLooks<float, double>;
extern template class DeviceLooks<float, float>;

}  // namespace tread
