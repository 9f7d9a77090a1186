#pragma once
// Scenes for steps on a device, and comparisons of runs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/results/run_results.hpp"
#include "kernels/device/device.hpp"
#include "tests/field_differences.hpp"
#include "tests/state_copies.hpp"
#include "tests/tyre_scene.hpp"

namespace tread::samples {

/// A scene from its preload on, on the processor, on devices or on ranks.
class PreloadedScene {
 public:
  static constexpr std::int64_t kSampling = 70;  ///< steps between samples

  explicit PreloadedScene(const Scene& scene)
      : scene_(scene),
        model_(scene),
        preload_(solve_preload(model_, steady_motion(model_), [](const std::string& /*text*/) {})) {
    if (scene.corrugation) {
      deepest_ = preload_.contact.pressure_peak.y;
      model_.apply_corrugation(*deepest_);
    }
    dt_ = scene.motion->step_safety * step_limit(model_).stable_step;
  }

  const Scene& scene() const { return scene_; }
  const Model& model() const { return model_; }
  std::int64_t values() const { return 3 * model_.mesh.slots; }
  /// Deepest line of the corrugation, if there is one.
  const std::optional<double>& deepest() const { return deepest_; }
  double patch_y() const { return preload_.contact.centre.y; }
  double dt() const { return dt_; }

  /// Runs that start from now on; the static state has none.
  void set_precision(const std::string& precision) { scene_.precision = model_.scene.precision = precision; }

  /// null: the processor.
  std::unique_ptr<Simulation> start(std::shared_ptr<Device> device) const {
    choose_device(std::move(device));
    auto simulation = std::make_unique<Simulation>(model_, preload_, dt_);
    choose_device(std::shared_ptr<Device>());
    simulation->set_sampling_interval(kSampling);
    return simulation;
  }

 private:
  Scene scene_;
  Model model_;
  Preload preload_;
  std::optional<double> deepest_;
  double dt_ = 0;
};

inline void roll_on(Simulation& simulation, std::int64_t steps) {
  while (simulation.steps() < steps) simulation.step();
}

inline std::unique_ptr<Simulation> roll(std::unique_ptr<Simulation> simulation, std::int64_t steps) {
  roll_on(*simulation, steps);
  return simulation;
}

/// Largest difference of two fields, by the range of the first.
inline double difference(std::int64_t values, ConstNodeField a, ConstNodeField b) {
  double low = 0;
  double high = 0;
  double most = 0;
  for (std::int64_t i = 0; i < values; ++i) {
    low = std::min(low, a[i]);
    high = std::max(high, a[i]);
    most = std::max(most, magnitude(a[i] - b[i]));
  }
  return most / (high - low);
}

/// Displacements and velocities apart, each by the range of the former run's.
struct Apart {
  double displacement;
  double velocity;
};
inline Apart apart(std::int64_t values, const Simulation& a, const Simulation& b) {
  return {difference(values, a.displacement(), b.displacement()),
          difference(values, a.velocity(), b.velocity())};
}

/// Root of the sum of the squared differences of two fields.
inline double noise(std::int64_t values, ConstNodeField a, ConstNodeField b) {
  double sum = 0;
  for (std::int64_t i = 0; i < values; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

/// Largest difference by the largest expected value, if there is another than zero.
inline double scaled_difference(std::span<const double> values, std::span<const double> expected) {
  const double size = largest(expected);
  return difference(values, expected) / (size > 0 ? size : 1);
}

/// Forces, patch, works and record of a passage on the rail.
inline void expect_same_contact(const Simulation& a, const Simulation& b) {
  const auto values = [](const Sample& s) {
    return std::vector<std::vector<double>>{{s.vertical_force, s.longitudinal_force, s.lateral_force},
                                            {s.max_pressure, s.max_shear},
                                            {s.patch_area, s.slip_area},
                                            {s.energy.penalty},
                                            {s.energy.frictional_work, s.energy.contact_loss}};
  };
  const auto of_a = values(a.sample());
  const auto of_b = values(b.sample());
  for (std::size_t i = 0; i < of_a.size(); ++i) EXPECT_LT(scaled_difference(of_b[i], of_a[i]), 1e-8) << i;
  if (a.surface() == nullptr) return;
  EXPECT_LT(scaled_difference(b.surface()->max_pressure(), a.surface()->max_pressure()), 1e-8);
  EXPECT_LT(scaled_difference(b.surface()->max_shear(), a.surface()->max_shear()), 1e-8);
  EXPECT_LT(scaled_difference(b.surface()->frictional_work(), a.surface()->frictional_work()), 1e-8);
}

/// Energies and the mean motion of the wheel. What closes the balance is small beside what it consists of.
inline void expect_same_energies(const Sample& a, const Sample& b) {
  const auto values = [](const Sample& s) {
    const EnergyLedger& e = s.energy;
    return std::vector<std::vector<double>>{{e.kinetic},
                                            {e.strain},
                                            {e.connectors, e.connector_loss},
                                            {e.gravity},
                                            {e.material_loss},
                                            {e.plastic_work},
                                            {e.strain, e.residual},
                                            {s.wheel_speed},
                                            {s.wheel_spin},
                                            {1e-3, s.creepage_mean, s.creepage_node, s.lateral_creepage}};
  };
  const auto of_a = values(a);
  const auto of_b = values(b);
  for (std::size_t i = 0; i < of_a.size(); ++i) EXPECT_LT(scaled_difference(of_b[i], of_a[i]), 1e-8) << i;
}

/// Fields of a run on a device after the steps of a run in double on the processor. Returns their difference.
inline Apart expect_same_fields(const Simulation& in_double, const PreloadedScene& at,
                                const Simulation& on_device, const std::string& precision) {
  const Apart error = apart(at.values(), in_double, on_device);
  if (precision == "double") {
    EXPECT_LT(error.displacement, 1e-9);
    EXPECT_LT(error.velocity, 1e-9);
    expect_same_contact(in_double, on_device);
    expect_same_energies(in_double.sample(), on_device.sample());
  } else {
    // Velocities hold the noise of rounding: the device's must not exceed the processor's by more than sums
    // in another order do. The largest of all values would scatter.
    const auto on_processor = roll(at.start(nullptr), in_double.steps());
    EXPECT_LT(apart(at.values(), *on_processor, on_device).displacement, 1e-5);
    EXPECT_LT(error.displacement, 1e-5);
    EXPECT_LT(noise(at.values(), in_double.velocity(), on_device.velocity()),
              1.25 * noise(at.values(), in_double.velocity(), on_processor->velocity()));
    // Nor must rounding work on the bodies more than there: a mistake in it repeats in every step.
    const EnergyLedger& ledger = on_processor->sample().energy;
    EXPECT_NEAR(on_device.sample().energy.residual, ledger.residual, 3e-5 * ledger.strain);
  }
  return error;
}

/// Scenes by precision: of the tyre, and of a file.
inline auto tyre(std::vector<std::string> overrides) {
  return [overrides](const std::string& precision) {
    std::vector<std::string> all = {"scene.element_size=10 mm", "motion.duration=1 ms",
                                    "solution_zone.start=5 mm", "scene.precision=" + precision};
    all.insert(all.end(), overrides.begin(), overrides.end());
    return tyre_scene(all);
  };
}
inline auto file(const std::string& name, std::vector<std::string> overrides) {
  return [name, overrides](const std::string& precision) {
    std::vector<std::string> all = overrides;
    all.push_back("scene.precision=" + precision);
    return read_scene(std::string(TREAD_SOURCE_DIR) + "/scenes/" + name + ".toml", all);
  };
}

inline std::vector<std::string> corrugated(std::vector<std::string> overrides) {
  overrides.insert(overrides.end(),
                   {"corrugation.kind=sine", "corrugation.wavelength=20 mm", "corrugation.depth=0.04 mm",
                    "corrugation.width=30 mm", "corrugation.start=5 mm", "corrugation.length=40 mm"});
  return overrides;
}

/// Half a wheelset with a vehicle on a short slab, of coarse elements.
inline const std::vector<std::string> kHalfWheelset = {
    "scene.element_size=10 mm", "motion.duration=0.1 ms",    "motion.start=moving",
    "rail.length=2.6 m",        "rail.origin=1.3 m",         "fastenings.count=4",
    "fastenings.first=0.325 m", "solution_zone.start=20 mm", "solution_zone.length=50 mm"};
inline const std::vector<std::string> kTraction = {"motion.traction.torque=13.8 kN m",
                                                   "motion.traction.ramp=0.05 ms"};
inline const std::vector<std::string> kPrecisions = {"double", "mixed", "single"};

}  // namespace tread::samples
