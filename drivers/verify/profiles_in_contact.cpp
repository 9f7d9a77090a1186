// Static contact of a wheel S1002 on a rail 60E1 against half-spaces of the same gap.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/math/statistics.hpp"
#include "drivers/engine/start/poses.hpp"
#include "drivers/verify/cases.hpp"
#include "io/scene/scene_reader.hpp"
#include "kernels/half_space/half_space.hpp"

namespace tread {

namespace {

/// Rail centre line in wheel coordinates; 3 mm on 1:40: the wheelset stands in the middle [m].
constexpr std::array kOffsets = {1e-3, 2e-3, 4e-3, 5e-3, 6e-3, 8e-3, 10e-3};

Scene wheel_on_rail(const VerifyInputs& inputs, double offset) {
  const std::string text = fmt::format(
      R"([scene]
based_on = "ballasted-60e1"
element_size = "{} m"
gravity = "0 m/s2"
[motion]
present = false
[vehicle]
present = false
[load]
wheel_load = "{} N"
[rail]
support = "rigid"
length = "1 m"
origin = "0.5 m"
[fastenings]
present = false
[sleepers]
present = false
[material.concrete]
present = false
[wheel]
lateral_offset = "{} m"
[solution_zone]
start = "-20 mm"
length = "40 mm"
)",
      inputs["element_size"], inputs["load"], offset);
  return resolve_scene(SceneSource{"verify", text, {}}, {}).scene;
}

/// Place of the wheel's rim, by the tread on both sides of the patch.
SectionPose wheel_pose(const Model& model, ConstNodeField u) {
  constexpr double kBeside = 60e-3;          // far from the patch's own deformation [m]
  const std::array tread = {-30e-3, 60e-3};  // without the flange [m]
  const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(model.index.tread)];
  const SurfaceProfile profile(block.section);
  SectionPose pose;
  for (const double angle : {-kBeside / model.wheel_radius(), kBeside / model.wheel_radius()}) {
    const auto away = [&](double a) { return std::abs(std::remainder(a - angle, 2 * std::numbers::pi)); };
    const auto nearest = std::min_element(block.stations.begin(), block.stations.end(),
                                          [&](double a, double b) { return away(a) < away(b); });
    const auto station = static_cast<int>(nearest - block.stations.begin());
    LineFit sinking, shift;
    for (int ordinal = 0; ordinal <= profile.edges(); ++ordinal) {
      const int node = profile.node(ordinal);
      const double y = block.section.p[static_cast<std::size_t>(node)];
      if (y < tread[0] || y > tread[1]) continue;
      const std::int64_t slot = block.base + block.slot(node, station);
      sinking.add(y, u[dof(slot, 2)]);
      shift.add(y, u[dof(slot, 1)]);
    }
    pose.roll -= 0.5 * sinking.slope();
    pose.shift += 0.5 * shift.mean();
  }
  return pose;
}

/// Two half-spaces with the gap of the profiles of bodies that stand as `pose` says, the wheel's less the
/// rail's, about y = `centre` [m].
class ProfilesOnHalfSpace {
 public:
  ProfilesOnHalfSpace(const Model& model, double centre, const SectionPose& pose, double load)
      : rail_(profile(model, model.index.rail_cap)),
        wheel_(profile(model, model.index.tread)),
        centre_(centre),
        pose_(pose),
        influence_(half_space::centred_grid(12e-3, 18e-3, 0.3e-3), model.scene.elastic_pair().alike()) {
    const double lowest = smooth(0);
    contact_ = half_space::press(
        influence_,
        [&](double x, double y) { return smooth(y) - lowest + 0.5 * x * x / wheel_.q_at(centre_ + y); },
        load);
  }

  const half_space::NormalContact& contact() const { return contact_; }

  /// Semi-axis across of Hertz's pressure that is as large and as curved as this one at its largest [m].
  double semi_axis() const {
    const auto largest = std::max_element(contact_.pressure.begin(), contact_.pressure.end());
    const std::ptrdiff_t row = influence_.grid.nx;
    const double bend = *(largest - row) - 2 * *largest + *(largest + row);
    return influence_.grid.dy * std::sqrt(*largest / -bend);
  }

  /// y of the pressure's middle [m].
  double middle() const {
    const half_space::Grid& grid = influence_.grid;
    double sum = 0;
    double moment = 0;
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        const double p = contact_.pressure[static_cast<std::size_t>(grid.index(i, j))];
        sum += p;
        moment += p * grid.y(j);
      }
    return centre_ + moment / sum;
  }

 private:
  static SurfaceProfile profile(const Model& model, int block) {
    return SurfaceProfile(model.mesh.blocks[static_cast<std::size_t>(block)].section);
  }
  double smooth(double y) const {
    return -rail_.q_at(centre_ + y) - wheel_.q_at(centre_ + y - pose_.shift) + pose_.roll * y;
  }

  SurfaceProfile rail_, wheel_;
  double centre_;
  SectionPose pose_;
  half_space::Influence influence_;
  half_space::NormalContact contact_;
};

/// Wheel and rail pressed together at one offset, and their half-spaces.
struct PressedProfiles {
  double load, max_pressure, area;  ///< [N], nodal average [Pa], [m2]
  double centre;                    ///< y of the pressure's middle [m]
  double semi_axis;                 ///< Hertz's smaller one [m]
  SectionPose rail, wheel;
  ProfilesOnHalfSpace theory;
};

PressedProfiles press_profiles(const Scene& scene, const ProgressText& progress) {
  Model model(scene);
  progress(fmt::format("{} elements, lateral offset {:g} mm", model.elements(),
                       1e3 * scene.wheel->lateral_offset));
  const Preload preload = solve_preload(model, {}, progress);
  const double load = -preload.contact.force_on_rail.z;
  const double* u = preload.displacement.data();
  const SectionPose rail = head_pose(model, u, 0), wheel = wheel_pose(model, u);
  const double centre = preload.contact.centre.y;
  return {load,
          model.contact->nodes().max_pressure(),
          preload.contact.area,
          centre,
          std::min(model.hertz_patch.semi_axis_x, model.hertz_patch.semi_axis_y),
          rail,
          wheel,
          {model, centre, {wheel.roll - rail.roll, wheel.shift - rail.shift}, load}};
}

void judge_profiles(const std::string& at, const PressedProfiles& pressed, const VerifyInputs& inputs,
                    std::vector<Finding>& findings) {
  const ProfilesOnHalfSpace& theory = pressed.theory;
  const half_space::NormalContact& contact = theory.contact();
  const double element = inputs["element_size"];
  const double local = theory.semi_axis();
  constexpr double kNarrow = 0.7;  // less of Hertz's semi-axis: the larger of two places that carry
  const bool narrow = local < kNarrow * pressed.semi_axis;
  const double semi_axis = narrow ? local : pressed.semi_axis;
  // The bounds are those of 1.1 mm on a semi-axis of 5.25 mm, as in Hertz's cases.
  const double coarse = (element / 1.1e-3) * (5.25e-3 / semi_axis);
  const double fewest = narrow ? 3 : 1 / 0.7;  // elements on a semi-axis; 1 / 0.7 as in Hertz's cases
  const bool resolved = semi_axis > fewest * element;
  const auto bound = [&](double share) { return resolved ? std::optional(share * coarse) : std::nullopt; };
  const auto add = [&](const char* quantity, const char* unit, double value, double reference,
                       std::optional<double> largest, bool absolute = false) {
    findings.push_back({at + quantity, unit, value, reference, largest, absolute});
  };
  add("largest pressure, nodal average", "MPa", 1e-6 * pressed.max_pressure, 1e-6 * contact.max_pressure,
      bound(0.03));
  add("patch area", "mm2", 1e6 * pressed.area, 1e6 * contact.area, bound(0.05));
  add("F_N", "kN", 1e-3 * pressed.load, 1e-3 * inputs["load"], 1e-5);
  add("middle of the pressure across", "mm", 1e3 * pressed.centre, 1e3 * theory.middle(), 0.1, true);
  add("roll of the wheel, of the rail's head", "mrad", 1e3 * pressed.wheel.roll, 1e3 * pressed.rail.roll, {},
      true);
  add("shift of the wheel, of the rail's head", "mm", 1e3 * pressed.wheel.shift, 1e3 * pressed.rail.shift, {},
      true);
  add(resolved ? "semi-axis where the pressure is largest; element"
               : "semi-axis where the pressure is largest; element: not resolved",
      "mm", 1e3 * semi_axis, 1e3 * element, {}, true);
}

/// Offsets between the inputs' first and last [m]. Throws InputError if there is none.
std::vector<double> chosen_offsets(const VerifyInputs& inputs) {
  std::vector<double> chosen;
  std::string offsets;
  for (const double offset : kOffsets) {
    if (offset >= inputs["first"] && offset <= inputs["last"]) chosen.push_back(offset);
    offsets += fmt::format("{}{:g}", offsets.empty() ? "" : ", ", 1e3 * offset);
  }
  if (chosen.empty())
    throw InputError(
        fmt::format("verify: none of the offsets, {} mm, lies between first = {:g} mm and last = {:g} mm; "
                    "state a smaller first or a larger last",
                    offsets, 1e3 * inputs["first"], 1e3 * inputs["last"]));
  return chosen;
}

CaseResult profiles_in_contact(const VerifyInputs& inputs, const ProgressText& progress) {
  CaseResult result;
  for (const double offset : chosen_offsets(inputs))
    judge_profiles(fmt::format("offset {:g} mm: ", 1e3 * offset),
                   press_profiles(wheel_on_rail(inputs, offset), progress), inputs, result.findings);
  return result;
}

}  // namespace

VerifyCase profiles_in_contact_case() {
  return {
      "profiles_in_contact",
      "S1002 on 60E1 at seven places, against half-spaces",
      {{"element_size", &kLength, "mm", 1.1e-3, {0.5e-3, 0.02}, "the elements' size in the contact"},
       {"load", &kForce, "kN", 80e3, {10e3, 300e3}, "the contact force F_N"},
       {"first", &kLength, "mm", 1e-3, {1e-3, 10e-3}, "the first lateral offset of the seven, 1 to 10 mm"},
       {"last", &kLength, "mm", 10e-3, {1e-3, 10e-3}, "the last of them"}},
      profiles_in_contact};
}

}  // namespace tread
