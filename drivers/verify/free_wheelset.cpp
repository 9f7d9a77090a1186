#include "drivers/verify/free_wheelset.hpp"

#include <fmt/core.h>

#include "io/scene/scene_reader.hpp"

namespace tread {

Scene free_wheelset(double element_size, double duration) {
  const std::string motion = duration > 0 ? fmt::format("duration = \"{} s\"\nspeed = \"0 m/s\"", duration)
                                          : std::string("present = false");
  const std::string text = fmt::format(R"([scene]
based_on = "highspeed-slab-2014"
element_size = "{} m"
gravity = "0 m/s2"
[material.steel]
damping = {{ kind = "rayleigh_beta", value = "0 s" }}
[solution_zone]
start = "0 m"
length = "0.01 m"
[rail]
present = false
[fastenings]
present = false
[slab]
present = false
[vehicle]
present = false
[contact]
present = false
[motion]
{}
)",
                                       element_size, motion);
  return resolve_scene(SceneSource{"verify", text, {}}).scene;
}

}  // namespace tread
