#pragma once
// Sections of the scene's bodies and the shapes that moved nodes give them.

#include "core/corrugation.hpp"
#include "core/mesh/rail_section.hpp"
#include "core/mesh/swept_block.hpp"
#include "core/mesh/wheel_section.hpp"
#include "core/scene.hpp"
#include "drivers/engine/model/station_plan.hpp"

namespace tread {

RailSections rail_sections(const Scene& scene, const MeshSizes& sizes);
Section box_rail_section(const Scene& scene, const MeshSizes& sizes);
/// A half sleeper; its path "left" lies in the track's middle. `top`: height of the rail's foot [m].
Section sleeper_section(const SleeperSpec& sleeper, double top, const MeshSizes& sizes);

/// `top`: height of the lowest point of the rail's foot, which the slab touches; the fastenings span what is
/// left [m].
Section slab_section(const SlabSpec& slab, double top, const MeshSizes& sizes);
Section tyre_section(const Scene& scene, const MeshSizes& sizes);

struct SizedWheel {
  WheelSections sections;
  double web_thickness = 0;         ///< [m]
  double brake_ring_thickness = 0;  ///< of each of the two plates; 0: there are none [m]
};

/// The web, or with WheelSpec::brake_rings the two plates on it, are as thick as WheelSpec::mass needs with
/// the plan's polygons; beside a disc from a file neither matters. InputError if no thickness does it, or if
/// a stated web alone makes another mass.
SizedWheel wheel_sections(const Scene& scene, const MeshSizes& sizes, const WheelPlan& plan);

/// The corrugation whose deepest line lies at y = `centre` [m].
Corrugation corrugation_of(const CorrugationSpec& spec, double centre);

/// Corrugation depth that the scene wants the searched surface to have room for at least, whatever its own
/// [m].
double depth_room(const Scene& scene);

/// The same of the scene with [forks] [m].
double forks_room(const Scene& scene);

/// Depth of the scene's corrugation; 0 without one [m].
double corrugation_depth(const Scene& scene);

/// Lowers the nodes of the running surface by the corrugation's depth and those below it by a share that
/// fades to nothing over `fade` [m] (node_shift).
void shift_top_layers(SweptBlock& block, const Corrugation& corrugation, double fade);

}  // namespace tread
