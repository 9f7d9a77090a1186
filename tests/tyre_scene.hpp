#pragma once
// A tyre on a rail of rectangular section: the smallest scene with rolling contact.

#include <string>
#include <vector>

#include "io/scene/scene_reader.hpp"

namespace tread::samples {

/// Scene of the tyre with overrides as on the command line ("motion.speed=250 km/h").
inline Scene tyre_scene(const std::vector<std::string>& overrides = {}) {
  return resolve_scene(SceneSource{"tyre.toml",
                                   R"([scene]
title = "tyre"
element_size = "5 mm"
[solution_zone]
start = "50 mm"
length = "50 mm"
[material.steel]
youngs_modulus = "205.9 GPa"
poissons_ratio = 0.3
density = "7790 kg/m3"
[wheel]
shape = "tyre"
profile = "arc"
diameter = "0.86 m"
crown_radius = "0.3 m"
width = "60 mm"
thickness = "60 mm"
lateral_offset = "0 mm"
[rail]
profile = "box"
support = "rigid"
inclination = 0
length = "400 mm"
origin = "100 mm"
width = "80 mm"
height = "60 mm"
[load]
wheel_load = "87564 N"
[contact]
friction = 0.5
[motion]
speed = "300 km/h"
duration = "0.3 ms"
)",
                                   {}},
                       overrides)
      .scene;
}

/// Scene of the tyre under traction, its steel damped up to a frequency.
inline Scene tyre_with_maxwell_branches(std::vector<std::string> overrides) {
  overrides.insert(
      overrides.end(),
      {"motion.traction.torque=13.8 kN m", "motion.traction.ramp=0.05 ms", "solution_zone.start=5 mm",
       "material.steel.damping={ kind = \"rayleigh_beta\", value = \"1e-5 s\" }",
       "material.steel.damping_up_to=10 kHz"});
  return tyre_scene(overrides);
}

/// Overrides that lay its rail on three fastenings with sleepers of concrete, and those of `more`.
inline std::vector<std::string> on_sleepers(const std::vector<std::string>& more) {
  std::vector<std::string> overrides = {"rail.support=fastenings",
                                        "rail.height=150 mm",
                                        "rail.length=1.5 m",
                                        "rail.origin=0.75 m",
                                        "fastenings.count=3",
                                        "fastenings.spacing=0.6 m",
                                        "fastenings.first=0.15 m",
                                        "fastenings.pad_width=40 mm",
                                        "material.concrete.youngs_modulus=35 GPa",
                                        "material.concrete.poissons_ratio=0.2",
                                        "material.concrete.density=2400 kg/m3",
                                        "sleepers.stiffness=40 MN/m"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

}  // namespace tread::samples
