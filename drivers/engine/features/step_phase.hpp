#pragma once
// Phases of a step in their order. Simulation, inventory and `tread bench hotspots` go by this list.

#include <cstddef>

namespace tread {

enum class StepPhase {
  contact_search,
  internal_force,  ///< with the motion of nodes on which nothing else acts
  energies,        ///< of the elements' forces alone, in some steps
  tied_forces,
  fastenings,
  suspension,
  wheel_load,
  torque,
  hammer,
  unsprung_mass,
  update,  ///< motion of the other nodes
  guided_bore,
  contact_tractions,
  tied_motion,
  branch_lag,
  frame,
  surface_fields,
  samples,  ///< in some steps
  anchor,   ///< in some steps
};
inline constexpr std::size_t kStepPhases = static_cast<std::size_t>(StepPhase::anchor) + 1;

/// Name in tables: "internal force".
const char* name_of(StepPhase phase);

}  // namespace tread
