#include "drivers/engine/model/evaluated_stretch.hpp"

#include "core/travel.hpp"

namespace tread {

Span evaluated_stretch(const Scene& scene, const Corrugation& corrugation) {
  if (corrugation.smooth()) return {scene.zone_start, scene.zone_start + scene.zone_length};
  const double wave =
      scene.corrugation && scene.corrugation->kind == "sine" ? scene.corrugation->wavelength : 0;
  const double half_wave = corrugation.last() - corrugation.first() > 1.5 * wave ? 0.5 * wave : 0;
  return {corrugation.first() + half_wave, corrugation.last() - half_wave};
}

double settled_torque_time(const Scene& scene) {
  return (1.5 + 2 * scene.motion->reversals) * scene.motion->ramp;
}

double settled_torque_x(const Scene& scene) {
  Scene rising = scene;
  rising.motion->duration = settled_torque_time(scene);
  return travel_of(rising).last;
}

}  // namespace tread
