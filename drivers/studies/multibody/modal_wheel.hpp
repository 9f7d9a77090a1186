#pragma once
// The wheelset as its lowest modes under a force at the contact, and what yields beyond them.
// [theory.md, Multi-body approach]

#include <vector>

#include "core/scene.hpp"
#include "drivers/studies/multibody/force_region.hpp"

namespace tread {

/// An elastic motion of the wheelset. A wave around the axis has a companion a quarter wave further, to which
/// the spin couples it.
struct WheelMode {
  int waves = 0;         ///< around the axis
  double omega = 0;      ///< angular frequency without spin [rad/s]
  double amplitude = 0;  ///< motion of the contact [kg^-1/2]
  double turning = 0;    ///< coupling to the companion [-]
};

/// A wheel without modes is a mass.
struct ModalWheel {
  double mass = 0;  ///< of the rigid motion, the unsprung mass included [kg]
  std::vector<WheelMode> modes;
  double top = 0;          ///< frequency below which it has modes [Hz]
  double flexibility = 0;  ///< of the motions beyond the modes, less that of a half-space [m/N]
  double spin = 0;         ///< [rad/s]
};

/// Modes of the scene's half wheelset below `top` [Hz], its journal carrying the unsprung mass, under a
/// vertical force on the region at the bottom of the tread. `element`: size of the elements at the tread [m].
/// [theory.md, eq. M6]
ModalWheel modal_wheel(const Scene& scene, const ForceRegion& region, double top, double element);

}  // namespace tread
