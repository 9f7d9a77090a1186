#include "drivers/studies/multibody/local_parts.hpp"

#include "drivers/studies/multibody/solid_rail.hpp"

namespace tread {

namespace {

constexpr double kRegion = 20e-3;         ///< half length of the region of force [m]
constexpr double kTopOfRail = 14e3;       ///< highest frequency of the rail's modes [Hz]
constexpr double kTopOfWheel = 5e3;       ///< of the wheel's [Hz]
constexpr double kElementOfRail = 8e-3;   ///< of the head [m]
constexpr double kElementOfWheel = 6e-3;  ///< of the tread [m]
constexpr double kMostLoad = 3;           ///< of the pressed half-spaces, over the static load

}  // namespace

void use_solid_rail(MultibodyModel& model) {
  model.solid = solid_rail(model.scene, {model.contact_y, kRegion}, kTopOfRail, kElementOfRail);
}

void use_modal_wheel(MultibodyModel& model) {
  model.wheel = modal_wheel(model.scene, {model.contact_y, kRegion}, kTopOfWheel, kElementOfWheel);
}

void use_half_space_contact(MultibodyModel& model) {
  require_sine(model, "tread multibody --contact half-space: the wheel is pressed on a sine");
  model.sine =
      SineContact(sine_under_wheel(model), model.scene.elastic_pair(), kMostLoad * model.vehicle.load());
}

}  // namespace tread
