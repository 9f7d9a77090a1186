#include "drivers/engine/features/step_phase.hpp"

#include <array>

namespace tread {

const char* name_of(StepPhase phase) {
  static constexpr std::array<const char*, kStepPhases> kNames = {"contact search",
                                                                  "internal force",
                                                                  "energies",
                                                                  "tied forces",
                                                                  "fastenings",
                                                                  "suspension",
                                                                  "wheel load",
                                                                  "torque",
                                                                  "hammer",
                                                                  "unsprung mass",
                                                                  "update",
                                                                  "guided bore",
                                                                  "contact tractions",
                                                                  "tied motion",
                                                                  "Maxwell branches",
                                                                  "frame",
                                                                  "surface fields",
                                                                  "samples",
                                                                  "anchor"};
  return kNames[static_cast<std::size_t>(phase)];
}

}  // namespace tread
