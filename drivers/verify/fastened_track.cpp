#include "drivers/verify/fastened_track.hpp"

#include <fmt/core.h>

#include <cmath>

namespace tread {

namespace {

constexpr double kRail = 15.2;    ///< length of the library's rail [m]
constexpr double kFirst = 0.125;  ///< place of the first fastening [m]

}  // namespace

std::vector<VerifyInput> track_inputs() {
  return {
      {"element_size", &kLength, "mm", 6e-3, {1e-3, 6e-3}, "the elements' size in the contact surface"},
      {"spacing", &kLength, "m", 0.65, {0.3, 1}, "the distance between fastenings"},
      {"stiffness", &kStiffness, "MN/m", 22e6, {1e6, 1e9}, "a fastening's stiffness"},
      {"damping", &kViscousDamping, "kN s/m", 200e3, {0, 1e6}, "a fastening's damping"},
      {"sleepers", nullptr, "", 0, {0, 1}, "1: the fastenings stand on sleepers, 0: on rigid ground"},
      {"bed_stiffness", &kStiffness, "MN/m", 50e6, {1e6, 1e12}, "the bed's stiffness under a half sleeper"},
      {"bed_damping", &kViscousDamping, "kN s/m", 50e3, {0, 1e9}, "the bed's damping under a half sleeper"},
      {"sleeper_modulus", &kStress, "GPa", 35e9, {1e9, 1e14}, "Young's modulus of the sleepers"},
      {"held", nullptr, "", 1, {0, 1}, "1: the foot is held along x, 0: it moves freely"},
      {"over_pad", nullptr, "", 1, {0, 1}, "1: it is held all over the pad, 0: at the spring-dampers"},
      {"columns", nullptr, "", 3, {1, 20}, "spring-dampers along the pad"}};
}

std::string track_text(const VerifyInputs& inputs, double element_size) {
  std::string sleepers;
  if (inputs["sleepers"] > 0)
    sleepers = fmt::format(R"([material.concrete]
youngs_modulus = "{} Pa"
poissons_ratio = 0.2
density = "2400 kg/m3"
[sleepers]
stiffness = "{} N/m"
damping = "{} N s/m"
)",
                           inputs["sleeper_modulus"], inputs["bed_stiffness"], inputs["bed_damping"]);
  return fmt::format(
      R"([scene]
based_on = "highspeed-slab-2014"
element_size = "{h} m"
[slab]
present = false
[fastenings]
count = {count}
spacing = "{spacing} m"
stiffness = "{k} N/m"
damping = "{c} N s/m"
along = "{along}"
held_at = "{held_at}"
columns = {columns}
{sleepers})",
      fmt::arg("sleepers", sleepers), fmt::arg("h", element_size), fmt::arg("k", inputs["stiffness"]),
      fmt::arg("c", inputs["damping"]), fmt::arg("spacing", inputs["spacing"]),
      fmt::arg("along", inputs["held"] > 0 ? "held" : "free"),
      fmt::arg("columns", static_cast<int>(std::lround(inputs["columns"]))),
      fmt::arg("held_at", inputs["over_pad"] > 0 ? "pad" : "springs"),
      fmt::arg("count", 1 + static_cast<int>(std::floor((kRail - 2 * kFirst) / inputs["spacing"] + 1e-9))));
}

}  // namespace tread
