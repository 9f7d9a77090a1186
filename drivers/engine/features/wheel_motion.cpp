#include "drivers/engine/features/wheel_motion.hpp"

#include <algorithm>
#include <cmath>

namespace tread {

namespace {

constexpr std::int64_t kAnchorInterval = 256;  ///< steps between looks at the wheel's mean motion
constexpr int kCreepagePoints = 28;            ///< [paper, section 4.2]

/// Creepage of a rim at the speed `rim` against an axle at `speed`, over the size of their mean. Without a
/// rolling speed there is none: at rest, or when the rim runs backwards as fast as the axle forwards. [paper,
/// eq. (3)]
double creepage_of(double rim, double speed) {
  const double rolling = 0.5 * (rim + speed);
  return std::abs(rolling) > kLeastSpeed ? (rim - speed) / std::abs(rolling) : 0.0;
}

}  // namespace

WheelMotion::WheelMotion(const WheelParts& parts, double patch_y, double gravity)
    : parts_(parts), gravity_(gravity) {
  choose_creepage_points(patch_y);
}

/// Points of the tread at the patch's y, spread evenly around; the first starts in the patch.
void WheelMotion::choose_creepage_points(double patch_y) {
  const SweptBlock& block = parts_.tread;
  const SurfaceProfile profile(block.section);
  const double y = std::clamp(patch_y, profile.first_p(), profile.last_p());
  const int edge = profile.edge_at(y);
  const double share = (y - profile.edge_p(edge, 0)) / (profile.edge_p(edge, 1) - profile.edge_p(edge, 0));
  const double radius = profile.evaluate(edge, share, parts_.surface).q;
  const StationFinder finder(block);
  for (int k = 0; k < (parts_.bore ? 1 : kCreepagePoints); ++k) {
    const int station = finder.find(2 * M_PI * k / kCreepagePoints).station;
    Attachment at;
    for (std::size_t end = 0; end < 2; ++end) {
      at.slot[end] = block.base + block.slot(profile.node(edge + static_cast<int>(end)), station);
      at.weight[end] = end == 0 ? 1 - share : share;
    }
    creepage_points_.push_back({at, block.stations[static_cast<std::size_t>(station)], radius});
  }
}

std::vector<PhaseInfo> WheelMotion::phases() const {
  return {{StepPhase::frame, "frame of the wheel", {RunField::wheel_frame}, {RunField::wheel_frame}},
          {StepPhase::anchor,
           "mean motion of the wheel",
           {RunField::mass, RunField::displacement, RunField::velocity, RunField::wheel_frame},
           {RunField::wheel_frame, RunField::displacement, RunField::velocity}}};
}

std::vector<FieldBytes> WheelMotion::fields() const {
  return {{RunField::wheel_frame, static_cast<std::int64_t>(sizeof(BodyFrame))}};
}

void WheelMotion::apply(StepPhase phase, StepState& step) {
  if (phase == StepPhase::frame) {
    step.wheel.advance(step.dt);
  } else if ((step.steps + 1) % kAnchorInterval == 0) {
    step.whole.anchor(parts_.body, relative_to_frame(step.motion()), step.wheel, step.dt);
    anchored(step.displacement, step.velocity, &step.whole);
  }
}

/// At rest the wheel spins about its own displaced axis from the first instant on.
void WheelMotion::meet(const StaticStart& start) {
  const MeanMotion mean = parts_.bore
                              ? parts_.bore->motion()
                              : parts_.body.mean_motion(start.displacement, start.velocity, start.wheel);
  parts_.body.anchor(mean, start.displacement, start.velocity, start.wheel, start.dt);
  anchored(start.displacement, start.velocity, nullptr);
}

/// `whole`: null while the views hold all values.
void WheelMotion::anchored(NodeField displacement, NodeField velocity, const WholeFields* whole) const {
  if (parts_.bore) parts_.bore->anchored();
  if (!parts_.ties || (whole != nullptr && whole->ties_follow())) return;
  parts_.ties->follow({displacement, velocity}, whole != nullptr ? whole->tie_items() : nullptr);
}

MeanMotion WheelMotion::relative_to_frame(const Motion& motion) const {
  return parts_.bore ? parts_.bore->motion() : motion.whole.mean_motion(parts_.body, motion.wheel);
}

double WheelMotion::creepage(const CreepagePoint& point, const Motion& motion, const MeanMotion& mean) const {
  const BodyFrame& frame = motion.wheel;
  const double carried = cartesian_to_cylindrical(point.angle + frame.angle, mean.velocity).x;
  const double rise = point.at.value(motion.displacement, 2);
  const double speed = point.at.value(motion.velocity, 0) - carried + frame.spin * (point.radius + rise);
  return creepage_of(speed, frame.velocity.x + mean.velocity.x);
}

void WheelMotion::watch(const StepState& /*step*/, WatchedNodes& nodes) const {
  for (const CreepagePoint& point : creepage_points_)
    for (const std::int64_t slot : point.at.slot) nodes.add(slot);
}

void WheelMotion::begin_sample(const StepState& step, Sample& sample) {
  const MeanMotion mean = step.whole.mean_motion(parts_.body, step.wheel);
  const double height =
      step.wheel.origin.z + parts_.body.eccentric_height(step.wheel.angle) + mean.displacement.z;
  sample.energy.gravity += gravity_ * parts_.body.mass() * height;
  sample.wheel_x = step.wheel.origin.x;
  sample.wheel_z = step.wheel.origin.z;
}

void WheelMotion::end_sample(const StepState& step, Sample& sample) const {
  const Motion motion = step.motion();
  const MeanMotion mean = relative_to_frame(motion);
  sample.wheel_speed = motion.wheel.velocity.x + mean.velocity.x;
  sample.wheel_spin = motion.wheel.spin + mean.spin;
  const double speed = std::abs(sample.wheel_speed);
  sample.lateral_creepage = speed > kLeastSpeed ? mean.velocity.y / speed : 0.0;
  sample.creepage_node = creepage(creepage_points_.front(), motion, mean);
  double sum = 0;
  for (const CreepagePoint& point : creepage_points_) sum += creepage(point, motion, mean);
  sample.creepage_mean =
      parts_.bore ? creepage_of(sample.wheel_spin * creepage_points_.front().radius, sample.wheel_speed)
                  : sum / static_cast<double>(creepage_points_.size());
}

void WheelMotion::add_kinetic_energy(const Motion& motion, double& sum) const {
  sum += motion.whole.kinetic_energy(parts_.body, motion.wheel, motion.dt);
}

void WheelMotion::add_momentum(const Motion& motion, Vec3& sum) const {
  sum += parts_.body.momentum(motion.displacement, motion.velocity, motion.half_step_frame());
}

}  // namespace tread
