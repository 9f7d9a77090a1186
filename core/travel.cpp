#include "core/travel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tread {
namespace {

/// Mass of the scene's wheel. [kg]
double wheel_mass(const Scene& scene) {
  const WheelSpec& wheel = *scene.wheel;
  if (wheel.shape == "half_wheelset") return wheel.mass;
  const double outer = 0.5 * wheel.diameter;
  const double inner = outer - wheel.thickness;
  return scene.wheel_material().density * std::numbers::pi * (outer * outer - inner * inner) * wheel.width;
}

/// Speed and way beyond those of constant speed.
struct Gain {
  double full;  ///< acceleration under the full torque [m/s^2]
  double slip;  ///< speed that the slip of the start has still to give [m/s]
  double speed = 0;
  double way = 0;

  /// Goes on for dt [s] under a share of the full torque. Slip takes the rest of what friction can give,
  /// `grip` [m/s^2].
  void advance(double share, double grip, double dt) {
    const double acceleration = full * share;
    const double of_slip = std::clamp(slip, (-grip - acceleration) * dt, (grip - acceleration) * dt);
    slip -= of_slip;
    const double gain = acceleration * dt + of_slip;
    way += (speed + 0.5 * gain) * dt;
    speed += gain;
  }
};

/// Acceleration under the full traction, with the coefficient of friction f; of a torque, a part counts
/// [m/s^2].
double accelerated(const DrivenWheel& wheel, const MotionSpec& motion, double f, double part) {
  if (wheel.guided) return 0;
  const double load = wheel.load;
  const double wanted = motion.traction_mu ? *motion.traction_mu * load
                                           : part * motion.traction_torque.value_or(0) / wheel.radius;
  return std::clamp(wanted, -f * load, f * load) / wheel.mass;
}

}  // namespace

double DrivenWheel::acceleration(const MotionSpec& motion) const {
  return accelerated(*this, motion, friction, 1);
}

double DrivenWheel::least_acceleration(const MotionSpec& motion) const {
  return accelerated(*this, motion, least_friction, mass / (mass + own_mass));
}

double DrivenWheel::speed_of_slip(const MotionSpec& motion) const {
  if (guided) return 0;
  return motion.speed * (motion.spin_ratio() - 1) / (1 + mass / own_mass);
}

double carried_load(const Scene& scene) {
  if (scene.vehicle) return (scene.vehicle->sprung_mass + scene.vehicle->unsprung_mass) * scene.gravity;
  return scene.load ? scene.load->wheel_load : 0;
}

DrivenWheel driven_wheel(const Scene& scene) {
  const WheelSpec& wheel = *scene.wheel;
  const auto& vehicle = scene.vehicle;
  const double own = wheel_mass(scene);
  return {carried_load(scene) + own * scene.gravity,
          own + (vehicle ? vehicle->mass_along() : 0),
          0.5 * wheel.diameter,
          scene.contact ? scene.contact->largest_friction() : 0,
          wheel.bore == "guided",
          own,
          scene.contact ? scene.contact->least_friction() : 0};
}

Travel travel_of(const Scene& scene) {
  constexpr int kParts = 1000;
  const double start = scene.start_x();
  Travel travel{start, start, start};
  if (!scene.wheel || !scene.motion) return travel;
  const MotionSpec& motion = *scene.motion;
  const DrivenWheel wheel = driven_wheel(scene);
  const double most = wheel.acceleration(motion), least = wheel.least_acceleration(motion);
  const double grip = wheel.grip(), slip = wheel.speed_of_slip(motion);
  const double dt = motion.duration / kParts;
  // A torque turns into its opposite, but the wheel's inertia stays: `most` or `least` all along.
  std::array<Gain, 2> behind{Gain{most, std::min(slip, 0.0)}, Gain{least, std::min(slip, 0.0)}};
  std::array<Gain, 2> ahead{Gain{most, std::max(slip, 0.0)}, Gain{least, std::max(slip, 0.0)}};
  for (int i = 0; i < kParts; ++i) {
    const double share = motion.torque_share((i + 0.5) * dt);
    for (Gain& gain : behind) gain.advance(share, grip, dt);
    for (Gain& gain : ahead) gain.advance(share, grip, dt);
    const double rolled = start + motion.speed * (i + 1) * dt;
    const double rear = rolled + std::min(behind[0].way, behind[1].way);
    travel.first = std::min(travel.first, rear);
    travel.last = std::max(travel.last, rolled + std::max(ahead[0].way, ahead[1].way));
    travel.sure = std::max(travel.sure, rear);
  }
  return travel;
}

std::optional<double> duration_to(const Scene& scene, double x) {
  constexpr double kShortest = 1e-9;  // [s]; parts of a duration far too long would hide an early turn
  constexpr int kDoublings = 60;
  Scene tried = scene;
  double& duration = tried.motion->duration;
  duration = kShortest;
  const auto suffices = [&] { return travel_of(tried).sure >= x; };
  double below = 0;
  for (int i = 0; !suffices(); ++i) {
    if (i == kDoublings) return std::nullopt;
    below = duration;
    duration *= 2;
  }
  const double digit = std::pow(10.0, std::floor(std::log10(duration)) - 3);
  double enough = std::ceil(duration / digit), too_few = std::floor(below / digit);
  while (enough - too_few > 1) {
    const double middle = std::floor(0.5 * (too_few + enough));
    duration = middle * digit;
    (suffices() ? enough : too_few) = middle;
  }
  return enough * digit;
}

}  // namespace tread
