#pragma once
// The beam that bends as a scene's rail does.

#include <vector>

#include "core/scene.hpp"
#include "drivers/engine/beam/beam_section.hpp"
#include "drivers/engine/beam/track_beam.hpp"

namespace tread {

/// Beam section of the scene's rail, upright, on a fine section mesh whatever the mesh of the scene.
/// InputError without [rail].
BeamSection rail_beam_section(const Scene& scene);

/// Returns true if a part of the rail is of the beam's material, rail.material, to a hundredth.
bool is_of_the_beam(const Scene& scene, const Material& part);

/// The columns of a scene's fastenings, and of so many more fastenings to their left; none without
/// [fastenings]. InputError without rail.
std::vector<BeamSupport> rail_supports(const Scene& scene, int more_spans = 0);

/// The fastenings of a scene, one spring-damper each, on rigid sleepers, and of so many more to their left;
/// none without [sleepers].
std::vector<SleeperSupport> rail_sleepers(const Scene& scene, int more_spans = 0);

/// The columns as spring-dampers of the foot along x, where the fastenings are elastic along x; else none.
std::vector<BeamSupport> rail_foot_supports(const Scene& scene, int more_spans = 0);

/// The stretches over which the fastenings hold the foot along x: pads or columns; none where they do not.
std::vector<FootStretch> rail_foot_holds(const Scene& scene, int more_spans = 0);

/// Mass of a half sleeper of the scene [kg].
double sleeper_mass(const Scene& scene);

/// Spread of forces on the head before the fastenings see them: at the wave number of a span; 0 for a
/// line or without [fastenings]. [m]
double head_spread(const Scene& scene, const BeamProperties& properties);

/// The rail of a scene: its section, its length, its fastenings' columns on rigid ground, or one
/// spring-damper a fastening on a rigid sleeper, the foot held along x as they hold it, forces on the head
/// spread by `head_spread`; to its left it goes on for so many more spans. InputError without [rail].
TrackBeam rail_beam(const Scene& scene, const BeamProperties& properties, int more_spans = 0);

/// Deflection of that beam at x [m] under a force on its head there [N] and the own weight of rail and
/// sleepers, all supports alike. InputError without [rail]. [m]
double loaded_deflection(const Scene& scene, double x, double force);

}  // namespace tread
