#pragma once
// Motion of the cross-sections of a rail without a wheel, struck by the hammer.

#include <functional>
#include <vector>

#include "core/math/receptance.hpp"
#include "drivers/engine/model.hpp"
#include "drivers/engine/preload.hpp"
#include "drivers/engine/simulation.hpp"

namespace tread {

/// Vertical motion of a rail's cross-sections, by station.
class RailAxis {
 public:
  explicit RailAxis(const Model& model);

  const std::vector<double>& stations() const { return x_; }
  /// Mean downward displacement of a cross-section, weighted by mass [m].
  double deflection(int station, ConstNodeField u) const;
  /// Mean downward displacement at x, linear between stations [m].
  double deflection_at(double x, ConstNodeField u) const;

 private:
  const Model* model_;
  std::vector<double> x_;  ///< [m]
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
