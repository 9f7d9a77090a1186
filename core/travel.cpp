#include "core/travel.hpp"

#include <algorithm>
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

}  // namespace

double DrivenWheel::acceleration(const MotionSpec& motion) const {
  if (guided) return 0;
  const double wanted =
      motion.traction_mu ? *motion.traction_mu * load : motion.traction_torque.value_or(0) / radius;
  return std::clamp(wanted, -friction * load, friction * load) / mass;
}

double carried_load(const Scene& scene) {
  if (scene.vehicle) return (scene.vehicle->sprung_mass + scene.vehicle->unsprung_mass) * scene.gravity;
  return scene.load ? scene.load->wheel_load : 0;
}

DrivenWheel driven_wheel(const Scene& scene) {
  const WheelSpec& wheel = *scene.wheel;
  const auto& vehicle = scene.vehicle;
  const double own = wheel_mass(scene);
  return {carried_load(scene) + own * scene.gravity, own + (vehicle ? vehicle->mass_along() : 0),
          0.5 * wheel.diameter, scene.contact ? scene.contact->largest_friction() : 0,
          wheel.bore == "guided"};
}

Travel travel_of(const Scene& scene) {
  constexpr int kParts = 1000;
  const double start = scene.start_x();
  Travel travel{start, start};
  if (!scene.wheel || !scene.motion) return travel;
  const MotionSpec& motion = *scene.motion;
  const double acceleration = driven_wheel(scene).acceleration(motion);
  const double dt = motion.duration / kParts;
  double gained_speed = 0;
  double gained_way = 0;
  for (int i = 0; i < kParts; ++i) {
    const double gain = acceleration * motion.torque_share((i + 0.5) * dt) * dt;
    gained_way += (gained_speed + 0.5 * gain) * dt;
    gained_speed += gain;
    const double x = start + motion.speed * (i + 1) * dt + gained_way;
    travel.first = std::min(travel.first, x);
    travel.last = std::max(travel.last, x);
  }
  return travel;
}

std::optional<double> duration_to(const Scene& scene, double x) {
  constexpr double kSlowest = 1e-3;  // [m/s]
  constexpr double kNear = 1e-6;     // [m]
  constexpr int kTries = 100;        // each takes the lacking way at motion.speed
  Scene longer = scene;
  double& duration = longer.motion->duration;
  for (int i = 0; i < kTries; ++i) {
    const double lacking = x - travel_of(longer).last;
    if (lacking <= kNear) {
      const double digit = std::pow(10.0, std::floor(std::log10(duration)) - 3);
      duration = std::round(duration / digit) * digit;
      return travel_of(longer).last >= x ? duration : duration + digit;
    }
    duration += lacking / std::max(longer.motion->speed, kSlowest);
  }
  return std::nullopt;
}

}  // namespace tread
