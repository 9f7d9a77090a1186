#include "core/geometry/built_in_profiles.hpp"

#include <stdexcept>

#include "core/geometry/vignole_rail.hpp"

namespace tread {

RailProfile built_in_rail(const std::string& name) {
  if (name == "CN60") return cn60();
  if (name == "60E1") return rail_60e1();
  if (name == "60E2") return rail_60e2();
  if (name == "49E1") return rail_49e1();
  throw std::invalid_argument("no built-in rail " + name);
}

WheelProfile built_in_wheel(const std::string& name) {
  if (name == "LMA") return lma();
  if (name == "S1002") return s1002();
  throw std::invalid_argument("no built-in wheel profile " + name);
}

}  // namespace tread
