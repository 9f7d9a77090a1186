#pragma once
// Why a run was stopped, in words.

#include <cstdint>
#include <string>

#include "drivers/engine/model/model.hpp"

namespace tread {

/// The instant at which the energies could no longer be.
struct EnergyStop {
  double time = 0;  ///< [s]
  std::int64_t steps = 0;
  double dt = 0;            ///< [s]
  double missed = 0;        ///< energy that appeared (> 0) or vanished (< 0) [J]
  double supplied = 0;      ///< [J]
  ConstNodeField velocity;  ///< of all nodes [m/s]
};

/// Names the instant, the energy, the fastest place, the cause (a step beyond the stable one, computed anew,
/// or something else) and the way out.
std::string energy_stop_text(const Model& model, const EnergyStop& stop);

/// The text where a step `dt` [s] beyond the stable one has carried the patch off the searched surface; ""
/// for a stable step. Needs no values of other ranks, which do not know of the patch. `time` [s]
std::string unstable_patch_text(const Model& model, double wheel_x, double time, std::int64_t steps,
                                double dt);

}  // namespace tread
