#include "io/scene/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tread {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Bounds above(double low, double high = kInfinity) {
  return {low, high, true, false};
}
Bounds from(double low, double high = kInfinity) {
  return {low, high, false, false};
}

/// A member of the scene itself.
template <class Member>
std::function<Field(Scene&)> at(Member Scene::*member) {
  return [member](Scene& scene) -> Field { return &(scene.*member); };
}

/// A member of a component.
template <class Spec, class Member>
std::function<Field(Scene&)> at(std::optional<Spec> Scene::*spec, Member Spec::*member) {
  return [spec, member](Scene& scene) -> Field {
    if (!(scene.*spec)) return std::monostate{};
    return &(*(scene.*spec).*member);
  };
}

/// A member of a part that is always there.
template <class Spec, class Member>
std::function<Field(Scene&)> at(Spec Scene::*spec, Member Spec::*member) {
  return [spec, member](Scene& scene) -> Field { return &(scene.*spec.*member); };
}

/// A member of the material of that name.
template <class Member>
std::function<Field(Scene&)> at(const std::string& material, Member Material::*member) {
  return [material, member](Scene& scene) -> Field {
    const auto found = scene.materials.find(material);
    if (found == scene.materials.end()) return std::monostate{};
    return &(found->second.*member);
  };
}

Key quantity(std::string path, std::function<Field(Scene&)> locate, const Quantity& of, std::string unit,
             Bounds range, std::string description) {
  return {.path = std::move(path),
          .kind = Kind::quantity,
          .locate = std::move(locate),
          .description = std::move(description),
          .quantity = &of,
          .unit = std::move(unit),
          .range = range};
}

Key number(std::string path, std::function<Field(Scene&)> locate, Bounds range, std::string description,
           Kind kind = Kind::number) {
  return {.path = std::move(path),
          .kind = kind,
          .locate = std::move(locate),
          .description = std::move(description),
          .range = range};
}

Key choice(std::string path, std::function<Field(Scene&)> locate, std::vector<std::string> allowed,
           std::string description) {
  return {.path = std::move(path),
          .kind = Kind::text,
          .locate = std::move(locate),
          .description = std::move(description),
          .allowed = std::move(allowed)};
}

/// A text that names the material of a part.
Key material_name(std::string path, std::function<Field(Scene&)> locate, std::string description) {
  return {.path = std::move(path),
          .kind = Kind::text,
          .locate = std::move(locate),
          .description = std::move(description),
          .names_material = true};
}

Key flag(std::string path, std::function<Field(Scene&)> locate, std::string description) {
  return {.path = std::move(path),
          .kind = Kind::boolean,
          .locate = std::move(locate),
          .description = std::move(description)};
}

Key required(Key key) {
  key.required = true;
  return key;
}

Key or_file(Key key) {
  key.takes_file = true;
  return key;
}

Key only_with(std::string condition, std::vector<std::string> values, Key key) {
  key.only_with = {std::move(condition), std::move(values)};
  return key;
}

Key with_table(std::string table, Key key) {
  return only_with(std::move(table), std::vector<std::string>{}, std::move(key));
}

Key only_with(std::string condition, std::string value, Key key) {
  return only_with(std::move(condition), std::vector<std::string>{std::move(value)}, std::move(key));
}

Key instead_of(std::string other, Key key) {
  key.excludes = std::move(other);
  return key;
}

using Keys = std::vector<Key>;

void add_general(Keys& keys) {
  keys.push_back({.path = "scene.title",
                  .kind = Kind::text,
                  .locate = at(&Scene::title),
                  .description = "Name of the scene in reports"});
  keys.push_back({.path = "scene.based_on",
                  .kind = Kind::directive,
                  .locate = {},
                  .description = "Library entry whose values hold where the file states none"});
  keys.push_back(choice("scene.quality", at(&Scene::quality), {"draft", "standard", "paper"},
                        "Fineness of the generated mesh: elements of 2.2, 1.6 or 1.1 mm in the contact "
                        "surface; `paper` has 1.48 million in the paper's scene, where the paper had 1.46"));
  keys.push_back(
      choice("scene.precision", at(&Scene::precision), {"double", "mixed", "single"},
             "Of nodes and elements while they move: `mixed` keeps displacements in double and the "
             "rest in "
             "single precision, `single` keeps them in single too. The static state, contact, "
             "frames, time and sums are in double always"));
  keys.push_back(quantity("scene.element_size", at(&Scene::element_size), kLength, "mm", above(0, 0.1),
                          "Element size in the contact surface, in place of the quality's"));
  keys.push_back(quantity("scene.gravity", at(&Scene::gravity), kAcceleration, "m/s2", from(0, 100),
                          "Acceleration of gravity"));
  keys.push_back(only_with("wheel.shape", "tyre",
                           flag("scene.plane_strain", at(&Scene::plane_strain),
                                "Nothing moves across: a slice of a wide tyre on a wide block")));
  keys.push_back(with_table("wheel", quantity("solution_zone.start", at(&Scene::zone_start), kLength, "m",
                                              from(-1000, 1000), "x where the finely divided rail starts")));
  keys.push_back(with_table("wheel", quantity("solution_zone.length", at(&Scene::zone_length), kLength, "m",
                                              above(0, 1000), "Length of the finely divided rail")));
}

/// The keys of the material of that name.
void add_material(Keys& keys, const std::string& name) {
  const std::string table = std::string(kMaterialTables) + name;
  keys.push_back(required(quantity(table + ".youngs_modulus", at(name, &Material::youngs_modulus), kStress,
                                   "GPa", above(0, 1e13), "Young's modulus")));
  keys.push_back(required(number(table + ".poissons_ratio", at(name, &Material::poissons_ratio),
                                 {0, 0.5, false, true}, "Poisson's ratio")));
  keys.push_back(required(quantity(table + ".density", at(name, &Material::density), kDensity, "kg/m3",
                                   above(0, 1e5), "Density")));
  keys.push_back(
      choice(table + ".law", at(name, &Material::law), {"elastic", "j2"},
             "Law that gives the stress: `elastic` is linear and isotropic; `j2` yields after von Mises "
             "with linear isotropic and kinematic hardening. The static state is elastic"));
  const auto j2 = [&](Key key) { return only_with(table + ".law", "j2", std::move(key)); };
  keys.push_back(required(j2(quantity(table + ".yield_stress", at(name, &Material::yield_stress), kStress,
                                      "MPa", above(0, 1e13), "Initial yield stress in uniaxial tension"))));
  keys.push_back(
      j2(quantity(table + ".isotropic_hardening", at(name, &Material::isotropic_hardening), kStress, "GPa",
                  from(0, 1e13), "Growth of the yield stress with the equivalent plastic strain")));
  keys.push_back(
      j2(quantity(table + ".kinematic_hardening", at(name, &Material::kinematic_hardening), kStress, "GPa",
                  from(0, 1e13), "Growth of the backstress with the uniaxial plastic strain")));
  const auto damping = [name](Scene& scene) -> Field {
    const auto found = scene.materials.find(name);
    if (found == scene.materials.end()) return std::monostate{};
    return DampingField{&found->second.high_frequency_fraction, &found->second.rayleigh_beta};
  };
  keys.push_back(
      {.path = table + ".damping",
       .kind = Kind::damping,
       .locate = damping,
       .description =
           "`{ kind = \"high_frequency_fraction\", value = 1e-4 }`: fraction of critical "
           "damping at the highest frequency of the material's mesh; or `{ kind = \"rayleigh_beta\", value = "
           "\"1e-8 s\" }`: classical stiffness-proportional damping",
       .range = from(0, 1)});
  keys.push_back(
      quantity(table + ".damping_up_to", at(name, &Material::damping_up_to), kFrequency, "kHz", above(0, 1e9),
               "`rayleigh_beta` holds below this frequency only, by a Maxwell branch: loss "
               "nine tenths of beta w there, above it at most 1.7 times that, and a step that a beta of "
               "1e-4 s leaves too; none: at all frequencies"));
}

void add_wheel(Keys& keys) {
  const auto half_wheelset = [](Key key) {
    return only_with("wheel.shape", "half_wheelset", std::move(key));
  };
  const auto tyre = [](Key key) { return only_with("wheel.shape", "tyre", std::move(key)); };
  keys.push_back(choice("wheel.shape", at(&Scene::wheel, &WheelSpec::shape), {"half_wheelset", "tyre"},
                        "Half a wheelset with its axle, or a plain ring"));
  keys.push_back(material_name("wheel.material", at(&Scene::wheel, &WheelSpec::material),
                               "Material of the wheel or wheelset"));
  keys.push_back(
      or_file(choice("wheel.profile", at(&Scene::wheel, &WheelSpec::profile), {"LMA", "arc", "cylinder"},
                     "Profile of the tread; a half wheelset takes LMA or a file of two columns (y, z), a "
                     "tyre takes arc or cylinder")));
  keys.push_back(quantity("wheel.diameter", at(&Scene::wheel, &WheelSpec::diameter), kLength, "m", {0.1, 3},
                          "Diameter at the nominal rolling circle"));
  keys.push_back(quantity("wheel.lateral_offset", at(&Scene::wheel, &WheelSpec::lateral_offset), kLength,
                          "mm", {-0.05, 0.05},
                          "Rail centre line in wheel coordinates, positive to the field side"));
  keys.push_back(half_wheelset(quantity("wheel.mass", at(&Scene::wheel, &WheelSpec::mass), kMass, "kg",
                                        above(0, 1e4), "Mass that the brake disc ring is sized to reach")));
  keys.push_back(half_wheelset(quantity("wheel.axle_bore", at(&Scene::wheel, &WheelSpec::axle_bore), kLength,
                                        "mm", above(0, 0.15), "Bore of the hollow axle")));
  keys.push_back(only_with("wheel.profile", "arc",
                           quantity("wheel.crown_radius", at(&Scene::wheel, &WheelSpec::crown_radius),
                                    kLength, "m", above(0, 1000), "Radius of the profile across the tread")));
  keys.push_back(tyre(quantity("wheel.width", at(&Scene::wheel, &WheelSpec::width), kLength, "mm",
                               above(0, 1), "Width of the ring")));
  keys.push_back(tyre(quantity("wheel.thickness", at(&Scene::wheel, &WheelSpec::thickness), kLength, "mm",
                               above(0, 1), "Radial thickness of the ring")));
  keys.push_back(
      tyre(choice("wheel.bore", at(&Scene::wheel, &WheelSpec::bore), {"free", "guided"},
                  "The ring's bore: elastic and free, or on a rigid carrier that moves forward with "
                  "motion.speed and is free to rise and to turn")));
  keys.push_back(only_with(
      "wheel.bore", "guided",
      quantity("wheel.overhang", at(&Scene::wheel, &WheelSpec::overhang), kLength, "mm", above(0, 10),
               "Tread before and behind the part that rolls on the rail; absent: the "
               "whole ring")));
}

void add_rail(Keys& keys) {
  const auto box = [](Key key) { return only_with("rail.profile", "box", std::move(key)); };
  keys.push_back(
      material_name("rail.material", at(&Scene::rail, &RailSpec::material), "Material of the rail"));
  keys.push_back(or_file(choice("rail.profile", at(&Scene::rail, &RailSpec::profile), {"CN60", "box"},
                                "Cross-section; also a file of two columns (y, z)")));
  keys.push_back(number("rail.inclination", at(&Scene::rail, &RailSpec::inclination), {0, 0.1},
                        "Slope of the rail towards the track's middle", Kind::ratio));
  keys.push_back(quantity("rail.length", at(&Scene::rail, &RailSpec::length), kLength, "m", above(0, 1000),
                          "Length of the rail"));
  keys.push_back(quantity("rail.origin", at(&Scene::rail, &RailSpec::origin), kLength, "m", from(0, 1000),
                          "Distance of x = 0, the wheel's first position, from the rail's left end"));
  keys.push_back(choice("rail.support", at(&Scene::rail, &RailSpec::support), {"fastenings", "rigid", "free"},
                        "What the rail stands on: fastenings, a fixed bottom, or nothing"));
  keys.push_back(box(quantity("rail.width", at(&Scene::rail, &RailSpec::width), kLength, "mm", above(0, 1),
                              "Width of the box")));
  keys.push_back(box(quantity("rail.height", at(&Scene::rail, &RailSpec::height), kLength, "mm", above(0, 1),
                              "Height of the box")));
  keys.push_back(
      box(quantity("rail.crown_radius", at(&Scene::rail, &RailSpec::crown_radius), kLength, "m",
                   from(0, 1000), "Radius of the box's running surface across the rail, 0: flat")));
}

void add_fastenings(Keys& keys) {
  const auto length = [&](const char* name, double FasteningSpec::*member, Bounds range,
                          const char* description) {
    keys.push_back(quantity(name, at(&Scene::fastenings, member), kLength, "m", range, description));
  };
  const auto count = [&](const char* name, int FasteningSpec::*member, Bounds range,
                         const char* description) {
    keys.push_back(number(name, at(&Scene::fastenings, member), range, description, Kind::integer));
  };
  count("fastenings.count", &FasteningSpec::count, {1, 10000}, "Number of fastenings");
  length("fastenings.spacing", &FasteningSpec::spacing, above(0, 10), "Distance between neighbours");
  length("fastenings.first", &FasteningSpec::first, from(0, 1000),
         "Distance of the first from the rail's left end");
  keys.push_back(quantity("fastenings.stiffness", at(&Scene::fastenings, &FasteningSpec::stiffness),
                          kStiffness, "MN/m", above(0, 1e10), "Vertical stiffness of one fastening"));
  keys.push_back(quantity("fastenings.damping", at(&Scene::fastenings, &FasteningSpec::damping),
                          kViscousDamping, "kN s/m", from(0, 1e7), "Vertical damping of one fastening"));
  length("fastenings.pad_length", &FasteningSpec::pad_length, above(0, 1),
         "Length of the pad along x: its columns of spring-dampers stand in the middle of equal parts");
  length("fastenings.pad_width", &FasteningSpec::pad_width, above(0, 1),
         "Width of the pad: its rows of spring-dampers stand in the middle of equal parts");
  count("fastenings.columns", &FasteningSpec::columns, {1, 20}, "Spring-dampers along x");
  count("fastenings.rows", &FasteningSpec::rows, {1, 20}, "Spring-dampers across the rail");
}

void add_slab(Keys& keys) {
  const auto length = [&](const char* name, double SlabSpec::*member, const char* unit, Bounds range,
                          const char* description) {
    keys.push_back(quantity(name, at(&Scene::slab_track, member), kLength, unit, range, description));
  };
  length("slab.pitch", &SlabSpec::pitch, "m", above(0, 1000), "Length of a slab and a gap together");
  length("slab.gap", &SlabSpec::gap, "mm", above(0, 10), "Length of the gap between slabs");
  length("slab.first_gap", &SlabSpec::first_gap, "m", from(-1000, 1000),
         "Distance of the first gap's centre from the rail's left end");
  length("slab.width", &SlabSpec::width, "m", above(0, 10), "Width under one rail");
  length("slab.thickness", &SlabSpec::thickness, "m", above(0, 10), "Thickness of the slab");
  length("slab.mortar_thickness", &SlabSpec::mortar_thickness, "mm", above(0, 10), "Thickness of the mortar");
  length("slab.offset", &SlabSpec::offset, "m", from(-10, 10),
         "y of the slab's middle from the rail's centre line");
  keys.push_back(
      material_name("slab.material", at(&Scene::slab_track, &SlabSpec::material), "Material of the slabs"));
  keys.push_back(material_name("slab.gap_material", at(&Scene::slab_track, &SlabSpec::gap_material),
                               "Material in the gaps between slabs"));
  keys.push_back(material_name("slab.mortar_material", at(&Scene::slab_track, &SlabSpec::mortar_material),
                               "Material of the layer under the slabs"));
}

void add_vehicle_and_load(Keys& keys) {
  keys.push_back(quantity("vehicle.sprung_mass", at(&Scene::vehicle, &VehicleSpec::sprung_mass), kMass, "kg",
                          above(0, 1e5), "Sprung mass M_c on this wheel"));
  keys.push_back(quantity("vehicle.unsprung_mass", at(&Scene::vehicle, &VehicleSpec::unsprung_mass), kMass,
                          "kg", from(0, 1e5), "Unsprung mass M_a attached to the wheelset"));
  keys.push_back(quantity("vehicle.suspension_stiffness",
                          at(&Scene::vehicle, &VehicleSpec::suspension_stiffness), kStiffness, "kN/m",
                          above(0, 1e9), "Vertical stiffness K of the primary suspension"));
  keys.push_back(quantity("vehicle.suspension_damping", at(&Scene::vehicle, &VehicleSpec::suspension_damping),
                          kViscousDamping, "kN s/m", from(0, 1e7),
                          "Vertical damping C of the primary suspension"));
  keys.push_back(required(quantity("load.wheel_load", at(&Scene::load, &LoadSpec::wheel_load), kForce, "kN",
                                   above(0, 1e7), "Downward force on the wheel")));
}

void add_friction(Keys& keys) {
  const auto with = [](std::vector<std::string> laws, Key key) {
    return only_with("contact.friction_law", std::move(laws), std::move(key));
  };
  keys.push_back(choice("contact.friction_law", at(&Scene::contact, &ContactSpec::friction_law),
                        {"coulomb", "table", "falling"},
                        "Coefficient of friction: one for all, along the rail by a file, or falling with "
                        "the slip speed"));
  keys.push_back(with({"coulomb", "falling"},
                      number("contact.friction", at(&Scene::contact, &ContactSpec::friction), {0, 2},
                             "Coefficient of friction f; of falling friction without slip")));
  keys.push_back(with(
      {"falling"}, number("contact.friction_fast", at(&Scene::contact, &ContactSpec::friction_fast), {0, 2},
                          "Coefficient of friction of fast slip; dry rails: 0.4 f after "
                          "Polach (2005)")));
  keys.push_back(
      with({"falling"}, quantity("contact.friction_speed", at(&Scene::contact, &ContactSpec::friction_speed),
                                 kSpeed, "m/s", above(0, 1000),
                                 "Slip speed that leaves 1/e of the fall; dry rails: 1.67 m/s after Polach "
                                 "(2005), wet ones 5 m/s")));
  keys.push_back(
      with({"falling"},
           required(quantity("contact.friction_memory", at(&Scene::contact, &ContactSpec::friction_memory),
                             kLength, "um", from(0, 1),
                             "Sliding length over which the coefficient follows the slip speed; "
                             "above zero"))));
  Key file{.path = "contact.friction_file",
           .kind = Kind::text,
           .locate = at(&Scene::contact, &ContactSpec::friction_file),
           .description =
               "File of two columns, x and coefficient of friction, after a line such as "
               "`# x [m]  f [-]`; linear between the rows, constant beyond them"};
  file.takes_file = true;
  // A table of a later layer takes the place of an earlier coefficient.
  keys.push_back(with({"table"}, required(instead_of("contact.friction", std::move(file)))));
  keys.push_back(
      with({"table"}, quantity("contact.friction_start", at(&Scene::contact, &ContactSpec::friction_start),
                               kLength, "m", from(-1000, 1000), "x on the rail where the file's x is zero")));
}

void add_contact(Keys& keys) {
  add_friction(keys);
  keys.push_back(
      number("contact.penetration_ratio", at(&Scene::contact, &ContactSpec::penetration_ratio), above(0, 0.5),
             "Penetration divided by the Hertz approach: sets the penalty stiffness; absent: 10 E / element "
             "size, E the harmonic mean of wheel and rail, but at most 2 %"));
  keys.push_back(quantity("contact.depth_room", at(&Scene::contact, &ContactSpec::depth_room), kLength, "mm",
                          from(0, 0.01),
                          "Corrugation depth that the searched surface has room for: the deepest that a fork "
                          "of the run may have; absent: the scene's own, with [forks] at least 0.2 mm"));
  keys.push_back(choice("contact.surface", at(&Scene::contact, &ContactSpec::surface), {"exact", "facets"},
                        "Surface that the gap is measured to: the profile's curves or the element faces"));
  keys.push_back(number("contact.points", at(&Scene::contact, &ContactSpec::points), {1, 4},
                        "Integration points per face and direction", Kind::integer));
}

void add_motion(Keys& keys) {
  const auto rolling = [](Key key) { return with_table("wheel", std::move(key)); };
  keys.push_back(rolling(quantity("motion.speed", at(&Scene::motion, &MotionSpec::speed), kSpeed, "km/h",
                                  from(0, 300), "Forward speed at the start")));
  keys.push_back(quantity("motion.duration", at(&Scene::motion, &MotionSpec::duration), kTime, "s",
                          above(0, 100), "Simulated time"));
  keys.push_back(rolling(instead_of("motion.traction.torque",
                                    number("motion.traction.mu", at(&Scene::motion, &MotionSpec::traction_mu),
                                           {-2, 2}, "Target traction coefficient; negative brakes"))));
  keys.push_back(rolling(
      instead_of("motion.traction.mu",
                 quantity("motion.traction.torque", at(&Scene::motion, &MotionSpec::traction_torque), kTorque,
                          "kN m", {-1e6, 1e6}, "Torque on the axle after the ramp; negative brakes"))));
  keys.push_back(rolling(quantity("motion.traction.ramp", at(&Scene::motion, &MotionSpec::ramp), kTime, "ms",
                                  from(0, 100), "Time T1 in which the torque grows from zero")));
  keys.push_back(
      rolling(choice("motion.traction.shape", at(&Scene::motion, &MotionSpec::ramp_shape),
                     {"linear", "smooth"}, "How it grows and reverses: evenly, or as half a cosine")));
  keys.push_back(rolling(
      number("motion.traction.reversals", at(&Scene::motion, &MotionSpec::reversals), {0, 1000},
             "How often the full torque then turns into its opposite, each time in 2 T1", Kind::integer)));
  keys.push_back(rolling(flag("motion.spin_in_preload", at(&Scene::motion, &MotionSpec::spin_in_preload),
                              "Whether the static state carries the spin's body force")));
  keys.push_back(
      rolling(number("motion.creepage", at(&Scene::motion, &MotionSpec::creepage), {-2, 2, false, true},
                     "Creepage at the start, relative to free rolling; -2: a locked wheel")));
  keys.push_back(rolling(
      choice("motion.start", at(&Scene::motion, &MotionSpec::start), {"auto", "rigid", "moving", "rolling"},
             "Motion at t = 0: of rigid bodies, with the static deflection moving along, or that of a "
             "wheel that has been rolling over the fastenings; auto: rolling on [fastenings], else moving")));
  keys.push_back(number("motion.step_safety", at(&Scene::motion, &MotionSpec::step_safety), above(0, 1),
                        "Time step divided by the stable step"));
}

void add_corrugation(Keys& keys) {
  const auto sine = [](Key key) { return only_with("corrugation.kind", "sine", std::move(key)); };
  const auto length = [](const char* name, auto member, const char* unit, Bounds range,
                         const char* description) {
    return quantity(name, at(&Scene::corrugation, member), kLength, unit, range, description);
  };
  const auto random = [](Key key) { return only_with("corrugation.kind", "random", std::move(key)); };
  keys.push_back(choice("corrugation.kind", at(&Scene::corrugation, &CorrugationSpec::kind),
                        {"sine", "table", "random"}, "Sine waves, measured depths, or random roughness"));
  keys.push_back(sine(
      length("corrugation.wavelength", &CorrugationSpec::wavelength, "mm", above(0, 10), "Wavelength L")));
  keys.push_back(sine(length("corrugation.depth", &CorrugationSpec::depth, "mm", above(0, 0.01),
                             "Depth d_m from crest to trough")));
  keys.push_back(length("corrugation.width", &CorrugationSpec::width, "mm", above(0, 0.1),
                        "Half width W across the rail, where the depth has fallen to zero"));
  keys.push_back(length("corrugation.start", &CorrugationSpec::start, "m", from(-1000, 1000),
                        "x_s where it starts, a sine at a crest"));
  keys.push_back(
      only_with("corrugation.kind", std::vector<std::string>{"sine", "random"},
                length("corrugation.length", &CorrugationSpec::length, "m", above(0, 1000),
                       "Length that the whole waves must fit into; of the roughness, which fades over half "
                       "the longest wave at either end")));
  keys.push_back(random(length("corrugation.rms", &CorrugationSpec::rms, "um", above(0, 0.01),
                               "Root mean square of the roughness")));
  keys.push_back(random(length("corrugation.shortest", &CorrugationSpec::shortest, "mm", above(0, 10),
                               "Shortest wave of the roughness")));
  keys.push_back(random(length("corrugation.longest", &CorrugationSpec::longest, "mm", above(0, 10),
                               "Longest wave of the roughness")));
  keys.push_back(random(number("corrugation.seed", at(&Scene::corrugation, &CorrugationSpec::seed), {0, 2e9},
                               "Draws the phases of the roughness' waves", Kind::integer)));
  keys.push_back(length("corrugation.centre", &CorrugationSpec::centre, "mm", {-0.1, 0.1},
                        "y of the deepest line; absent: at the preload's largest pressure"));
  keys.push_back(choice("corrugation.apply", at(&Scene::corrugation, &CorrugationSpec::apply),
                        {"nodes", "gap"}, "By moved nodes, or added to the contact gap"));
  Key file{.path = "corrugation.file",
           .kind = Kind::text,
           .locate = at(&Scene::corrugation, &CorrugationSpec::file),
           .description =
               "File of two columns, x from the start and depth positive downwards, after a line such as "
               "`# x [m]  d [mm]`"};
  file.takes_file = true;
  keys.push_back(only_with("corrugation.kind", "table", required(std::move(file))));
}

void add_wear(Keys& keys) {
  keys.push_back(quantity("wear.coefficient", at(&Scene::wear, &WearSpec::coefficient), kWear, "ug/N/m",
                          above(0, 1e-3),
                          "Mass worn off per frictional work: 2.5e-9 kg/(N m) is usual for mild wear, after "
                          "Krause and Poll (1984)"));
  keys.push_back(number("wear.change", at(&Scene::wear, &WearSpec::change), above(0, 1),
                        "Change of the depth by one simulated passage over the depth, at the most: how many "
                        "passages it stands for"));
  keys.push_back(quantity("wear.shortest", at(&Scene::wear, &WearSpec::shortest), kLength, "mm", above(0, 10),
                          "Shortest wave that wear changes; what is shorter is taken for the mesh's noise"));
  keys.push_back(quantity("wear.longest", at(&Scene::wear, &WearSpec::longest), kLength, "mm", above(0, 10),
                          "Longest wave that wear changes"));
}

void add_impacts_and_output(Keys& keys) {
  keys.push_back(required(quantity("pulse.velocity", at(&Scene::pulse, &PulseSpec::velocity), kSpeed, "m/s",
                                   {-1000, 1000}, "Initial velocity along x of the bar's left end")));
  keys.push_back(required(quantity("pulse.length", at(&Scene::pulse, &PulseSpec::length), kLength, "m",
                                   above(0, 1000), "Length of the part that has it")));
  keys.push_back(quantity("hammer.position", at(&Scene::hammer, &HammerSpec::position), kLength, "m",
                          from(-1000, 1000), "x of the struck point on the rail's crown"));
  keys.push_back(required(quantity("hammer.force", at(&Scene::hammer, &HammerSpec::force), kForce, "kN",
                                   {-1e6, 1e6}, "Largest force of the blow, downwards")));
  keys.push_back(required(quantity("hammer.duration", at(&Scene::hammer, &HammerSpec::duration), kTime, "ms",
                                   above(0, 1), "Duration of the blow, a half sine from t = 0 on")));
  keys.push_back(quantity("forks.at", at(&Scene::forks, &ForkSpec::at), kTime, "ms", from(0, 100),
                          "Time of the state; absent: 20 mm before the patch meets the corrugation, or the "
                          "solution zone of a smooth rail"));
  keys.push_back(quantity("output.history_interval", at(&Scene::output, &OutputSpec::history_interval), kTime,
                          "s", above(0, 100), "Simulated time between samples of the histories"));
  keys.push_back(quantity("output.progress_interval", at(&Scene::output, &OutputSpec::progress_interval),
                          kTime, "s", above(0, 1e5), "Wall-clock time between progress lines"));
  keys.push_back(quantity("output.checkpoint_interval", at(&Scene::output, &OutputSpec::checkpoint_interval),
                          kTime, "min", above(0, 1e7), "Wall-clock time between checkpoints"));
  keys.push_back(
      number("output.frames", at(&Scene::output, &OutputSpec::frames), {0, 1e6},
             "Frames for ParaView, evenly over the duration from the first step to the last; 0: none",
             Kind::integer));
  keys.push_back(choice("output.frame_cells", at(&Scene::output, &OutputSpec::frame_cells),
                        {"faces", "elements"},
                        "What frames show: the outer faces of the bodies, or all elements"));
  keys.push_back(quantity("output.disk_limit", at(&Scene::output, &OutputSpec::disk_limit), kData, "GB",
                          above(0, 1e15), "What the run's folder may take; more than that ends the run"));
  keys.push_back(number("stop.steps", at(&Scene::stop, &StopSpec::steps), {0, 2e9},
                        "Steps after which the run ends; 0: any number", Kind::integer));
  keys.push_back(quantity("stop.wall_time", at(&Scene::stop, &StopSpec::wall_time), kTime, "h", above(0, 1e8),
                          "Time of the process after which it leaves a checkpoint and ends"));
  keys.push_back(
      with_table("contact", quantity("stop.penetration", at(&Scene::stop, &StopSpec::penetration), kLength,
                                     "um", above(0, 1), "Penetration that ends the run")));
}

Key presence_of(const SceneTable& table) {
  return {.path = table.name + ".present",
          .kind = Kind::directive,
          .locate = {},
          .description = "false leaves the table out"};
}

Keys make_keys(const std::vector<std::string>& materials) {
  Keys keys;
  add_general(keys);
  for (const std::string& name : materials) add_material(keys, name);
  add_wheel(keys);
  add_rail(keys);
  add_fastenings(keys);
  add_slab(keys);
  add_vehicle_and_load(keys);
  add_contact(keys);
  add_motion(keys);
  add_corrugation(keys);
  add_wear(keys);
  add_impacts_and_output(keys);
  for (const SceneTable& table : scene_tables(materials))
    if (table.removable()) keys.push_back(presence_of(table));
  return keys;
}

template <class Spec>
SceneTable component(const std::string& name, std::optional<Spec> Scene::*spec,
                     const std::string& description) {
  return {.name = name,
          .description = description,
          .create = [spec](Scene& scene) { (scene.*spec).emplace(); },
          .remove = [spec](Scene& scene) { (scene.*spec).reset(); },
          .exists = [spec](const Scene& scene) { return (scene.*spec).has_value(); }};
}

SceneTable material_table(const std::string& name) {
  return {.name = std::string(kMaterialTables) + name,
          .description =
              "A material of that name; parts name theirs: `wheel.material`, `rail.material`, "
              "`slab.material`. The name is free and consists of letters, digits, _ and -.",
          .create = [name](Scene& scene) { scene.materials[name] = {.name = name}; },
          .remove = [name](Scene& scene) { scene.materials.erase(name); },
          .exists = [name](const Scene& scene) { return scene.materials.contains(name); }};
}

SceneTable always(std::string name, std::string description) {
  return {.name = std::move(name), .description = std::move(description), .exists = [](const Scene&) {
            return true;
          }};
}

std::vector<SceneTable> make_tables(const std::vector<std::string>& materials) {
  std::vector<SceneTable> tables = {
      always("scene", "What the scene is called, what it is based on, how fine it is."),
      always("solution_zone", "The part of the rail that is divided finely and watched closely.")};
  for (const std::string& name : materials) tables.push_back(material_table(name));
  const std::vector<SceneTable> others = {
      component("wheel", &Scene::wheel, "The flexible wheelset, or a simpler body that rolls."),
      component("rail", &Scene::rail, "The flexible rail, or a block or bar in its place."),
      component("fastenings", &Scene::fastenings,
                "Groups of spring-dampers under the rail; they stand on the slab, or on rigid ground where "
                "there is "
                "none."),
      component("slab", &Scene::slab_track, "Slabs with filled gaps on mortar, moving vertically."),
      component("vehicle", &Scene::vehicle, "Masses and primary suspension on the wheelset."),
      component("load", &Scene::load, "A force on the wheel in place of a vehicle."),
      component("contact", &Scene::contact, "Contact and friction between wheel and rail."),
      component("motion", &Scene::motion,
                "The transient run; a scene without it ends with its static state."),
      component("corrugation", &Scene::corrugation,
                "Periodic or measured depth of the rail's running surface."),
      component("wear", &Scene::wear,
                "How the frictional work of passages changes the profile: of `tread develop` alone. "
                "[develop.md](develop.md)"),
      component("pulse", &Scene::pulse, "An initial velocity at one end of a bar: a rail without a wheel."),
      component("hammer", &Scene::hammer,
                "A blow on the rail head; the histories hold its force and the struck point's "
                "displacement."),
      component("forks", &Scene::forks,
                "A state that the run keeps for good, from which runs over other corrugations begin. "
                "[reliability.md](reliability.md)"),
      always("output", "How often results are sampled, progress shown, checkpoints and frames written."),
      always("stop", "What ends a run before its duration. [reliability.md](reliability.md)"),
  };
  tables.insert(tables.end(), others.begin(), others.end());
  return tables;
}

/// The material that the path, "material.steel" or "material.steel.density", belongs to; "" for other paths
/// and for names that are not letters, digits, _ and -.
std::string_view material_of(std::string_view path) {
  if (!path.starts_with(kMaterialTables)) return "";
  const std::string_view rest = path.substr(kMaterialTables.size());
  const std::string_view name = rest.substr(0, rest.find('.'));
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return std::all_of(name.begin(), name.end(), allowed) ? name : "";
}

/// The keys of the material of that name, that of its presence included; none for "".
Keys material_keys(std::string_view name) {
  Keys keys;
  if (name.empty()) return keys;
  add_material(keys, std::string(name));
  keys.push_back(presence_of(material_table(std::string(name))));
  return keys;
}

bool starts_with_table(std::string_view path, std::string_view table) {
  return path == table || (path.starts_with(table) && path[table.size()] == '.');
}

std::string_view leaf_of(std::string_view path) {
  return path.substr(path.rfind('.') + 1);
}

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

/// Edits up to which a word still counts as a misspelling.
std::size_t tolerance(std::string_view word) {
  return std::clamp<std::size_t>(word.size() / 3, 1, 3);
}

}  // namespace

bool Bounds::contains(double value) const {
  return (open_low ? value > low : value >= low) && (open_high ? value < high : value <= high);
}

const std::vector<std::string>& usual_materials() {
  static const std::vector<std::string> names = {"steel", "slab", "gap_filler", "mortar"};
  return names;
}

std::vector<Key> scene_keys(const std::vector<std::string>& materials) {
  return make_keys(materials);
}

std::vector<Key> scene_keys(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& [name, material] : scene.materials) names.push_back(name);
  return make_keys(names);
}

const std::vector<Key>& scene_keys() {
  static const std::vector<Key> keys = make_keys(usual_materials());
  return keys;
}

std::vector<SceneTable> scene_tables(const std::vector<std::string>& materials) {
  return make_tables(materials);
}

const std::vector<SceneTable>& scene_tables() {
  static const std::vector<SceneTable> tables = make_tables(usual_materials());
  return tables;
}

std::optional<Key> find_key(std::string_view path) {
  const std::string_view material = material_of(path);
  const Keys own = material_keys(material);
  const Keys& keys = material.empty() ? scene_keys() : own;
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return key.path == path; });
  return found == keys.end() ? std::nullopt : std::optional(*found);
}

std::optional<SceneTable> table_of(std::string_view path) {
  const std::string_view material = material_of(path);
  if (!material.empty()) return material_table(std::string(material));
  const auto holds = [&](const SceneTable& table) { return starts_with_table(path, table.name); };
  const auto found = std::find_if(scene_tables().begin(), scene_tables().end(), holds);
  return found == scene_tables().end() ? std::nullopt : std::optional(*found);
}

bool is_table(std::string_view path) {
  const std::string_view material = material_of(path);
  if (!material.empty()) return path.size() == kMaterialTables.size() + material.size();
  const auto below = [&](const Key& key) { return key.path != path && starts_with_table(key.path, path); };
  return std::any_of(scene_keys().begin(), scene_keys().end(), below);
}

std::vector<MaterialUse> material_uses(const Scene& scene) {
  Scene copy = scene;
  std::vector<MaterialUse> uses;
  for (const Key& key : scene_keys()) {
    if (!key.names_material) continue;
    const Field field = key.locate(copy);
    if (const auto* name = std::get_if<std::string*>(&field))
      uses.push_back({key.path, key.path.substr(0, key.path.find('.')), **name});
  }
  return uses;
}

std::string usual_user(std::string_view material) {
  Scene everything;
  for (const SceneTable& table : scene_tables())
    if (table.removable()) table.create(everything);
  for (const MaterialUse& use : material_uses(everything))
    if (use.name == material) return use.part;
  return "";
}

std::string Condition::alternatives() const {
  std::string text;
  for (const std::string& value : values) text += fmt::format("{}\"{}\"", text.empty() ? "" : " or ", value);
  return text;
}

bool applies(const Key& key, const Scene& scene) {
  if (key.only_with.key.empty()) return true;
  if (!table_of(key.only_with.key)->exists(scene)) return false;
  const std::vector<std::string>& values = key.only_with.values;
  if (values.empty()) return true;
  Scene copy = scene;
  const Field field = find_key(key.only_with.key)->locate(copy);
  return std::find(values.begin(), values.end(), *std::get<std::string*>(field)) != values.end();
}

std::string similar_text(std::string_view text, const std::vector<std::string>& options) {
  constexpr std::size_t kLongestWord = 100;
  if (text.size() > kLongestWord) return "";
  std::string best;
  std::size_t least = tolerance(leaf_of(text)) + 1;
  for (const std::string& option : options) {
    const std::size_t distance = edit_distance(text, option);
    if (distance >= least) continue;
    least = distance;
    best = option;
  }
  return best;
}

std::string similar_path(std::string_view unknown) {
  std::vector<std::string> paths;
  for (const Key& key : scene_keys()) paths.push_back(key.path);
  for (const SceneTable& table : scene_tables()) paths.push_back(table.name);
  const std::string_view material = material_of(unknown);
  for (const Key& key : material_keys(material)) paths.push_back(key.path);
  std::string near = similar_text(unknown, paths);
  if (!near.empty()) return near;
  const auto same_leaf = [&](const std::string& path) { return leaf_of(path) == leaf_of(unknown); };
  const auto elsewhere = std::find_if(paths.begin(), paths.end(), same_leaf);
  return elsewhere == paths.end() ? "" : *elsewhere;
}

std::string names_in(std::string_view table) {
  std::vector<std::string> names;
  const std::string_view material = material_of(table);
  const Keys own = material_keys(material);
  for (const Key& key : material.empty() ? scene_keys() : own) {
    if (!table.empty() && (key.path == table || !starts_with_table(key.path, table))) continue;
    const std::size_t start = table.empty() ? 0 : table.size() + 1;
    const std::string name = key.path.substr(start, key.path.find('.', start) - start);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::optional<double> number_at(const Field& field) {
  if (const auto* value = std::get_if<double*>(&field)) return **value;
  if (const auto* value = std::get_if<int*>(&field)) return **value;
  if (const auto* value = std::get_if<std::optional<double>*>(&field)) return **value;
  if (const auto* value = std::get_if<DampingField>(&field)) {
    return std::max(*value->high_frequency_fraction, *value->rayleigh_beta);
  }
  return std::nullopt;
}

std::string describe_range(const Key& key) {
  const auto text = [&](double value) {
    return key.unit.empty() ? fmt::format("{:.6g}", value) : format_quantity(value, key.unit);
  };
  const Bounds& range = key.range;
  std::string low, high;
  if (std::isfinite(range.low)) low = (range.open_low ? "above " : "at least ") + text(range.low);
  if (std::isfinite(range.high)) high = (range.open_high ? "below " : "at most ") + text(range.high);
  return low + (low.empty() || high.empty() ? "" : " and ") + high;
}

}  // namespace tread
