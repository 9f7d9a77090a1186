#include "drivers/engine/device/device_looks.hpp"

namespace tread {

template <class Real, class U>
void DeviceLooks<Real, U>::open(const StepLoads& loads, bool measured) {
  loads_ = loads;
  measured_ = measured;
  opening_ = true;
  nodes_.reset();
  elements_.reset();
}

template <class Real, class U>
void DeviceLooks<Real, U>::close() {
  opening_ = false;
  nodes_.reset();
}

template <class Real, class U>
const NodeSums& DeviceLooks<Real, U>::nodes(MarchFan<Real, U>& marches, const Motions& of,
                                            const BodyFrame& wheel) {
  if (nodes_ && nodes_->wheel == wheel) return nodes_->sums;
  const bool changes = measured_ && !opening_;
  nodes_ = {wheel, sums_.nodes(marches, {wheel, loads_}, of.inverse_mass, opening_ ? of.before : of.present,
                               changes ? of.before : NodeMotions<Real, U>{})};
  return nodes_->sums;
}

template <class Real, class U>
const NodeSums& DeviceLooks<Real, U>::nodes(MarchFan<Real, U>& marches, const Motions& of) {
  if (nodes_) return nodes_->sums;
  return nodes(marches, of, opening_ ? loads_.frame : loads_.frame.after(loads_.dt));
}

template class DeviceLooks<double, double>;
template class DeviceLooks<float, double>;
template class DeviceLooks<float, float>;

}  // namespace tread
