#include "io/scene/scene_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "core/travel.hpp"
#include "io/scene/body_checks.hpp"
#include "io/scene/corrugation_checks.hpp"
#include "io/scene/rail_reach.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/support_checks.hpp"
#include "io/scene/surface_checks.hpp"
#include "io/scene/wheel_checks.hpp"
#include "io/scene/zone_checks.hpp"

namespace tread {

namespace {

class Checker {
 public:
  explicit Checker(const Scene& scene) : scene_(scene) {}

  std::vector<SceneProblem> run() {
    check_values();
    check_components();
    if (scene_.plane_strain) check_plane_strain();
    check_materials();
    if (scene_.contact) check_friction(*scene_.contact);
    const auto others = [this](bool condition, std::vector<std::string> keys, std::string message) {
      require(condition, std::move(keys), std::move(message));
    };
    check_wheel(scene_, others);
    if (scene_.rail) check_rail(*scene_.rail);
    check_zones(scene_, others);
    check_supports(scene_, others);
    check_bodies(scene_, others);
    if (scene_.motion) check_motion(*scene_.motion);
    if (scene_.rail && scene_.corrugation) check_corrugation(scene_, others);
    check_surfaces(scene_, others);
    if (scene_.rail && scene_.pulse) {
      require(scene_.pulse->length <= scene_.rail->length, {"pulse.length", "rail.length"},
              fmt::format("the pulse, {}, is longer than the bar, {}; state a smaller pulse.length",
                          format_quantity(scene_.pulse->length, "mm"),
                          format_quantity(scene_.rail->length, "mm")));
    }
    if (scene_.rail && scene_.hammer)
      check_on_rail(*scene_.rail, scene_.hammer->position, {"hammer.position", "rail.length", "rail.origin"},
                    "the struck point", others);
    for (const auto& [name, probe] : scene_.probes)
      check_probe(std::string(kProbeTables) + name, probe, others);
    return std::move(problems_);
  }

 private:
  /// Adds a problem unless the condition holds or one of the keys is already known to be wrong.
  void require(bool condition, std::vector<std::string> keys, std::string message) {
    const auto wrong = [&](const std::string& key) { return wrong_.count(key) > 0; };
    if (condition || std::any_of(keys.begin(), keys.end(), wrong)) return;
    problems_.push_back({std::move(keys), std::move(message)});
  }

  void check_values() {
    Scene copy = scene_;
    for (const Key& key : scene_keys(scene_)) {
      if (!key.locate) continue;
      const std::optional<double> value = number_at(key.locate(copy));
      if (!value || key.range.contains(*value) || !applies(key, scene_)) continue;
      const std::string text =
          key.unit.empty() ? fmt::format("{:.6g}", *value) : format_quantity(*value, key.unit);
      require(false, {key.path}, fmt::format("{} is not allowed; it must be {}", text, describe_range(key)));
      wrong_.insert(key.path);
    }
  }

  void check_components() {
    const Scene& s = scene_;
    require(!s.fastenings || s.rail, {"fastenings"}, "fastenings need a rail; add [rail]");
    require(!s.slab_track || s.fastenings, {"slab"}, "a slab needs fastenings; add [fastenings]");
    require(!s.sleepers || s.fastenings, {"sleepers"}, "sleepers need fastenings; add [fastenings]");
    require(
        !s.sleepers || !s.slab_track, {"sleepers", "slab"},
        "fastenings stand on sleepers or on a slab; state slab.present = false or sleepers.present = false");
    require(!s.vehicle || s.wheel, {"vehicle"}, "a vehicle needs a wheel; add [wheel]");
    require(!s.load || s.wheel, {"load"}, "a load needs a wheel; add [wheel]");
    require(!s.vehicle || !s.load, {"load", "vehicle"}, two_loads());
    require(!s.contact || (s.wheel && s.rail), {"contact"},
            "contact needs [wheel] and [rail]; add both, or leave [contact] out");
    require(!(s.wheel && s.rail) || s.contact, {"wheel", "rail"}, "wheel and rail need [contact]; add it");
    require(
        !s.vehicle || s.gravity > 0, {"scene.gravity", "vehicle"},
        "a vehicle without weight presses no wheel on the rail; state scene.gravity above 0, or [load] in "
        "place of [vehicle]");
    require(!s.contact || s.vehicle || s.load || s.gravity > 0, {"contact", "load"},
            "nothing presses the wheel on the rail; add [load] or [vehicle], or state scene.gravity");
    require(!s.corrugation || s.contact, {"corrugation"},
            "a corrugation needs [contact]; add it, or leave [corrugation] out");
    require(!s.pulse || (s.rail && !s.wheel), {"pulse"},
            "a pulse needs [rail] and no wheel; state [rail] alone, or leave [pulse] out");
    require(!s.pulse || s.motion, {"pulse"}, "a pulse needs [motion] with the duration");
    require(
        !s.wear || s.wear->shortest < s.wear->longest, {"wear.shortest", "wear.longest"},
        fmt::format("the shortest wave that wears, {}, is not shorter than the longest, {}; state a smaller "
                    "wear.shortest or a larger wear.longest",
                    format_quantity(s.wear ? s.wear->shortest : 0, "mm"),
                    format_quantity(s.wear ? s.wear->longest : 0, "mm")));
    require(!s.hammer || s.rail, {"hammer"}, "a hammer needs [rail]");
    require(!s.hammer || s.motion, {"hammer"}, "a hammer needs [motion] with the duration");
    require(!s.forks || (s.motion && s.contact), {"forks"}, "forks need [motion] and [contact]");
    require(!s.motion || s.pulse || s.wheel || (s.hammer && s.rail), {"motion"},
            "motion needs [wheel], or [pulse] on a bar, or [rail] and [hammer]");
    require(!s.motion || !s.wheel || s.rail || (!s.load && !s.vehicle), {"motion", "rail"},
            "a wheel without a rail moves freely and carries neither load nor vehicle; add [rail], or state "
            "load.present = false or vehicle.present = false");
    require(s.wheel || s.rail, {"scene.based_on"},
            "the scene is empty; add [wheel] or [rail], or scene.based_on = \"highspeed-slab-2014\"");
  }

  /// Refusal of a load beside a vehicle, with the sprung mass that presses as much.
  std::string two_loads() const {
    if (!scene_.vehicle || !scene_.load) return "";
    const double mass = scene_.load->wheel_load / scene_.gravity - scene_.vehicle->unsprung_mass;
    const std::string as_much =
        mass > 0 && std::isfinite(mass)
            ? fmt::format(
                  "vehicle.sprung_mass = \"{:.6g} kg\" presses as much as the load: state it in place "
                  "of [load], or ",
                  mass)
            : "";
    return fmt::format(
        "a wheel carries a vehicle or a load; {}leave one out: vehicle.present = false takes its masses and "
        "suspension away",
        as_much);
  }

  /// Nodes are held across: contact may not push them there.
  void check_plane_strain() {
    const Scene& s = scene_;
    require(!s.wheel || s.wheel->profile == "cylinder", {"scene.plane_strain", "wheel.profile"},
            "plane strain is that of a wheel that is straight across; state wheel.profile = \"cylinder\", or "
            "scene.plane_strain = false");
    require(!s.rail || s.rail->profile == "box", {"scene.plane_strain", "rail.profile"},
            "plane strain needs a block under the tyre; state rail.profile = \"box\"");
    require(!s.rail || s.rail->crown_radius == 0, {"scene.plane_strain", "rail.crown_radius"},
            "plane strain is that of a rail that is straight across; state rail.crown_radius = 0, or "
            "scene.plane_strain = false");
    require(!s.corrugation, {"scene.plane_strain", "corrugation"},
            "a corrugation ends across the rail, and plane strain has no depth that varies across; state a "
            "[surface.NAME] with kind = \"waves\" or \"profile\", or scene.plane_strain = false");
    for (const auto& [name, surface] : s.surfaces) {
      const std::string kind = std::string(kSurfaceTables) + name + ".kind";
      require(surface.kind != "dent" && surface.kind != "map", {"scene.plane_strain", kind},
              fmt::format("a {} varies across, and plane strain has no depth that does; state kind = \"dip\" "
                          "or \"profile\", or scene.plane_strain = false",
                          surface.kind));
    }
  }

  void check_materials() {
    for (const auto& [name, material] : scene_.materials) {
      const std::string table = std::string(kMaterialTables) + name;
      require(material.name == name, {table},
              fmt::format("this material calls itself \"{}\"; a material has one name", material.name));
      require(
          !material.damping_up_to || material.rayleigh_beta > 0,
          {table + ".damping_up_to", table + ".damping"},
          "a frequency up to which damping holds belongs to damping = { kind = \"rayleigh_beta\", value = "
          "\"1e-4 s\" }");
    }
    for (const auto& [name, material] : scene_.materials)
      require(scene_.motion || material.law == "elastic", {std::string(kMaterialTables) + name + ".law"},
              fmt::format("law = \"{}\" has no effect without [motion]: the static state is elastic; state "
                          "\"elastic\", or add [motion]",
                          material.law));
    std::set<std::string> missing;
    for (const MaterialUse& use : material_uses(scene_))
      if (!knows(use.name) && missing.insert(use.name).second) report_missing(use);
    if (scene_.slab_track) check_slab(*scene_.slab_track);
  }

  bool knows(const std::string& material) const { return scene_.materials.contains(material); }

  /// "the sleepers need", "[body.web] needs"
  static std::string needy(const std::string& part) {
    if (part.find('.') != std::string::npos) return fmt::format("[{}] needs", part);
    return fmt::format("the {} {}", part, part.ends_with('s') ? "need" : "needs");
  }

  void report_missing(const MaterialUse& use) {
    std::vector<std::string> names;
    for (const auto& [name, material] : scene_.materials) names.push_back(name);
    const std::string similar = similar_text(use.name, names);
    require(false, {std::string(kMaterialTables) + use.name, use.key},
            fmt::format("{} [material.{}]; the scene's materials: {}{}", needy(use.part), use.name,
                        scene_.material_names(),
                        similar.empty() ? "" : fmt::format(" (did you mean {}?)", similar)));
  }

  void check_slab(const SlabSpec& slab) {
    require(slab.gap < slab.pitch, {"slab.gap", "slab.pitch"},
            fmt::format("the gap, {}, is not shorter than the pitch of slab and gap together, {}; state a "
                        "smaller slab.gap or a larger slab.pitch",
                        format_quantity(slab.gap, "mm"), format_quantity(slab.pitch, "mm")));
    const std::vector<std::string> names = {slab.material, slab.gap_material, slab.mortar_material};
    if (!std::all_of(names.begin(), names.end(), [&](const std::string& name) { return knows(name); }))
      return;
    const Material& first = scene_.material(slab.material);
    const auto damped_as_first = [&](const std::string& name) {
      const Material& other = scene_.material(name);
      return first.rayleigh_beta == other.rayleigh_beta &&
             first.high_frequency_fraction == other.high_frequency_fraction &&
             first.damping_up_to == other.damping_up_to;
    };
    std::vector<std::string> keys;
    for (const char* key : {".damping", ".damping_up_to"})
      for (const std::string& name : names) keys.push_back(std::string(kMaterialTables) + name + key);
    require(std::all_of(names.begin(), names.end(), damped_as_first), keys,
            "slab, gap filler and mortar are damped as one body; state the same damping for all three");
  }

  void check_friction(const ContactSpec& contact) {
    if (contact.friction_law == "table") {
      constexpr double kLargest = 2;
      for (std::size_t i = 0; i < contact.friction_at_x.size(); ++i)
        require(contact.friction_at_x[i] >= 0 && contact.friction_at_x[i] <= kLargest,
                {"contact.friction_file"},
                fmt::format("f = {:g} at x = {:g} m is not allowed; it must be from 0 to {:g}",
                            contact.friction_at_x[i], contact.friction_x[i], kLargest));
    }
    if (contact.friction_law != "falling") return;
    require(contact.friction_memory > 0, {"contact.friction_memory"},
            "without a memory the motion under falling friction is ill-posed: the shorter a wave of slip, "
            "the faster it grows (theory.md, Friction); state the sliding length over which the coefficient "
            "follows the slip speed, for example \"20 um\"");
    require(contact.friction_fast <= contact.friction, {"contact.friction_fast", "contact.friction"},
            fmt::format("the coefficient of fast slip, {:g}, is above that without slip, {:g}: friction "
                        "would not fall; state a smaller contact.friction_fast",
                        contact.friction_fast, contact.friction));
  }

  void check_rail(const RailSpec& rail) {
    require(rail.head_material.empty() || rail.profile != "box", {"rail.head_material", "rail.profile"},
            "a box has no head; state rail.material");
    require(rail.origin <= rail.length, {"rail.origin", "rail.length"},
            fmt::format("x = 0 lies {} from the rail's left end, beyond its right one at {}; state a smaller "
                        "rail.origin or a larger rail.length",
                        format_quantity(rail.origin, "m"), format_quantity(rail.length, "m")));
    require(
        rail.crown_radius == 0 || rail.width < 2 * rail.crown_radius, {"rail.width", "rail.crown_radius"},
        fmt::format("a box of {} is wider than its running surface's arc, {}; state a smaller rail.width, "
                    "a larger rail.crown_radius, or rail.crown_radius = 0 for a flat one",
                    format_quantity(rail.width, "mm"), format_quantity(2 * rail.crown_radius, "mm")));
    const bool fastened = rail.support == "fastenings";
    require(!fastened || scene_.fastenings, {"rail.support", "fastenings"},
            "the rail stands on fastenings; add [fastenings], or state rail.support = \"rigid\" or \"free\"");
    require(rail.support != "free" || !scene_.wheel, {"rail.support", "wheel"},
            "nothing carries a free rail under a wheel; state rail.support = \"rigid\" or \"fastenings\"");
    require(rail.support != "free" || scene_.wheel || scene_.gravity == 0, {"rail.support", "scene.gravity"},
            "nothing carries a free rail; state scene.gravity = \"0 m/s2\"");
    require(fastened || !scene_.fastenings, {"rail.support", "fastenings"},
            fmt::format("a rail with support = \"{}\" has no fastenings; state fastenings.present = false",
                        rail.support));
    if (!scene_.wheel) return;
    const double left = -rail.origin;
    const double right = rail.length - rail.origin;
    require(scene_.start_x() - left >= kRailEndMargin, {"motion.run_up", "rail.origin"},
            fmt::format("the wheel starts at x = {:.6g} m; the rail lets it start from {:.6g} m on: state a "
                        "larger rail.origin{}",
                        scene_.start_x(), left + kRailEndMargin,
                        scene_.start_x() < 0 ? " or a smaller motion.run_up" : ""));
    if (!knows(scene_.wheel->material)) return;
    const Travel travel = travel_of(scene_);
    const auto require_on_rail = [&](bool holds, double x, double end, const std::string& way_out) {
      require(
          holds, {"motion.duration", "motion.speed", "rail.length", "rail.origin"},
          fmt::format("the wheel rolls to x = {:.6g} m, beyond {:.6g} m, where it is {:g} m from the rail's "
                      "end; state a shorter motion.duration{}{}",
                      x, end, kRailEndMargin, way_out.empty() ? "" : ", or ", way_out));
    };
    const double last = right - kRailEndMargin;
    const double first = std::min(left + kRailEndMargin, scene_.start_x());
    require_on_rail(travel.last <= last + kLengthTolerance, travel.last, last,
                    keys_to_reach(scene_, travel.last).value_or(""));
    require_on_rail(travel.first >= first - kLengthTolerance, travel.first, first, "a larger rail.origin");
  }

  void check_motion(const MotionSpec& motion) {
    require(motion.start != "rolling" || (scene_.fastenings && scene_.wheel && scene_.wheel->bore == "free"),
            {"motion.start"},
            "only a free wheel on a rail on [fastenings] can have been rolling; state start = \"moving\"");
    require(!motion.traction_mu || !motion.traction_torque, {"motion.traction.torque", "motion.traction.mu"},
            "state the traction by mu or by torque, not both");
    const bool driven = motion.traction_mu || motion.traction_torque;
    require(!driven || motion.reversals == 0 || motion.ramp > 0,
            {"motion.traction.reversals", "motion.traction.ramp"},
            "a reversal takes 2 T1, and motion.traction.ramp = 0 leaves no time for it; state a "
            "motion.traction.ramp above 0, or motion.traction.reversals = 0");
    require(motion.creepage == 0 || motion.speed > 0, {"motion.creepage", "motion.speed"},
            "a wheel that stands has no creepage; state motion.speed");
    require(
        !scene_.forks || scene_.forks->at.value_or(0) <= motion.duration, {"forks.at", "motion.duration"},
        fmt::format("the state for forks would be kept at {:g} ms, after the run's end at {:g} ms; state a "
                    "smaller forks.at or a longer motion.duration",
                    1e3 * scene_.forks->at.value_or(0), 1e3 * motion.duration));
    if (scene_.wheel && knows(scene_.wheel->material)) check_rim(motion, scene_.wheel_material());
    require(motion.traction_mu.value_or(0) == 0 || scene_.contact, {"motion.traction.mu", "contact"},
            "a traction coefficient is a share of F_N and needs [contact]; state motion.traction.torque");
    if (!motion.traction_mu || !scene_.contact) return;
    const double largest = scene_.contact->largest_friction();
    require(
        std::abs(*motion.traction_mu) <= largest,
        {"motion.traction.mu",
         scene_.contact->friction_law == "table" ? "contact.friction_file" : "contact.friction"},
        fmt::format("a traction coefficient of {:g} cannot be reached with the coefficient of friction {:g}; "
                    "state at most that, or more friction",
                    *motion.traction_mu, largest));
  }

  void check_probe(const std::string& table, const ProbeSpec& probe, Require others) {
    require(scene_.motion.has_value(), {table}, "a probe needs [motion]: histories follow a motion");
    if (probe.body == "rail") {
      require(scene_.rail.has_value(), {table + ".body"}, "a point of the rail needs [rail]");
      if (scene_.rail) check_on_rail(*scene_.rail, probe.x, {table + ".x", table}, "the probe", others);
    } else if (probe.body == "wheel") {
      require(scene_.wheel.has_value(), {table + ".body"}, "a point of the wheel needs [wheel]");
      require(probe.quantity == "stress", {table + ".quantity", table},
              "a point that turns with the wheel has stress alone; state quantity = \"stress\"; the axle box "
              "has motion");
    } else {
      require(scene_.vehicle || scene_.load, {table + ".body"},
              "the axle box belongs to a journal that carries [vehicle] or [load]");
      require(!scene_.wheel || scene_.wheel->bore == "free", {table + ".body", "wheel.bore"},
              "a guided bore has no axle box; state wheel.bore = \"free\"");
      require(probe.quantity == "motion", {table + ".quantity", table},
              "the axle box has motion alone; state quantity = \"motion\"");
    }
  }

  /// A thin ring that spins strains by rho v^2 / E.
  void check_rim(const MotionSpec& motion, const Material& material) {
    constexpr double kLargestStrain = 0.01;
    const double fastest = std::sqrt(kLargestStrain * material.youngs_modulus / material.density);
    const std::string table = std::string(kMaterialTables) + material.name;
    const double rim = motion.speed * std::abs(motion.spin_ratio());
    require(rim <= fastest,
            {"motion.creepage", "motion.speed", table + ".youngs_modulus", table + ".density"},
            fmt::format(
                "the wheel's rim moves at {:.4g} m/s: spinning alone strains it by {:.2g}, which is not the "
                "small strain of linear elasticity; it must stay below {:.4g} m/s",
                rim, rim * rim * material.density / material.youngs_modulus, fastest));
  }

  const Scene& scene_;
  std::set<std::string> wrong_;
  std::vector<SceneProblem> problems_;
};

}  // namespace

std::vector<SceneProblem> validate(const Scene& scene) {
  return Checker(scene).run();
}

}  // namespace tread
