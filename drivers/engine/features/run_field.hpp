#pragma once
// Arrays and records that live in memory during a run: names, units, entities, each stated once.

#include <cstddef>
#include <cstdint>

namespace tread {

enum class RunField {
  coefficients,
  moved_nodes,
  mass,
  restrained,
  tie_links,
  fastening_elements,
  journal_nodes,
  torque_nodes,
  bore_nodes,
  contact_points,
  wheel_frame,
  sprung_mass,
  displacement,
  displacement_in_motion,  ///< where the run's precision is not that of the static state
  rounded_coefficients,    ///< likewise
  velocity,
  force,
  branch_lag,
  law_state,
  surface_fields,
  samples,
  checkpoint,
  frames,
  solver,
};
inline constexpr std::size_t kRunFields = static_cast<std::size_t>(RunField::solver) + 1;

enum class FieldLife { always, preload, motion };

struct RunFieldInfo {
  const char* name;
  const char* unit;    ///< "-" if it has none
  const char* entity;  ///< owner of one set of values: "node", "tied node", "rail integration point"
  FieldLife life;
};

const RunFieldInfo& info_of(RunField field);

/// Size of a field, stated by its owner.
struct FieldBytes {
  RunField field;
  std::int64_t bytes;
  bool saved = false;  ///< in checkpoints
};

}  // namespace tread
