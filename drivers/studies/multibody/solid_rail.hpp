#pragma once
// The rail as the waves of its own section. [theory.md, Multi-body approach]

#include "core/scene.hpp"
#include "drivers/studies/multibody/force_region.hpp"
#include "drivers/studies/multibody/modal_beam.hpp"

namespace tread {

/// Modes below `top` [Hz] of the scene's upright rail that are even about its middle, by finite elements of
/// the section: bending, motion along, and those that deform the section. A force on the head acts on the
/// region; deflection and motion along of the foot are means over its width. The residual flexibility is that
/// of head and section beyond the modes, less that of a half-space. `element`: size of the elements of the
/// head [m]. [theory.md, eq. M7]
ModalBeam solid_rail(const Scene& scene, const ForceRegion& region, double top, double element);

}  // namespace tread
