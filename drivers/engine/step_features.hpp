#pragma once
// The features that a model has, and the phases of its step.

#include <array>
#include <memory>
#include <vector>

#include "drivers/engine/features/feature.hpp"
#include "drivers/engine/features/surface_record.hpp"
#include "drivers/engine/features/vehicle.hpp"
#include "drivers/engine/features/wheel_motion.hpp"
#include "drivers/engine/fields/bodies.hpp"
#include "drivers/engine/measurements.hpp"
#include "drivers/engine/sampling.hpp"

namespace tread {

class StepFeatures {
 public:
  /// Features of the model, to which they keep references; none allocates a field of nodes. `patch_y`: centre
  /// of the preload's patch [m].
  StepFeatures(const Model& model, double patch_y);

  /// Features that work in a phase of the step, few or none.
  const std::vector<Feature*>& in(StepPhase phase) const {
    return by_phase_[static_cast<std::size_t>(phase)];
  }

  /// Declared phases in the order of the step.
  std::vector<PhaseInfo> phases() const;
  /// Fields of all features in the order of RunField.
  std::vector<FieldBytes> fields() const;

  const std::vector<std::unique_ptr<Feature>>& all() const { return all_; }
  /// Adds up the momentum of wheelset and vehicle [N s].
  Vec3 momentum(const Motion& motion) const;
  void list_state(StateList& list);
  void list_unshared_state(StateList& list);

  const Sampling& sampling() const { return *sampling_; }
  const Measurements& measurements() const { return *measurements_; }
  const WheelMotion* wheel() const { return wheel_; }      ///< null: absent
  const Vehicle* vehicle() const { return vehicle_; }      ///< null: absent
  const SurfaceRecord* record() const { return record_; }  ///< null: absent

 private:
  template <class F, class... Arguments>
  F* add(Arguments&&... arguments);
  void add_wheel(const Model& model, double patch_y);

  std::vector<std::unique_ptr<Feature>> all_;
  std::array<std::vector<Feature*>, kStepPhases> by_phase_;
  Bodies* bodies_ = nullptr;
  Sampling* sampling_ = nullptr;
  Measurements* measurements_ = nullptr;
  WheelMotion* wheel_ = nullptr;
  Vehicle* vehicle_ = nullptr;
  SurfaceRecord* record_ = nullptr;
};

}  // namespace tread
