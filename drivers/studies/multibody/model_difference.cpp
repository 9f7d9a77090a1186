#include "drivers/studies/multibody/model_difference.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tread {

namespace {

constexpr double kRounding = 1e-6;   ///< share of a value by which equal ones may differ
constexpr double kOfTheMesh = 0.01;  ///< the same where the mesh slightly affects the contact's place

/// Sentence on the difference of two values beyond a share of the first; empty if there is none.
std::string difference(const char* name, const char* unit, double here, double there, double share) {
  constexpr double kNothing = 1e-9;  // smallest difference in any of the units
  if (std::abs(here - there) <= std::max(kNothing, share * std::abs(here))) return "";
  return fmt::format("{} is {:.6g}{} here and {:.6g}{} there", name, here, unit, there, unit);
}

/// Sentence on the largest difference of two depths [m] at evenly spaced places; empty if there is none.
template <class Depth, class Other>
std::string depth_difference(const char* whose, const Span& stretch, int places, const Depth& here,
                             const Other& there) {
  double deepest = 0;
  double apart = 0;
  for (int i = 0; i <= places; ++i) {
    const double x = stretch.first + (stretch.last - stretch.first) * i / places;
    const double depth = here(x);
    deepest = std::max(deepest, std::abs(depth));
    apart = std::max(apart, std::abs(depth - there(x)));
  }
  if (apart <= kOfTheMesh * deepest) return "";
  return fmt::format("the {} depths differ by up to {:.3g} mm", whose, 1e3 * apart);
}

}  // namespace

std::string track_difference(const MultibodyModel& here, const MultibodyModel& there) {
  std::string first;
  const auto compare = [&](const char* name, const char* unit, double ours, double theirs,
                           double share = kRounding) {
    if (first.empty()) first = difference(name, unit, ours, theirs, share);
  };
  compare("the wheel's diameter", " m", here.scene.wheel->diameter, there.scene.wheel->diameter);
  compare("the wheel load", " N", here.vehicle.load(), there.vehicle.load());
  compare("the unsprung mass", " kg", here.vehicle.unsprung_mass, there.vehicle.unsprung_mass);
  compare("the sprung mass", " kg", here.vehicle.sprung_mass, there.vehicle.sprung_mass);
  compare("the suspension's stiffness", " N/m", here.vehicle.stiffness, there.vehicle.stiffness);
  compare("the suspension's damping", " N s/m", here.vehicle.damping, there.vehicle.damping);
  compare("the contact's C", " N/m^1.5", here.vehicle.contact, there.vehicle.contact, kOfTheMesh);
  compare("the rail's E I", " N m2", here.rail.bending_stiffness, there.rail.bending_stiffness);
  compare("the rail's kappa G A", " N", here.rail.shear_stiffness, there.rail.shear_stiffness);
  compare("the rail's mass", " kg/m", here.rail.mass, there.rail.mass);
  const auto compare_number = [&](const char* name, const auto& ours, const auto& theirs) {
    compare(name, "", static_cast<double>(ours.size()), static_cast<double>(theirs.size()));
  };
  const auto compare_each = [](const auto& ours, const auto& theirs, const auto& one) {
    for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) one(ours[i], theirs[i]);
  };
  compare_number("the number of the fastenings' spring-dampers along the rail", here.supports,
                 there.supports);
  compare_each(here.supports, there.supports, [&](const BeamSupport& ours, const BeamSupport& theirs) {
    compare("a spring-damper's x", " m", ours.x, theirs.x);
    compare("a spring-damper's stiffness", " N/m", ours.stiffness, theirs.stiffness);
    compare("a spring-damper's damping", " N s/m", ours.damping, theirs.damping);
  });
  compare_number("the number of sleepers", here.sleepers, there.sleepers);
  compare_each(here.sleepers, there.sleepers, [&](const SleeperSupport& ours, const SleeperSupport& theirs) {
    compare("a sleeper's x", " m", ours.x, theirs.x);
    compare("a pad's stiffness", " N/m", ours.stiffness, theirs.stiffness);
    compare("a pad's damping", " N s/m", ours.damping, theirs.damping);
    compare_number("the number of spring-dampers of a pad", ours.columns, theirs.columns);
    compare_each(ours.columns, theirs.columns, [&](double ours_at, double theirs_at) {
      compare("a spring-damper's place on its pad", " m", ours_at, theirs_at);
    });
    compare("a sleeper's mass", " kg", ours.sleeper.mass, theirs.sleeper.mass);
    compare("a bed's stiffness", " N/m", ours.sleeper.stiffness, theirs.sleeper.stiffness);
    compare("a bed's damping", " N s/m", ours.sleeper.damping, theirs.sleeper.damping);
  });
  compare_number("the number of places where the foot is held along x", here.foot_holds, there.foot_holds);
  compare_number("the number of the foot's springs along x", here.foot_supports, there.foot_supports);
  compare_each(here.foot_supports, there.foot_supports,
               [&](const BeamSupport& ours, const BeamSupport& theirs) {
                 compare("a fastening's stiffness along x", " N/m", ours.stiffness, theirs.stiffness);
                 compare("a fastening's damping along x", " N s/m", ours.damping, theirs.damping);
               });
  return first;
}

std::string corrugation_difference(const MultibodyModel& here, const MultibodyModel& there) {
  const Corrugation ours = stated_corrugation(here);
  const Corrugation theirs = stated_corrugation(there);
  if (ours.smooth() && theirs.smooth()) return "";
  for (const std::string& apart :
       {difference("the corrugation's start", " m", ours.first(), theirs.first(), kRounding),
        difference("the corrugation's end", " m", ours.last(), theirs.last(), kRounding)})
    if (!apart.empty()) return apart;
  constexpr int kPlaces = 1000;
  return depth_difference(
      "corrugations'", {ours.first(), ours.last()}, kPlaces,
      [&](double x) { return ours.depth(x, here.contact_y); },
      [&](double x) { return theirs.depth(x, there.contact_y); });
}

std::string surface_difference(const MultibodyModel& here, const MultibodyModel& there) {
  constexpr double kPitch = 1e-3;  // [m]
  const Span passage{here.start, here.end};
  const auto places = static_cast<int>(std::ceil((passage.last - passage.first) / kPitch));
  return depth_difference(
      "surfaces'", passage, places, [&](double x) { return here.surface_depth(x, here.contact_y); },
      [&](double x) { return there.surface_depth(x, here.contact_y); });
}

}  // namespace tread
