#include <utility>

#include "io/scene/key_builders.hpp"
#include "io/scene/key_table.hpp"

namespace tread::keys {

void add_motion(Keys& keys) {
  const auto rolling = [](Key key) { return with_table("wheel", std::move(key)); };
  keys.push_back(rolling(quantity("motion.speed", {Effect::preload}, at(&Scene::motion, &MotionSpec::speed),
                                  kSpeed, "km/h", from(0, 300), "Forward speed at the start")));
  keys.push_back(quantity("motion.duration", {Effect::duration}, at(&Scene::motion, &MotionSpec::duration),
                          kTime, "s", above(0, 100), "Simulated time, from the start on"));
  keys.push_back(rolling(quantity("motion.run_up", {Effect::mesh}, at(&Scene::motion, &MotionSpec::run_up),
                                  kLength, "m", from(0, 1000),
                                  "Way from the start to the solution zone; absent: the wheel starts at "
                                  "x = 0")));
  keys.push_back(rolling(
      instead_of("motion.traction.torque",
                 number("motion.traction.mu", {Effect::motion}, at(&Scene::motion, &MotionSpec::traction_mu),
                        {-2, 2}, "Target traction coefficient; negative brakes"))));
  keys.push_back(rolling(instead_of(
      "motion.traction.mu",
      quantity("motion.traction.torque", {Effect::motion}, at(&Scene::motion, &MotionSpec::traction_torque),
               kTorque, "kN m", {-1e6, 1e6}, "Torque on the axle after the ramp; negative brakes"))));
  keys.push_back(rolling(quantity("motion.traction.ramp", {Effect::motion},
                                  at(&Scene::motion, &MotionSpec::ramp), kTime, "ms", from(0, 100),
                                  "Time T1 in which the torque grows from zero; 0: the wheel has long been "
                                  "rolling under it, as the static state has; a rigid start, a guided bore "
                                  "and a wheel that stands get it at once")));
  keys.push_back(rolling(choice("motion.traction.shape", {Effect::motion},
                                at(&Scene::motion, &MotionSpec::ramp_shape), {"linear", "smooth"},
                                "Growth and reversal of the torque: linear, or as half a cosine")));
  keys.push_back(rolling(
      number("motion.traction.reversals", {Effect::motion}, at(&Scene::motion, &MotionSpec::reversals),
             {0, 1000}, "Number of later reversals of the full torque, each in 2 T1", Kind::integer)));
  keys.push_back(rolling(flag("motion.spin_in_preload", {Effect::preload},
                              at(&Scene::motion, &MotionSpec::spin_in_preload),
                              "The static state carries the spin's body force")));
  keys.push_back(rolling(number("motion.creepage", {Effect::mesh}, at(&Scene::motion, &MotionSpec::creepage),
                                {-2, 2, false, true},
                                "Creepage at the start, relative to free rolling; -2: a locked wheel")));
  keys.push_back(rolling(
      choice("motion.start", {Effect::preload}, at(&Scene::motion, &MotionSpec::start),
             {"auto", "rigid", "moving", "rolling"},
             "Motion at t = 0: of rigid bodies, with the static deflection moving along, or that of a "
             "wheel that has been rolling over the fastenings; auto: rolling on [fastenings], else moving")));
  keys.push_back(number("motion.step_safety", {Effect::motion, Effect::cost},
                        at(&Scene::motion, &MotionSpec::step_safety), above(0, 1),
                        "Time step divided by the stable step"));
}

void add_impacts(Keys& keys) {
  keys.push_back(
      required(quantity("pulse.velocity", {Effect::motion}, at(&Scene::pulse, &PulseSpec::velocity), kSpeed,
                        "m/s", {-1000, 1000}, "Initial velocity along x of the bar's left end")));
  keys.push_back(required(quantity("pulse.length", {Effect::motion}, at(&Scene::pulse, &PulseSpec::length),
                                   kLength, "m", above(0, 1000), "Length of the part with this velocity")));
  keys.push_back(quantity("hammer.position", {Effect::motion}, at(&Scene::hammer, &HammerSpec::position),
                          kLength, "m", from(-1000, 1000), "x of the struck point on the rail's crown"));
  keys.push_back(required(quantity("hammer.force", {Effect::motion}, at(&Scene::hammer, &HammerSpec::force),
                                   kForce, "kN", {-1e6, 1e6}, "Largest force of the blow, downwards")));
  keys.push_back(
      required(quantity("hammer.duration", {Effect::motion}, at(&Scene::hammer, &HammerSpec::duration), kTime,
                        "ms", above(0, 1), "Duration of the blow, a half sine from t = 0 on")));
}

}  // namespace tread::keys
