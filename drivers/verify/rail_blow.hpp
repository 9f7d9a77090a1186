#pragma once
// Motion of the cross-sections of a rail without a wheel, struck by the hammer.

#include <functional>
#include <vector>

#include "core/math/receptance.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"

namespace tread {

/// Vertical motion of a rail's cross-sections.
class RailAxis {
 public:
  explicit RailAxis(const Model& model);

  /// Stations of the foot [m].
  const std::vector<double>& stations() const { return parts_.back().block->stations; }
  /// Mean downward displacement of the cross-section at x, weighted by mass; of each block linear between its
  /// own stations [m].
  double deflection(double x, ConstNodeField u) const;

 private:
  struct Part {
    const SweptBlock* block;
    double mass;  ///< [kg/m]
  };
  double deflection(const Part& part, int station, ConstNodeField u) const;

  const Model* model_;
  std::vector<Part> parts_;  ///< the foot's is the last
};

/// Function called with time and displacements at every sample, the start included.
using BlowSample = std::function<void(double, ConstNodeField)>;

/// Runs the scene's own step to its end, with samples `interval` [s] apart. Returns the last sample's
/// energies.
EnergyLedger run_blow(Model& model, double interval, const BlowSample& sample, const ProgressText& progress);

/// Frequency [Hz] of the undamped harmonic that fits evenly spaced values best, between `low` and `high`
/// [Hz].
double harmonic_frequency(const std::vector<double>& values, double interval, double low, double high);

}  // namespace tread
