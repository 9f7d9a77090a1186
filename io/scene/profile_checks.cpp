#include "io/scene/profile_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tread {

namespace {

constexpr double kMm = 1e-3;

/// z of the row nearest to y = 0 [m].
double middle_of(const TwoColumns& profile) {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < profile.first.size(); ++i)
    if (std::abs(profile.first[i]) < std::abs(profile.first[nearest])) nearest = i;
  return profile.second[nearest];
}

/// Place of the largest height `sign` (z - middle) among the rows with side * y above `beyond` [m].
struct Extreme {
  double y = 0;
  double height = 0;  ///< 0: there are no such rows
};
Extreme largest(const TwoColumns& profile, double sign, double side, double beyond) {
  Extreme found;
  const double middle = middle_of(profile);
  for (std::size_t i = 0; i < profile.first.size(); ++i) {
    const double height = sign * (profile.second[i] - middle);
    if (side * profile.first[i] > beyond && height > found.height) found = {profile.first[i], height};
  }
  return found;
}

}  // namespace

std::string wheel_profile_fault(const TwoColumns& profile) {
  constexpr double kFlange = 15 * kMm;  // least height of a flange
  constexpr double kBeside = 35 * kMm;  // its distance from the nominal rolling circle
  if (profile.first.empty() || largest(profile, 1, -1, kBeside).height >= kFlange) return "";
  const Extreme up = largest(profile, -1, -1, kBeside);
  const Extreme mirrored = largest(profile, 1, 1, kBeside);
  const Extreme turned = largest(profile, -1, 1, kBeside);
  const char* axes = "y counts to the field side and z towards the flange tip, downwards";
  if (up.height >= kFlange)
    return fmt::format(
        "the flange, y = {:.1f} mm, lies {:.1f} mm above the tread, but {}: turn the sign of z", up.y / kMm,
        up.height / kMm, axes);
  if (mirrored.height >= kFlange)
    return fmt::format("the flange is at y = {:.1f} mm, but {}: turn the sign of y and the order of the rows",
                       mirrored.y / kMm, axes);
  if (turned.height >= kFlange)
    return fmt::format(
        "the flange is at y = {:.1f} mm and {:.1f} mm above the tread, but {}: turn both signs and the order "
        "of "
        "the rows",
        turned.y / kMm, turned.height / kMm, axes);
  return "";
}

std::string rail_profile_fault(const TwoColumns& profile) {
  constexpr double kBeside = 25 * kMm;
  constexpr double kRise = 1 * kMm;
  if (profile.first.empty()) return "";
  const Extreme right = largest(profile, 1, 1, kBeside);
  const Extreme left = largest(profile, 1, -1, kBeside);
  if (right.height < kRise || left.height < kRise) return "";
  return fmt::format(
      "the head rises to both sides ({:.1f} mm at y = {:.1f} mm), but z counts upwards: turn the sign of z",
      right.height / kMm, right.y / kMm);
}

}  // namespace tread
