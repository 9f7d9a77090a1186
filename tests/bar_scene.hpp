#pragma once
// A bar with a pulse at its end: the smallest scene that moves.

namespace tread::samples {

inline constexpr const char* kBar = R"(
[scene]
title = "bar"
element_size = "10 mm"
gravity = "0 m/s2"
[material.steel]
youngs_modulus = "205.9 GPa"
poissons_ratio = 0
density = "7790 kg/m3"
[rail]
profile = "box"
support = "free"
inclination = 0
length = "1 m"
origin = "0 m"
width = "20 mm"
height = "20 mm"
[pulse]
velocity = "1 m/s"
length = "0.1 m"
[motion]
duration = "0.1 ms"
)";

}  // namespace tread::samples
