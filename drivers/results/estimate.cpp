#include "drivers/results/estimate.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>

#include "drivers/engine/chosen_fields.hpp"
#include "drivers/results/inventory.hpp"
#include "drivers/results/run_results.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

// Measured on runs of the scenes in scenes/: 1.3 ... 1.45.
constexpr double kStepOverhead = 1.4;  ///< time of a step over that of its internal force

/// Time of the fastest call [s]: an interruption of one call must not be multiplied by the number of steps.
double seconds_of(const std::function<void()>& force) {
  using Clock = std::chrono::steady_clock;
  constexpr int kTimes = 5;
  force();
  double fastest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTimes; ++i) {
    const Clock::time_point start = Clock::now();
    force();
    fastest = std::min(fastest, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return fastest;
}

double stiffness_seconds(const Model& model) {
  const AlignedVector<double> u(static_cast<std::size_t>(3 * model.mesh.slots), 0.0);
  AlignedVector<double> f(u.size(), 0.0);
  return seconds_of([&] { model.internal->internal_force(u.data(), u.data(), f.data()); });
}

/// Time of the preload [s]. A preload of a draft takes 378 iterations of conjugate gradients, each three
/// applications of the stiffness, vectors and a coarse solution. The preload of a tyre on a block takes 120.
/// [docs/records/performance.md, Mesh, preload, memory]
double seconds_of_preload(const Model& model, double one_application) {
  constexpr double kOnFastenings = 4300;  ///< time over that of one application of the stiffness
  constexpr double kOnRigidGround = 1200;
  constexpr double kRunIn = 4.5;  ///< [s]
  const double applications = model.scene.fastenings ? kOnFastenings : kOnRigidGround;
  return applications * one_application + (model.scene.start() == "rolling" ? kRunIn : 0.0);
}

/// A single call on a device, beside no contact, is no step of a run there: the processor is timed.
double step_seconds(const Model& model) {
  const std::shared_ptr<Device> device = chosen_device();
  choose_device(std::shared_ptr<Device>());
  const auto fields = make_node_fields(model);
  choose_device(device);
  return kStepOverhead * seconds_of([&] { fields->internal_force_and_move({}, false); });
}

/// Adds step and rolling time.
void add_motion(const Model& model, ElementTimes& times, Estimate& e) {
  e.limit = step_limit(model);
  e.dt = model.scene.motion->step_safety * e.limit.stable_step;
  e.steps = step_count(model.scene, e.dt);
  const auto elements = static_cast<double>(e.elements);
  if (times.step == 0) times.step = step_seconds(model) / elements;
  e.rolling_seconds = times.step * elements * static_cast<double>(e.steps);
}

}  // namespace

Estimate estimate(Model& model, std::int64_t files, ElementTimes& times) {
  // A run puts the corrugation at the place of the largest pressure in the preload. That place affects no
  // value here.
  if (model.scene.corrugation) model.apply_corrugation(model.scene.corrugation->centre.value_or(0));
  Estimate e;
  e.elements = model.elements();
  const auto elements = static_cast<double>(e.elements);
  if (times.stiffness == 0) times.stiffness = stiffness_seconds(model) / elements;
  e.preload_seconds = seconds_of_preload(model, times.stiffness * elements);
  if (model.scene.motion) add_motion(model, times, e);
  e.disk = disk_use(model, e.dt, files);
  e.memory = peak_bytes(model, e.seconds(), files);
  return e;
}

Estimate estimate(Model& model, std::int64_t files) {
  ElementTimes times;
  return estimate(model, files, times);
}

}  // namespace tread
