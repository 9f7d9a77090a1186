#pragma once
// Sums over all nodes and elements of a run on a device, for its energies and the mean motion of its wheel.

#include <vector>

#include "core/material.hpp"
#include "kernels/blocks/block_elements.hpp"
#include "kernels/device/device.hpp"
#include "kernels/device/host_array.hpp"
#include "kernels/device/march_fan.hpp"
#include "kernels/update/body_motion.hpp"

namespace tread {

/// Sums over all nodes. [NodeSum]
struct NodeSums {
  double fixed_kinetic = 0;       ///< kinetic energy of bodies that do not spin [J]
  double fixed_moment = 0;        ///< their mass times upward displacement [kg m]
  double spinning_kinetic = 0;    ///< kinetic energy of the spinning body [J]
  double excess = 0;              ///< sum_excess of all bodies [J]
  Vec3 displacement, velocity;    ///< of the spinning body, times mass [kg m], [kg m/s]
  double rotation = 0, spin = 0;  ///< likewise, times radius [kg m2], [kg m2/s]
};

/// The mean motion of the spinning body.
inline MeanMotion mean_of(const SpinningBody& body, const NodeSums& sums) {
  return {(1 / body.mass()) * sums.displacement, (1 / body.mass()) * sums.velocity,
          sums.rotation / body.inertia(), sums.spin / body.inertia()};
}

/// Sums over all elements. [ElementSum]
struct ElementSums {
  double stored = 0, dissipated = 0, branch = 0;  ///< [J]
  double power = 0;                               ///< [W]
};

template <class Real, class U>
class DeviceSums {
 public:
  /// Copies what it needs; keeps references to the device and the mesh. `mass`: by slot [kg]; `fixed`:
  /// unknowns that forces do not move.
  DeviceSums(Device& device, const Mesh& mesh, const double* mass, const std::vector<std::int64_t>& fixed);
  /// Quads of the next block, in the order of blocks.
  void add(const BlockElements<Real>& elements);

  /// On the device, by slot [kg].
  const double* mass() const { return mass_.data(); }

  /// The times of a motion.
  struct Instant {
    BodyFrame frame;         ///< of the spinning body, at the time of the displacements
    const StepLoads& loads;  ///< of the step that has led there
  };
  /// `before`: a step ago; null: without NodeSums::excess.
  NodeSums nodes(MarchFan<Real, U>& marches, const Instant& at, const Real* inverse_mass,
                 const NodeMotions<Real, U>& motion, const NodeMotions<Real, U>& before);

  /// Elements of a block, and what they have besides displacements.
  struct ElementFields {
    const U* u = nullptr;
    const Real* lag = nullptr;  ///< ElementSumTask::lag
    const MaxwellBranch* branch = nullptr;
    const Real* state = nullptr;  ///< ElementSumTask::state
  };
  template <class FieldsOf>
  ElementSums elements(MarchFan<Real, U>& marches, const FieldsOf& fields_of) {
    std::int64_t part = 0;
    for (int b = 0; b < marches.blocks(); ++b) part = sum_block(marches, b, fields_of(b), part);
    marches.join();
    fold(element_sums, part, part);
    return {folded(0, sum_stored), folded(0, sum_dissipated), folded(0, sum_branch), folded(0, sum_power)};
  }

  /// The nodes of a block, for FieldKernels::anchor.
  AnchoredNodes<Real> anchored(const MarchBlock<Real>& block, int number, const Anchoring& anchoring) const {
    const Of& of = blocks_[static_cast<std::size_t>(number)];
    return {block, of.y.data(), of.radius.data(), anchoring};
  }

  static std::int64_t bytes(const Mesh& mesh);

 private:
  struct Of {
    const SweptBlock* swept;
    DeviceArray<int> corner;        ///< [place][4]
    DeviceArray<double> y, radius;  ///< by section node (revolved) [m]
  };
  std::int64_t sum_block(MarchFan<Real, U>& marches, int block, const ElementFields& fields,
                         std::int64_t first_part);
  void fold(int values, std::int64_t split, std::int64_t end);
  double folded(int half, int value) const;

  Device* device_;
  FieldKernels<Real, U>* kernels_;
  const Mesh* mesh_;
  std::vector<Of> blocks_;
  DeviceArray<double> mass_;
  DeviceArray<unsigned char> fixed_;
  DeviceArray<double> parts_;
  DeviceArray<double> device_folds_;
  HostArray<double> folds_;
  int values_ = 0;  ///< of the last fold
};

extern template class DeviceSums<double, double>;
extern template class DeviceSums<float, double>;
extern template class DeviceSums<float, float>;

}  // namespace tread
