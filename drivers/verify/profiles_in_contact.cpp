// Static contact of a wheel S1002 on a rail 60E1 against half-spaces of the same gap.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "drivers/verify/cases.hpp"
#include "io/scene/scene_reader.hpp"
#include "kernels/half_space/half_space.hpp"

namespace tread {

namespace {

/// Rail centre line in wheel coordinates; 3.5 mm: the wheelset stands in the middle [m].
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

/// Two half-spaces with the gap of the undeformed profiles about y = `centre` [m].
class ProfilesOnHalfSpace {
 public:
  ProfilesOnHalfSpace(const Model& model, double centre, double load)
      : rail_(profile(model, model.index.rail_cap)),
        wheel_(profile(model, model.index.tread)),
        centre_(centre),
        load_(load),
        influence_(half_space::centred_grid(12e-3, 18e-3, 0.3e-3), model.scene.elastic_pair().alike()) {}

  /// Contact of a wheel that is rolled by `roll` [rad] against the rail.
  half_space::NormalContact press(double roll) const {
    const double lowest = smooth(0, roll);
    return half_space::press(
        influence_,
        [&](double x, double y) { return smooth(y, roll) - lowest + 0.5 * x * x / wheel_.q_at(centre_ + y); },
        load_);
  }

  /// Semi-axis across of Hertz's pressure that is as large and as curved as this one at its largest [m].
  double semi_axis(const half_space::NormalContact& contact) const {
    const auto largest = std::max_element(contact.pressure.begin(), contact.pressure.end());
    const std::ptrdiff_t row = influence_.grid.nx;
    const double bend = *(largest - row) - 2 * *largest + *(largest + row);
    return influence_.grid.dy * std::sqrt(*largest / -bend);
  }

  /// Middle of the pressure, from the centre [m].
  double middle(const half_space::NormalContact& contact) const {
    const half_space::Grid& grid = influence_.grid;
    double sum = 0;
    double moment = 0;
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        const double p = contact.pressure[static_cast<std::size_t>(grid.index(i, j))];
        sum += p;
        moment += p * grid.y(j);
      }
    return moment / sum;
  }

 private:
  static SurfaceProfile profile(const Model& model, int block) {
    return SurfaceProfile(model.mesh.blocks[static_cast<std::size_t>(block)].section);
  }
  double smooth(double y, double roll) const {
    return -rail_.q_at(centre_ + y) - wheel_.q_at(centre_ + y) + roll * y;
  }

  SurfaceProfile rail_, wheel_;
  double centre_, load_;
  half_space::Influence influence_;
};

/// The roll that puts the pressure's middle where the engine has it [rad].
double fitted_roll(const ProfilesOnHalfSpace& theory) {
  constexpr double kNear = 0.02e-3;  // [m]
  double low = -8e-3, high = 8e-3;   // the middle moves against the roll
  for (int i = 0; i < 14; ++i) {
    const double roll = 0.5 * (low + high);
    const double middle = theory.middle(theory.press(roll));
    if (std::abs(middle) < kNear) return roll;
    (middle > 0 ? low : high) = roll;
  }
  return 0.5 * (low + high);
}

CaseResult profiles_in_contact(const VerifyInputs& inputs, const ProgressText& progress) {
  CaseResult result;
  for (const double offset : kOffsets) {
    if (offset < inputs["first"] || offset > inputs["last"]) continue;
    Model model(wheel_on_rail(inputs, offset));
    progress(fmt::format("{} elements, lateral offset {:g} mm", model.elements(), 1e3 * offset));
    const Preload preload = solve_preload(model, {}, progress);
    const double load = -preload.contact.force_on_rail.z;
    const ProfilesOnHalfSpace theory(model, preload.contact.centre.y, load);
    const double roll = fitted_roll(theory);
    const half_space::NormalContact contact = theory.press(roll);
    const std::string name = fmt::format("offset {:g} mm", 1e3 * offset);
    const double hertz = std::min(model.hertz_patch.semi_axis_x, model.hertz_patch.semi_axis_y);
    const double local = theory.semi_axis(contact);
    constexpr double kNarrow = 0.7;  // less of Hertz's semi-axis: the larger of two places that carry
    const bool narrow = local < kNarrow * hertz;
    const double semi_axis = narrow ? local : hertz;
    // The bounds are those of 1.1 mm on a semi-axis of 5.25 mm, as in Hertz's cases.
    const double coarse = (inputs["element_size"] / 1.1e-3) * (5.25e-3 / semi_axis);
    const bool resolved = !narrow || semi_axis > 3 * inputs["element_size"];
    const auto bound = [&](double share) { return resolved ? std::optional(share * coarse) : std::nullopt; };
    result.findings.push_back({name + ": largest pressure, nodal average", "MPa",
                               1e-6 * model.contact->nodes().max_pressure(), 1e-6 * contact.max_pressure,
                               bound(0.03)});
    result.findings.push_back(
        {name + ": patch area", "mm2", 1e6 * preload.contact.area, 1e6 * contact.area, bound(0.05)});
    result.findings.push_back({name + ": F_N", "kN", 1e-3 * load, 1e-3 * inputs["load"], 1e-5});
    result.findings.push_back({name + ": middle of the pressure across", "mm", 1e3 * preload.contact.centre.y,
                               1e3 * (preload.contact.centre.y + theory.middle(contact)), 0.05, true});
    result.findings.push_back({name + ": roll of the wheel; roll that the half-space needs for this middle",
                               "mrad",
                               1e3 * preload.tilt,
                               1e3 * roll,
                               {},
                               true});
    result.findings.push_back(
        {name + ": semi-axis where the pressure is largest; element" + (resolved ? "" : ": not resolved"),
         "mm",
         1e3 * semi_axis,
         1e3 * inputs["element_size"],
         {},
         true});
  }
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
