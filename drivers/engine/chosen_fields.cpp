#include "drivers/engine/chosen_fields.hpp"

#include <fmt/core.h>

#include <string>

#include "core/error.hpp"
#include "drivers/engine/device/device_fields.hpp"
#include "drivers/engine/device/rank_device_fields.hpp"
#include "drivers/engine/fields/processor_fields.hpp"
#include "drivers/engine/ranks/rank_fields.hpp"

namespace tread {

namespace {

template <class Real, class U>
std::unique_ptr<NodeFields> fields_of(const Model& model) {
  if (model.contact) model.contact->run_on(nullptr);
  std::shared_ptr<Device> device = chosen_device();
  std::shared_ptr<Ranks> ranks = chosen_ranks();
  if (device && ranks)
    return std::make_unique<RankDeviceFields<Real, U>>(model, std::move(ranks), std::move(device));
  if (device) return std::make_unique<DeviceFields<Real, U>>(model, std::move(device));
  if (ranks) return std::make_unique<RankFields<Real, U>>(model, std::move(ranks));
  return std::make_unique<ProcessorFields<Real, U>>(model);
}

}  // namespace

void require_no_bodies(const Scene& scene, const char* of_others) {
  if (scene.bodies.empty()) return;
  const std::string& name = scene.bodies.begin()->first;
  throw InputError(
      fmt::format("body.{}: the steps of a body from a file are those of one process; leave out {}, or state "
                  "body.{}.present = false",
                  name, of_others, name));
}

void require_steps_of_bodies(const Scene& scene) {
  if (chosen_device()) require_no_bodies(scene, "--device");
  if (chosen_ranks()) require_no_bodies(scene, "mpirun");
}

std::unique_ptr<NodeFields> make_node_fields(const Model& model) {
  require_steps_of_bodies(model.scene);
  const std::string& precision = model.scene.precision;
  if (precision == "single") return fields_of<float, float>(model);
  if (precision == "mixed") return fields_of<float, double>(model);
  return fields_of<double, double>(model);
}

}  // namespace tread
