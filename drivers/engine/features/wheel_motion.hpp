#pragma once
// The wheel as a whole: the motion of its frame, its creepage. [theory.md, Body frames]

#include <vector>

#include "drivers/engine/features/feature.hpp"
#include "kernels/connectors/connectors.hpp"
#include "kernels/connectors/guided_bore.hpp"
#include "kernels/contact/contact_surface.hpp"
#include "kernels/ties/tie.hpp"
#include "kernels/update/body_motion.hpp"

namespace tread {

inline constexpr double kLeastSpeed = 1e-3;  ///< below it nothing rolls [m/s]

/// Parts of the model that carry the wheel; absent ones are null.
struct WheelParts {
  const SpinningBody& body;
  const SweptBlock& tread;
  SurfaceKind surface = SurfaceKind::exact;  ///< of the tread
  GuidedBore* bore = nullptr;
  const Ties* ties = nullptr;
};

class WheelMotion final : public Feature {
 public:
  /// Keeps references. `patch_y`: centre of the preload's patch [m]; `gravity` [m/s2]
  WheelMotion(const WheelParts& parts, double patch_y, double gravity);

  /// Motion relative to the frame: of the guided bore, or else in the mean over the mass.
  MeanMotion relative_to_frame(const Motion& motion) const;

  const char* name() const override { return "wheel"; }
  std::vector<PhaseInfo> phases() const override;
  std::vector<FieldBytes> fields() const override;
  void apply(StepPhase phase, StepState& step) override;
  void meet(const StaticStart& start) override;
  void watch(const StepState& step, WatchedNodes& nodes) const override;
  void begin_sample(const StepState& step, Sample& sample) override;
  void end_sample(const StepState& step, Sample& sample) const override;
  void add_kinetic_energy(const Motion& motion, double& sum) const override;
  void add_momentum(const Motion& motion, Vec3& sum) const override;

 private:
  /// A point of the tread, between two nodes across it, whose speed makes the creepage.
  struct CreepagePoint {
    Attachment at;
    double angle;   ///< in the wheel [rad]
    double radius;  ///< [m]
  };
  void choose_creepage_points(double patch_y);
  /// Lets bore and tied nodes follow the frame, unless the latter do so where they live.
  void anchored(NodeField displacement, NodeField velocity, const WholeFields* whole) const;
  /// `mean`: relative_to_frame().
  double creepage(const CreepagePoint& point, const Motion& motion, const MeanMotion& mean) const;

  WheelParts parts_;
  double gravity_;  ///< [m/s2]
  std::vector<CreepagePoint> creepage_points_;
};

}  // namespace tread
