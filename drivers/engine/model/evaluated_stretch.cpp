#include "drivers/engine/model/evaluated_stretch.hpp"

namespace tread {

Span evaluated_stretch(const Scene& scene, const Corrugation& corrugation) {
  if (corrugation.smooth()) return {scene.zone_start, scene.zone_start + scene.zone_length};
  const double wave =
      scene.corrugation && scene.corrugation->kind == "sine" ? scene.corrugation->wavelength : 0;
  const double half_wave = corrugation.last() - corrugation.first() > 1.5 * wave ? 0.5 * wave : 0;
  return {corrugation.first() + half_wave, corrugation.last() - half_wave};
}

double settled_torque_x(const Scene& scene) {
  return scene.start_x() + 1.5 * scene.motion->ramp * scene.motion->speed;
}

}  // namespace tread
