#include "drivers/engine/features/run_field.hpp"

#include <array>

namespace tread {

const RunFieldInfo& info_of(RunField field) {
  using enum FieldLife;
  static constexpr std::array<RunFieldInfo, kRunFields> kFields = {{
      {"coefficients", "m, Pa", "quad and pitch class; moved node", always},
      {"moved nodes", "m", "node on a chord or on the corrugation", always},
      {"mass", "kg, 1/kg", "node", always},
      {"restrained unknowns", "-", "unknown", always},
      {"tie links", "-", "tied node", always},
      {"fastening elements", "N/m, N s/m", "spring-damper", always},
      {"journal nodes", "-", "node of the journal's ring", always},
      {"torque nodes", "1/m", "node of the axle's end", motion},
      {"bore nodes", "kg, m", "node of the guided bore", always},
      {"contact points", "Pa, s", "rail integration point", always},
      {"wheel frame", "m, rad", "wheel", always},
      {"sprung mass", "m, m/s", "sprung mass", motion},
      {"displacement", "m", "node", always},
      {"displacement in motion", "m", "node", motion},
      {"rounded coefficients and mass", "m, Pa, 1/kg", "quad and pitch class; node", motion},
      {"velocity", "m/s", "node", motion},
      {"force", "N", "node", motion},
      {"branch lag", "m", "node", motion},
      {"law state", "of the law", "element", motion},
      {"surface fields", "Pa, J/m2", "rail surface node", motion},
      {"samples", "all", "sample", motion},
      {"checkpoint", "all", "copy that is being written, and read back", motion},
      {"frames", "m, m/s", "node, a copy; its file", motion},
      {"solver", "N, m", "node and aggregate, during the preload", preload},
  }};
  return kFields[static_cast<std::size_t>(field)];
}

}  // namespace tread
