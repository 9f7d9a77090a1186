#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/geometry/built_in_profiles.hpp"
#include "core/mesh/wheel_section.hpp"
#include "io/scene/key_builders.hpp"
#include "io/scene/key_table.hpp"

namespace tread::keys {

void add_material(Keys& keys, const std::string& name) {
  const std::string table = std::string(kMaterialTables) + name;
  keys.push_back(required(quantity(table + ".youngs_modulus", {Effect::preload, Effect::cost},
                                   at(&Scene::materials, name, &Material::youngs_modulus), kStress, "GPa",
                                   above(0, 1e13), "Young's modulus")));
  keys.push_back(
      required(number(table + ".poissons_ratio", {Effect::preload, Effect::cost},
                      at(&Scene::materials, name, &Material::poissons_ratio), {0, 0.49}, "Poisson's ratio")));
  keys.push_back(
      required(quantity(table + ".density", {Effect::mesh}, at(&Scene::materials, name, &Material::density),
                        kDensity, "kg/m3", above(0, 1e5), "Density")));
  keys.push_back(
      choice(table + ".law", {Effect::motion, Effect::cost}, at(&Scene::materials, name, &Material::law),
             {"elastic", "j2"},
             "Law that gives the stress: `elastic` is linear and isotropic; `j2` yields after von Mises "
             "with linear isotropic and kinematic hardening. The static state is elastic"));
  const auto j2 = [&](Key key) { return only_with(table + ".law", "j2", std::move(key)); };
  keys.push_back(required(j2(quantity(table + ".yield_stress", {Effect::motion},
                                      at(&Scene::materials, name, &Material::yield_stress), kStress, "MPa",
                                      above(0, 1e13), "Initial yield stress in uniaxial tension"))));
  keys.push_back(
      j2(quantity(table + ".isotropic_hardening", {Effect::motion},
                  at(&Scene::materials, name, &Material::isotropic_hardening), kStress, "GPa", from(0, 1e13),
                  "Growth of the yield stress with the equivalent plastic strain")));
  keys.push_back(j2(quantity(table + ".kinematic_hardening", {Effect::motion},
                             at(&Scene::materials, name, &Material::kinematic_hardening), kStress, "GPa",
                             from(0, 1e13), "Growth of the backstress with the uniaxial plastic strain")));
  const auto damping = [name](Scene& scene) -> Field {
    const auto found = scene.materials.find(name);
    if (found == scene.materials.end()) return std::monostate{};
    return DampingField{&found->second.high_frequency_fraction, &found->second.rayleigh_beta};
  };
  keys.push_back(
      {.path = table + ".damping",
       .effects = {Effect::motion, Effect::cost},
       .kind = Kind::damping,
       .locate = damping,
       .description =
           "`{ kind = \"high_frequency_fraction\", value = 1e-4 }`: fraction of critical "
           "damping at the highest frequency of the material's mesh; or `{ kind = \"rayleigh_beta\", value = "
           "\"1e-8 s\" }`: classical stiffness-proportional damping",
       .range = from(0, 1)});
  keys.push_back(
      quantity(table + ".damping_up_to", {Effect::motion, Effect::cost},
               at(&Scene::materials, name, &Material::damping_up_to), kFrequency, "kHz", above(0, 1e9),
               "`rayleigh_beta` holds below this frequency only, by a Maxwell branch: loss "
               "nine tenths of beta w there, above it at most 1.7 times that, and a step that a beta of "
               "1e-4 s leaves too; stiffens above it by up to 6 pi f beta; none: at all frequencies"));
}

namespace {

/// Names of built-in profiles, and others behind them.
template <std::size_t Count>
std::vector<std::string> joined(const std::array<std::string_view, Count>& built_in,
                                const std::vector<std::string>& others = {}) {
  std::vector<std::string> names(built_in.begin(), built_in.end());
  names.insert(names.end(), others.begin(), others.end());
  return names;
}

/// The keys of `table` that change the points of its profile's file.
template <class Part>
void add_profile_file(Keys& keys, const std::string& table, std::optional<Part> Scene::*part,
                      double Part::*shift, double Part::*smoothing) {
  const std::string profile = table + ".profile";
  keys.push_back(with_file(profile, quantity(profile + "_shift", {Effect::mesh}, at(part, shift), kLength,
                                             "mm", {-0.2, 0.2}, "Added to y of the file's points")));
  keys.push_back(with_file(
      profile, quantity(profile + "_smoothing", {Effect::mesh}, at(part, smoothing), kLength, "mm", {0, 1e-3},
                        "Largest distance of a smoothing spline from the file's points; 0: the points are "
                        "interpolated")));
}

}  // namespace

void add_wheel(Keys& keys) {
  const auto half_wheelset = [](Key key) {
    return only_with("wheel.shape", "half_wheelset", std::move(key));
  };
  const auto tyre = [](Key key) { return only_with("wheel.shape", "tyre", std::move(key)); };
  keys.push_back(choice("wheel.shape", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::shape),
                        {"half_wheelset", "tyre"}, "Half a wheelset with its axle, or a plain ring"));
  keys.push_back(material_name("wheel.material", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::material),
                               "Material of the wheel or wheelset"));
  keys.push_back(or_file(
      choice("wheel.profile", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::profile),
             joined(kBuiltInWheels, {"arc", "cylinder"}),
             "Profile of the tread; a half wheelset takes LMA (TB/T 449), S1002 (EN 13715) or a file (two "
             "columns, SIMPACK, MiniProf, columns under a header), a tyre takes arc or cylinder")));
  add_profile_file(keys, "wheel", &Scene::wheel, &WheelSpec::profile_shift, &WheelSpec::profile_smoothing);
  keys.push_back(quantity(
      "wheel.diameter", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::diameter), kLength, "m", {0.1, 3},
      fmt::format("Diameter at the nominal rolling circle; of a half wheelset {:g} m to {:g} m",
                  kSmallestDiameter, kLargestDiameter)));
  keys.push_back(quantity(
      "wheel.lateral_offset", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::lateral_offset), kLength, "mm",
      {-0.05, 0.05},
      fmt::format(
          "Rail centre line in wheel coordinates, positive to the field side: half of (gauge + "
          "width of the rail head 14 mm below its crown - wheels' distance back to back), less "
          "the way from the flange's back to y = 0 of the profile, usually 70 mm, and less 18 mm times "
          "rail.inclination, by which the gauge face moves as the rail turns about its crown; the "
          "default belongs to an upright CN60 and wheels 1353 mm back to back; under a half wheelset at most "
          "{:g} mm to either side",
          1e3 * kMostAside)));
  keys.push_back(
      half_wheelset(quantity("wheel.mass", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::mass), kMass, "kg",
                             above(0, 1e4), "Mass that the web, or the brake rings, are sized to reach")));
  keys.push_back(half_wheelset(
      quantity("wheel.web_thickness", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::web_thickness), kLength,
               "mm", {kThinnestWeb, kThickestWeb},
               "Thickness of the web; absent: as the mass needs, or 30 mm with brake rings. "
               "Without brake rings it has "
               "to agree with the mass within 1 %")));
  keys.push_back(
      half_wheelset(quantity("wheel.web_offset", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::web_offset),
                             kLength, "mm", {-kMostOffset, kMostOffset},
                             "Way from the web's middle at the hub to that at the rim, to the field side")));
  keys.push_back(half_wheelset(
      quantity("wheel.web_wave", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::web_wave), kLength, "mm",
               {-kMostWave, kMostWave},
               "Largest way of an S-shaped web to either side; positive: to the field side near the hub")));
  keys.push_back(half_wheelset(or_file(choice(
      "wheel.web", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::web), {"stated"},
      "The web by thickness, offset and wave, or by a file of its outline: two columns after a line such as "
      "`# y [mm]  r [mm]`, points from the hub along one face to the rim and back along the other; y to the "
      "field side of the nominal rolling circle, r from the axis"))));
  keys.push_back(
      half_wheelset(flag("wheel.brake_rings", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::brake_rings),
                         "Two ring plates on the web, bolted along a circle, as thick as the mass needs")));
  keys.push_back(
      half_wheelset(quantity("wheel.axle_bore", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::axle_bore),
                             kLength, "mm", {kNarrowestBore, kWidestBore}, "Bore of the hollow axle")));
  keys.push_back(
      only_with("wheel.profile", "arc",
                quantity("wheel.crown_radius", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::crown_radius),
                         kLength, "m", above(0, 1000), "Radius of the profile across the tread")));
  keys.push_back(tyre(quantity("wheel.width", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::width), kLength,
                               "mm", above(0, 1), "Width of the ring")));
  keys.push_back(tyre(quantity("wheel.thickness", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::thickness),
                               kLength, "mm", above(0, 1), "Radial thickness of the ring")));
  keys.push_back(tyre(choice(
      "wheel.bore", {Effect::preload, Effect::cost}, at(&Scene::wheel, &WheelSpec::bore), {"free", "guided"},
      "The ring's bore: elastic and free, or on a rigid carrier that moves forward with "
      "motion.speed and is free to rise and to turn")));
  keys.push_back(only_with("wheel.bore", "guided",
                           quantity("wheel.overhang", {Effect::mesh}, at(&Scene::wheel, &WheelSpec::overhang),
                                    kLength, "mm", above(0, 10),
                                    "Tread before and behind the part that rolls on the rail; absent: the "
                                    "whole ring")));
}

void add_rail(Keys& keys) {
  const auto box = [](Key key) { return only_with("rail.profile", "box", std::move(key)); };
  keys.push_back(material_name("rail.material", {Effect::preload, Effect::cost},
                               at(&Scene::rail, &RailSpec::material), "Material of the rail"));
  keys.push_back(material_name(
      "rail.head_material", {Effect::preload, Effect::cost}, at(&Scene::rail, &RailSpec::head_material),
      "Material of the finely divided head, for example one that yields; empty: that of the rail. "
      "A box has no head"));
  keys.push_back(or_file(choice(
      "rail.profile", {Effect::mesh}, at(&Scene::rail, &RailSpec::profile), joined(kBuiltInRails, {"box"}),
      "Cross-section: CN60 (GB 2585), a rail of EN 13674-1, or a box; also a file (two "
      "columns, SIMPACK, MiniProf, columns under a header), which replaces the surface of the "
      "head of `section`")));
  keys.push_back(
      with_file("rail.profile", choice("rail.section", {Effect::mesh}, at(&Scene::rail, &RailSpec::section),
                                       joined(kBuiltInRails), "Rail whose head the file replaces")));
  keys.push_back(with_file(
      "rail.profile",
      flag("rail.profile_mirrored", {Effect::mesh}, at(&Scene::rail, &RailSpec::profile_mirrored),
           "The file's y counts to the gauge side: its sign and the order are turned, before the shift")));
  add_profile_file(keys, "rail", &Scene::rail, &RailSpec::profile_shift, &RailSpec::profile_smoothing);
  keys.push_back(not_with("rail.profile", "box", 0,
                          number("rail.inclination", {Effect::mesh}, at(&Scene::rail, &RailSpec::inclination),
                                 {0, 0.1}, "Slope of the rail towards the track's middle", Kind::ratio)));
  keys.push_back(quantity("rail.length", {Effect::mesh}, at(&Scene::rail, &RailSpec::length), kLength, "m",
                          above(0, 1000), "Length of the rail"));
  keys.push_back(quantity("rail.origin", {Effect::mesh}, at(&Scene::rail, &RailSpec::origin), kLength, "m",
                          from(0, 1000), "Distance of x = 0 from the rail's left end"));
  keys.push_back(
      choice("rail.support", {Effect::preload, Effect::cost}, at(&Scene::rail, &RailSpec::support),
             {"fastenings", "rigid", "free"},
             "Support of the rail: fastenings, a fixed bottom, or none. Its ends do not move along x "
             "but in a bar under [pulse]"));
  keys.push_back(box(quantity("rail.width", {Effect::mesh}, at(&Scene::rail, &RailSpec::width), kLength, "mm",
                              above(0, 1), "Width of the box")));
  keys.push_back(box(quantity("rail.height", {Effect::mesh}, at(&Scene::rail, &RailSpec::height), kLength,
                              "mm", above(0, 1), "Height of the box")));
  keys.push_back(
      box(quantity("rail.crown_radius", {Effect::mesh}, at(&Scene::rail, &RailSpec::crown_radius), kLength,
                   "m", from(0, 1000), "Radius of the box's running surface across the rail, 0: flat")));
}

namespace {

/// `damping`: what the dampers affect; only those along x enter the start of rolling.
void add_foot_hold(Keys& keys, const std::string& path, FootHold FasteningSpec::*hold, Effects damping,
                   const char* description) {
  keys.push_back(choice(path, {Effect::preload, Effect::cost}, at(&Scene::fastenings, hold, &FootHold::kind),
                        {"held", "free", "elastic"}, description));
  keys.push_back(
      required(only_with(path, "elastic",
                         quantity(path + "_stiffness", {Effect::preload, Effect::cost},
                                  at(&Scene::fastenings, hold, &FootHold::stiffness), kStiffness, "MN/m",
                                  above(0, 1e10), "Stiffness of one fastening in that direction"))));
  keys.push_back(only_with(
      path, "elastic",
      quantity(path + "_damping", damping, at(&Scene::fastenings, hold, &FootHold::damping), kViscousDamping,
               "kN s/m", from(0, 1e7), "Damping of one fastening in that direction")));
}

}  // namespace

void add_fastenings(Keys& keys) {
  const auto length = [&](const char* name, Effects effects, double FasteningSpec::*member, Bounds range,
                          const char* description) {
    keys.push_back(quantity(name, effects, at(&Scene::fastenings, member), kLength, "m", range, description));
  };
  const auto count = [&](const char* name, Effects effects, int FasteningSpec::*member, Bounds range,
                         const char* description) {
    keys.push_back(number(name, effects, at(&Scene::fastenings, member), range, description, Kind::integer));
  };
  count("fastenings.count", {Effect::preload, Effect::cost}, &FasteningSpec::count, {1, 10000},
        "Number of fastenings");
  length("fastenings.spacing", {Effect::preload, Effect::cost}, &FasteningSpec::spacing, above(0, 10),
         "Distance between neighbours");
  length("fastenings.first", {Effect::preload, Effect::cost}, &FasteningSpec::first, from(0, 1000),
         "Distance of the first from the rail's left end");
  keys.push_back(quantity("fastenings.stiffness", {Effect::preload, Effect::cost},
                          at(&Scene::fastenings, &FasteningSpec::stiffness), kStiffness, "MN/m",
                          above(0, 1e10), "Vertical stiffness of one fastening"));
  keys.push_back(quantity("fastenings.damping", {Effect::preload, Effect::cost},
                          at(&Scene::fastenings, &FasteningSpec::damping), kViscousDamping, "kN s/m",
                          from(0, 1e7), "Vertical damping of one fastening"));
  length("fastenings.pad_length", {Effect::preload, Effect::cost}, &FasteningSpec::pad_length, above(0, 1),
         "Length of the pad along x: its columns of spring-dampers stand in the middle of equal parts");
  length("fastenings.pad_width", {Effect::preload, Effect::cost}, &FasteningSpec::pad_width, above(0, 1),
         "Width of the pad: its rows of spring-dampers stand in the middle of equal parts");
  count("fastenings.columns", {Effect::preload, Effect::cost}, &FasteningSpec::columns, {1, 20},
        "Spring-dampers along x");
  count("fastenings.rows", {Effect::preload, Effect::cost}, &FasteningSpec::rows, {1, 20},
        "Spring-dampers across the rail");
  add_foot_hold(
      keys, "fastenings.along", &FasteningSpec::along, {Effect::preload, Effect::cost},
      "The rail's foot along x at the fastenings: it cannot move, moves freely (for vertical forces alone), "
      "or is held by springs and dampers to the ground");
  add_foot_hold(keys, "fastenings.across", &FasteningSpec::across, {Effect::motion, Effect::cost},
                "The rail's foot across the rail, as `along`; `free` in plane strain alone");
  keys.push_back(
      choice("fastenings.held_at", {Effect::preload, Effect::cost},
             at(&Scene::fastenings, &FasteningSpec::held_at), {"pad", "springs"},
             "Held part of the foot: all of it over the pad, or the nodes nearest to the spring-dampers, "
             "which give way the more the finer the mesh"));
  keys.push_back(or_file(choice(
      "fastenings.supports", {Effect::mesh}, at(&Scene::fastenings, &FasteningSpec::supports), {"alike"},
      "File of supports that differ, a row each, after a line such as `# fastening [-]  "
      "shift [mm]  stiffness [-]`; columns are the keys of `[support.NAME]`, `holds` as 1 "
      "or 0")));
}

void add_slab(Keys& keys) {
  const auto length = [&](const char* name, Effects effects, double SlabSpec::*member, const char* unit,
                          Bounds range, const char* description) {
    keys.push_back(
        quantity(name, effects, at(&Scene::slab_track, member), kLength, unit, range, description));
  };
  length("slab.pitch", {Effect::mesh}, &SlabSpec::pitch, "m", above(0, 1000),
         "Length of a slab and a gap together");
  length("slab.gap", {Effect::mesh}, &SlabSpec::gap, "mm", above(0, 10), "Length of the gap between slabs");
  length("slab.first_gap", {Effect::mesh}, &SlabSpec::first_gap, "m", from(-1000, 1000),
         "Distance of the first gap's centre from the rail's left end");
  length("slab.width", {Effect::mesh}, &SlabSpec::width, "m", above(0, 10), "Width under one rail");
  length("slab.thickness", {Effect::mesh}, &SlabSpec::thickness, "m", above(0, 10), "Thickness of the slab");
  length("slab.mortar_thickness", {Effect::mesh}, &SlabSpec::mortar_thickness, "mm", above(0, 10),
         "Thickness of the mortar");
  length("slab.offset", {Effect::mesh}, &SlabSpec::offset, "m", from(-10, 10),
         "y of the slab's middle from the rail's centre line");
  keys.push_back(material_name("slab.material", {Effect::preload, Effect::cost},
                               at(&Scene::slab_track, &SlabSpec::material), "Material of the slabs"));
  keys.push_back(material_name("slab.gap_material", {Effect::preload, Effect::cost},
                               at(&Scene::slab_track, &SlabSpec::gap_material),
                               "Material in the gaps between slabs"));
  keys.push_back(material_name("slab.mortar_material", {Effect::preload, Effect::cost},
                               at(&Scene::slab_track, &SlabSpec::mortar_material),
                               "Material of the layer under the slabs"));
}

void add_sleepers(Keys& keys) {
  const auto length = [&](const char* name, double SleeperSpec::*member, const char* unit, Bounds range,
                          const char* description) {
    keys.push_back(
        quantity(name, {Effect::mesh}, at(&Scene::sleepers, member), kLength, unit, range, description));
  };
  length("sleepers.width", &SleeperSpec::width, "m", above(0, 10), "Width of a sleeper along x");
  length("sleepers.length", &SleeperSpec::length, "m", above(0, 10),
         "Length of a half sleeper, from the track's middle to its end");
  length("sleepers.height", &SleeperSpec::height, "m", above(0, 10), "Height of a sleeper");
  length("sleepers.offset", &SleeperSpec::offset, "m", from(-10, 10),
         "y of the half sleeper's middle from the rail's centre line");
  keys.push_back(material_name("sleepers.material", {Effect::preload, Effect::cost},
                               at(&Scene::sleepers, &SleeperSpec::material), "Material of the sleepers"));
  keys.push_back(
      quantity("sleepers.stiffness", {Effect::preload, Effect::cost},
               at(&Scene::sleepers, &SleeperSpec::stiffness), kStiffness, "MN/m", above(0, 1e12),
               "Vertical stiffness of the bed under a half sleeper: ballast, ground and pads under "
               "the sleeper in series"));
  keys.push_back(quantity("sleepers.damping", {Effect::preload, Effect::cost},
                          at(&Scene::sleepers, &SleeperSpec::damping), kViscousDamping, "kN s/m",
                          from(0, 1e9), "Vertical damping of the bed under a half sleeper"));
}

void add_support(Keys& keys, const std::string& name) {
  const std::string table = std::string(kSupportTables) + name;
  const Effects effects = {Effect::preload, Effect::cost};
  const auto place = [&](auto member) { return at(&Scene::supports, name, member); };
  const auto share = [&](const char* key, auto member, const char* description) {
    return number(table + key, effects, place(member), {0, 1000}, description);
  };
  keys.push_back(required(number(table + ".fastening", effects, place(&SupportSpec::fastening), {1, 10000},
                                 "The fastening, counted along x from 1", Kind::integer)));
  keys.push_back(quantity(table + ".shift", {Effect::mesh}, place(&SupportSpec::shift), kLength, "mm",
                          {-10, 10}, "Way along x from the regular place, of the fastening and its sleeper"));
  keys.push_back(share(".stiffness", &SupportSpec::stiffness,
                       "Vertical stiffness of the fastening over `fastenings.stiffness`; 0: broken"));
  keys.push_back(share(".damping", &SupportSpec::damping,
                       "Vertical damping of the fastening over `fastenings.damping`; absent: 1, or 0 where "
                       "`stiffness` is 0"));
  keys.push_back(with_table("sleepers", share(".bed", &SupportSpec::bed,
                                              "Stiffness and damping of the sleeper's bed over those of the "
                                              "others; 0: the sleeper hangs on the rail")));
  keys.push_back(flag(table + ".holds", effects, place(&SupportSpec::holds),
                      "The fastening holds the rail's foot along and across as the others do; `false`: not "
                      "at all"));
}

void add_vehicle_and_load(Keys& keys) {
  keys.push_back(
      quantity("vehicle.sprung_mass", {Effect::preload, Effect::cost},
               at(&Scene::vehicle, &VehicleSpec::sprung_mass), kMass, "kg", above(0, 1e5),
               "Sprung mass M_c on this wheel; half the axle load is (`sprung_mass` + `unsprung_mass` + "
               "half wheelset) times `scene.gravity`, `tread check` shows both"));
  keys.push_back(quantity("vehicle.unsprung_mass", {Effect::preload, Effect::cost},
                          at(&Scene::vehicle, &VehicleSpec::unsprung_mass), kMass, "kg", from(0, 1e5),
                          "Unsprung mass M_a attached to the wheelset"));
  keys.push_back(quantity("vehicle.suspension_stiffness", {Effect::preload},
                          at(&Scene::vehicle, &VehicleSpec::suspension_stiffness), kStiffness, "kN/m",
                          above(0, 1e9), "Vertical stiffness K of the primary suspension"));
  keys.push_back(quantity("vehicle.suspension_damping", {Effect::preload},
                          at(&Scene::vehicle, &VehicleSpec::suspension_damping), kViscousDamping, "kN s/m",
                          from(0, 1e7), "Vertical damping C of the primary suspension"));
  keys.push_back(choice("vehicle.longitudinal", {Effect::motion},
                        at(&Scene::vehicle, &VehicleSpec::longitudinal), {"carried", "free"},
                        "Motion of the sprung mass along x: carried rigidly with the journal, or free, so "
                        "that traction speeds up wheelset and unsprung mass alone"));
  keys.push_back(
      required(quantity("load.wheel_load", {Effect::preload, Effect::cost},
                        at(&Scene::load, &LoadSpec::wheel_load), kForce, "kN", above(0, 1e7),
                        "Downward force on the wheel's journal or bore; the wheel's weight comes on top")));
}

}  // namespace tread::keys
