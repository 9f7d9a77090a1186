// Every key of a scene, changed in turn: what changes in the bits is what the key states (Effects), no less
// and no more.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/built_in_profiles.hpp"
#include "core/math/hash.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/results/disk_use.hpp"
#include "drivers/results/inventory.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/scene/schema.hpp"
#include "tests/bar_scene.hpp"
#include "tests/body_files.hpp"
#include "tests/state_copies.hpp"

namespace tread {
namespace {

using Overrides = std::vector<std::string>;

constexpr const char* kWheelset =
    "[scene]\ntitle = \"wheelset\"\nbased_on = \"highspeed-slab-2014\"\nelement_size = \"11 mm\"\n";

/// A short rail under a wheelset, and more.
Overrides on_short_rail(const Overrides& more = {}) {
  Overrides all = {"rail.length=2 m",         "rail.origin=1 m",         "fastenings.count=3",
                   "fastenings.first=0.35 m", "solution_zone.start=0 m", "solution_zone.length=10 mm",
                   "motion.duration=0.1 ms",  "motion.speed=100 km/h"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// A tyre that rolls over a bar on two fastenings and a slab: every part but a half wheelset, in seconds.
constexpr const char* kTrack = R"(
[scene]
title = "tyre on a short track"
element_size = "14 mm"
[solution_zone]
start = "0 mm"
length = "200 mm"
[material.steel]
youngs_modulus = "205.9 GPa"
poissons_ratio = 0.3
density = "7790 kg/m3"
damping = { kind = "rayleigh_beta", value = "1e-8 s" }
[material.hard]
youngs_modulus = "300 GPa"
poissons_ratio = 0.25
density = "9000 kg/m3"
[material.slab]
youngs_modulus = "34.5 GPa"
poissons_ratio = 0.2
density = "2400 kg/m3"
[material.gap_filler]
youngs_modulus = "0.1 GPa"
poissons_ratio = 0.3
density = "1200 kg/m3"
[wheel]
shape = "tyre"
profile = "arc"
lateral_offset = "0 mm"
[rail]
profile = "box"
inclination = 0
length = "1.2 m"
origin = "0.6 m"
[fastenings]
count = 2
spacing = "0.6 m"
first = "0.3 m"
pad_length = "60 mm"
pad_width = "40 mm"
damping = "20 kN s/m"
columns = 2
rows = 2
[slab]
pitch = "0.6 m"
gap = "50 mm"
width = "0.4 m"
mortar_material = "hard"
[load]
wheel_load = "40 kN"
[contact]
penetration_ratio = 0.05
[motion]
speed = "40 km/h"
duration = "1 ms"
creepage = 0.01
start = "rolling"
[motion.traction]
mu = 0.1
ramp = "5 us"
reversals = 1
[wear]
[forks]
at = "0.1 ms"
[output]
frames = 4
)";

struct BaseScene {
  const char* text;
  Overrides overrides;
};

/// Scenes that have the keys which the track lacks.
const BaseScene& base_scene(const std::string& name) {
  static const Overrides kSines = {"corrugation.apply=gap", "corrugation.start=0 mm",
                                   "corrugation.length=170 mm"};
  static const std::map<std::string, BaseScene> kScenes = {
      {"track", {kTrack, kSines}},
      {"sprung",
       {kTrack,
        {"load.present=false", "vehicle.sprung_mass=500 kg", "vehicle.unsprung_mass=3500 kg",
         "fastenings.spacing=0.3 m", "fastenings.first=0.45 m", "fastenings.damping=200 kN s/m"}}},
      {"elastic track",
       {kTrack,
        {"fastenings.along=elastic", "fastenings.along_stiffness=20 MN/m",
         "fastenings.along_damping=200 kN s/m", "fastenings.across=elastic",
         "fastenings.across_stiffness=20 MN/m", "fastenings.across_damping=200 kN s/m"}}},
      {"guided", {kTrack, {"wear.present=false", "wheel.bore=guided", "motion.start=moving"}}},
      {"yielding",
       {kTrack,
        {"material.steel.law=j2", "material.steel.yield_stress=50 MPa",
         "material.steel.isotropic_hardening=1 GPa", "motion.start=moving"}}},
      {"random",
       {kTrack,
        {"corrugation.kind=random", "corrugation.apply=gap", "corrugation.start=0 mm",
         "corrugation.length=170 mm", "corrugation.shortest=40 mm", "corrugation.longest=80 mm"}}},
      {"measured",
       {kTrack,
        {"corrugation.kind=table", "corrugation.apply=gap", "corrugation.start=0 mm",
         "corrugation.file=depth.txt"}}},
      {"falling", {kTrack, {"contact.friction_law=falling", "contact.friction_memory=100 um"}}},
      {"spotted", {kTrack, {"contact.friction_law=table", "contact.friction_file=friction.txt"}}},
      {"ballasted",
       {kTrack,
        {"slab.present=false", "material.slab.present=false", "material.gap_filler.present=false",
         "sleepers.material=hard"}}},
      {"odd support",
       {kTrack,
        {"slab.present=false", "material.slab.present=false", "material.gap_filler.present=false",
         "sleepers.material=hard", "support.odd.fastening=2", "support.odd.stiffness=0.8"}}},
      {"dipped",
       {kTrack,
        {"surface.shape.kind=dip", "surface.shape.at=5 mm", "surface.shape.depth=0.05 mm",
         "surface.shape.length=100 mm"}}},
      {"dented",
       {kTrack,
        {"surface.shape.kind=dent", "surface.shape.at=5 mm", "surface.shape.depth=0.05 mm",
         "surface.shape.length=120 mm", "surface.shape.width=100 mm"}}},
      {"wavy",
       {kTrack,
        {"surface.shape.kind=waves", "surface.shape.at=-40 mm", "surface.shape.depth=0.05 mm",
         "surface.shape.length=0.3 m", "surface.shape.wavelength=0.1 m"}}},
      {"polygonal",
       {kTrack,
        {"surface.shape.kind=polygon", "surface.shape.at=5 mm", "surface.shape.depth=0.05 mm",
         "surface.shape.order=25"}}},
      {"measured depths",
       {kTrack, {"surface.shape.kind=profile", "surface.shape.at=-20 mm", "surface.shape.file=depth.txt"}}},
      {"probed", {kTrack, {"probe.midspan.quantity=motion"}}},
      {"zoned", {kTrack, {"zone.weld.start=-0.1 m"}}},
      {"long way",
       {kTrack, {"scene.element_size=2.2 mm", "solution_zone.length=50 mm", "motion.duration=40 ms"}}},
      {"wheelset", {kWheelset, on_short_rail()}},
      {"webbed",
       {kWheelset, on_short_rail({"body.web.replaces=disc", "body.web.file=disc.inp", "body.web.unit=mm",
                                  "body.web.tread=tread", "body.web.axle=axle"})}},
      {"footed",
       {kWheelset, on_short_rail({"body.web.replaces=rail", "body.web.file=base.inp", "body.web.unit=mm",
                                  "body.web.head=head", "body.web.foot=foot"})}},
      {"worn",
       {"[scene]\ntitle = \"worn\"\nbased_on = \"highspeed-slab-2014\"\nelement_size = \"11 mm\"\n",
        {"rail.length=2 m", "rail.origin=1 m", "fastenings.count=3", "fastenings.first=0.35 m",
         "solution_zone.start=0 m", "solution_zone.length=10 mm", "motion.duration=0.1 ms",
         "wheel.profile=tread.txt", "rail.profile=head.txt"}}},
      {"struck rail",
       {"[scene]\ntitle = \"struck\"\nbased_on = \"highspeed-slab-2014\"\nelement_size = \"11 mm\"\n"
        "[hammer]\nposition = \"0 m\"\nforce = \"1 kN\"\nduration = \"20 us\"\n"
        "[wheel]\npresent = false\n[vehicle]\npresent = false\n[contact]\npresent = false\n"
        "[slab]\npresent = false\n[material.hard]\nyoungs_modulus = \"300 GPa\"\npoissons_ratio = 0.25\n"
        "density = \"9000 kg/m3\"\n",
        {"rail.head_material=hard", "rail.length=2 m", "rail.origin=1 m", "fastenings.count=3",
         "fastenings.first=0.35 m", "motion.duration=0.1 ms"}}},
      {"bar", {samples::kBar, {}}},
      {"hammer",
       {samples::kBar,
        {"pulse.present=false", "rail.support=rigid", "hammer.position=0.3 m", "hammer.force=1 kN",
         "hammer.duration=20 us"}}},
  };
  return kScenes.at(name);
}

/// Columns of a built-in profile with some waviness; a rail is worn on one side.
std::string worn_columns(const PlaneCurve& curve, double from, double to) {
  std::string text = "# y [mm]  z [mm]\n";
  for (double y = from; y <= to; y += 0.5) {
    const double wear = 0.1 * std::exp(-std::pow((y + 10) / 8, 2)) + 0.01 * std::sin(y * y);
    text += fmt::format("{:g} {:.6f}\n", y, 1e3 * curve.at(curve.at_x(1e-3 * y)).position.y - wear);
  }
  return text;
}

const std::map<std::string, std::string>& body_files();

Scene resolve(const std::string& name, const Overrides& more) {
  const BaseScene& base = base_scene(name);
  Overrides overrides = base.overrides;
  overrides.insert(overrides.end(), more.begin(), more.end());
  SceneSource source{name, base.text, "/nowhere"};
  std::map<std::string, std::string> files = {
      {"/nowhere/depth.txt", "# x [mm]  d [mm]\n0 0\n50 0.02\n100 0\n"},
      {"/nowhere/other_depth.txt", "# x [mm]  d [mm]\n0 0\n50 0.03\n100 0\n"},
      {"/nowhere/supports.txt", "# fastening [-]  shift [mm]  stiffness [-]\n2 20 0.7\n"},
      {"/nowhere/friction.txt", "# x [mm]  f [-]\n-20 0.1\n20 0.4\n"},
      {"/nowhere/other_friction.txt", "# x [mm]  f [-]\n-20 0.1\n20 0.3\n"},
      {"/nowhere/web.txt",
       "# y [mm]  r [mm]\n-40 145\n-30 165\n-30 340\n-40 365\n35 365\n25 340\n25 165\n35 145\n"},
      {"/nowhere/tread.txt", worn_columns(built_in_wheel("LMA").surface, -69, 65)},
      {"/nowhere/head.txt", worn_columns(built_in_rail("CN60").running, -35, 35)}};
  const auto of_body = [](const std::string& text) { return text.starts_with("body."); };
  if (std::any_of(overrides.begin(), overrides.end(), of_body))
    files.insert(body_files().begin(), body_files().end());
  for (const auto& [path, text] : files) source.files[path] = std::make_shared<const std::string>(text);
  return resolve_scene(source, overrides).scene;
}

/// The wheelset's disc and the rail's base as other programs would write them.
const std::map<std::string, std::string>& body_files() {
  static const std::map<std::string, std::string> kFiles = [] {
    constexpr double kMm = 1e-3, kCm = 1e-2;
    const Model model(resolve("wheelset", {}));
    const SweptBlock& disc = model.mesh.blocks[static_cast<std::size_t>(model.index.disc)];
    const SweptBlock& base = model.mesh.blocks[static_cast<std::size_t>(model.index.rail_base)];
    const std::vector<std::pair<std::string, std::string>> ends = {{"tie_outer", "tread"},
                                                                   {"tie_inner", "axle"}};
    return std::map<std::string, std::string>{
        {"/nowhere/disc.inp", samples::body_file(disc, ends, kMm, 0)},
        {"/nowhere/other_disc.inp", samples::body_file(disc, ends, kMm, 1e-4)},
        {"/nowhere/other_disc_cm.inp", samples::body_file(disc, ends, kCm, 1e-4)},
        {"/nowhere/base.inp", samples::body_file(base, {{"tie", "head"}, {"foot", "foot"}}, kMm, 0)},
        {"/nowhere/other_base.inp",
         samples::body_file(base, {{"tie", "head"}, {"foot", "foot"}}, kMm, 1e-4)}};
  }();
  return kFiles;
}

/// Hashes of what a scene leads to on a given mesh.
struct Bits {
  std::uint64_t cost = 0;
  std::uint64_t preload = 0;
  std::uint64_t surface = 0;
  std::uint64_t motion = 0;
};

void add(Hash& hash, const Vec3& v) {
  for (const double value : {v.x, v.y, v.z}) hash.add(value);
}

std::uint64_t mesh_bits(const Model& model) {
  Hash hash;
  for (const SweptBlock& block : model.mesh.blocks) {
    for (int station = 0; station < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes(); ++node) {
        add(hash, position(block, node, station));
        hash.add(static_cast<std::uint64_t>(block.base + block.slot(node, station)));
      }
    for (const Tile& tile : block.tiles)
      hash.add(static_cast<std::uint64_t>(
          block.classes[static_cast<std::size_t>(tile.pitch_class)].material_offset));
  }
  for (const HexBody& body : model.mesh.bodies) {
    for (const Vec3& at : body.mesh.nodes) add(hash, at);
    for (const HexCorners& corners : body.mesh.elements) hash.add(std::as_bytes(std::span(corners)));
  }
  if (model.ties)
    for (const TiedSlot& tied : model.ties->tied_slots()) {
      hash.add(static_cast<std::uint64_t>(tied.secondary));
      hash.add(static_cast<std::uint64_t>(tied.primary));
    }
  return hash.value();
}

/// Memory, step and disk over the same time.
std::uint64_t cost_bits(const Model& model, double dt) {
  constexpr double kSteps = 1000;
  Hash hash;
  hash.add(static_cast<std::uint64_t>(model.elements()));
  hash.add(static_cast<std::uint64_t>(peak_bytes(model, 0)));
  hash.add(dt);
  hash.add(model.contact ? model.contact->reach() : 0.0);
  const DiskUse disk = disk_use(model, model.scene.motion->duration / kSteps);
  for (const std::int64_t bytes : {disk.rows, disk.results, disk.frames, disk.checkpoints})
    hash.add(static_cast<std::uint64_t>(bytes));
  return hash.value();
}

std::uint64_t preload_bits(Preload& preload) {
  StateList list;
  list.add("displacement", std::span<double>(preload.displacement));
  list.add("wheel", preload.wheel);
  if (preload.run_in) list.add_part("run_in", *preload.run_in);
  Hash hash;
  for (const StateList::Field& field : list.fields()) {
    const std::string bytes = samples::bytes(field);
    hash.add(std::as_bytes(std::span(bytes)));
  }
  return hash.value();
}

std::uint64_t surface_bits(Model& model) {
  if (!model.scene.corrugation) return 0;
  model.apply_corrugation(model.scene.corrugation->centre.value_or(0));
  Hash hash;
  for (const SweptBlock& block : model.mesh.blocks)
    for (const auto& [slot, shift] : block.node_shift) add(hash, shift);
  for (double x = -0.2; x < 0.3; x += 0.0037)
    for (const double y : {-0.01, 0.0, 0.013}) hash.add(model.contact->corrugation().depth(x, y));
  return hash.value();
}

Bits bits_of(const Scene& scene) {
  constexpr int kSteps = 12;
  Model model(scene);
  Bits bits;
  const double dt = scene.motion->step_safety * step_limit(model).stable_step;
  bits.cost = cost_bits(model, dt);
  Preload preload = solve_preload(model, steady_motion(model), [](const std::string&) {});
  bits.preload = preload_bits(preload);
  {
    const auto corrugation =
        std::exchange(model.scene.corrugation, std::nullopt);  // moves on the smooth rail
    Simulation simulation(model, preload, dt);
    for (int step = 0; step < kSteps; ++step) simulation.step();
    bits.motion = simulation.state_hash();
    model.scene.corrugation = corrugation;
  }
  bits.surface = surface_bits(model);
  return bits;
}

/// Another value of a key in a scene; `with`: what the key needs besides, before and after; `then`: after
/// alone; `first`: before alone.
struct Change {
  std::string key;
  std::string value;
  std::string scene = "track";
  Overrides with = {};
  Overrides then = {};
  Overrides first = {};

  Overrides before() const {
    Overrides all = with;
    all.insert(all.end(), first.begin(), first.end());
    return all;
  }
};

const std::vector<Change>& changes() {
  static const Overrides kSliding = {"motion.speed=300 km/h", "motion.creepage=-1", "motion.start=moving"};
  static const std::vector<Change> kChanges = {
      {"scene.title", "another"},
      {"scene.quality", "standard", "wheelset"},
      {"scene.precision", "mixed"},
      {"scene.element_size", "13 mm"},
      {"scene.gravity", "40 m/s2", "sprung", {"motion.start=moving"}},
      {"scene.plane_strain", "true", "dipped", {"wheel.profile=cylinder"}},
      {"solution_zone.start", "-20 mm"},
      {"solution_zone.length", "220 mm"},
      {"solution_zone.margin", "60 mm", "long way"},
      {"zone.weld.start", "-0.13 m", "zoned"},
      {"zone.weld.length", "0.05 m", "zoned"},
      {"material.steel.youngs_modulus", "206 GPa"},
      {"material.steel.poissons_ratio", "0.29"},
      {"material.steel.density", "7800 kg/m3", "wheelset"},
      {"material.steel.law", "j2", "track", {"motion.start=moving"}, {"material.steel.yield_stress=100 MPa"}},
      {"material.steel.yield_stress", "60 MPa", "yielding"},
      {"material.steel.isotropic_hardening", "2 GPa", "yielding"},
      {"material.steel.kinematic_hardening", "2 GPa", "yielding"},
      {"material.steel.damping", "{ kind = \"rayleigh_beta\", value = \"2e-8 s\" }"},
      {"material.steel.damping_up_to", "20 kHz"},
      {"wheel.shape", "tyre", "wheelset", {}, {"wheel.profile=cylinder"}},
      {"wheel.material",
       "light",
       "wheelset",
       {"material.light.youngs_modulus=205.9 GPa", "material.light.poissons_ratio=0.3",
        "material.light.density=7600 kg/m3", "rail.material=light"}},
      {"wheel.profile", "cylinder"},
      {"wheel.profile_shift", "1 mm", "worn"},
      {"wheel.profile_smoothing", "0.02 mm", "worn"},
      {"wheel.diameter", "0.87 m"},
      {"wheel.lateral_offset", "1 mm"},
      {"wheel.mass", "600 kg", "wheelset"},
      {"wheel.web_thickness", "28 mm", "wheelset", {"wheel.brake_rings=true"}},
      {"wheel.brake_rings", "true", "wheelset"},
      {"wheel.web_offset", "10 mm", "wheelset"},
      {"wheel.web_wave", "8 mm", "wheelset"},
      {"wheel.web", "web.txt", "wheelset", {"wheel.mass=556.2 kg"}},
      {"wheel.axle_bore", "58 mm", "wheelset"},
      {"wheel.crown_radius", "0.31 m"},
      {"wheel.width", "62 mm"},
      {"wheel.thickness", "61 mm"},
      {"wheel.bore", "guided", "track", {"motion.start=moving"}},
      {"wheel.overhang", "0.2 m", "guided", {"scene.gravity=0 m/s2"}},
      {"rail.material", "hard", "track", {"motion.start=moving"}},
      {"rail.head_material", "steel", "struck rail", {}, {"material.hard.present=false"}},
      {"rail.profile", "CN60", "track", {"scene.element_size=11 mm"}},
      {"rail.section", "60E1", "worn"},
      {"rail.profile_mirrored", "true", "worn"},
      {"rail.profile_shift", "1 mm", "worn"},
      {"rail.profile_smoothing", "0.02 mm", "worn"},
      {"rail.inclination", "0.01", "wheelset"},
      {"rail.length", "1.3 m"},
      {"rail.origin", "0.62 m"},
      {"rail.support",
       "fastenings",
       "hammer",
       {"scene.gravity=9.81 m/s2"},
       {"fastenings.count=2", "fastenings.spacing=0.5 m", "fastenings.first=0.2 m",
        "fastenings.pad_width=10 mm"}},
      {"rail.width", "62 mm"},
      {"rail.height", "62 mm"},
      {"rail.crown_radius", "0.5 m"},
      {"fastenings.count", "1", "track", {"motion.start=moving"}},
      {"fastenings.spacing", "0.59 m", "track", {"motion.start=moving"}},
      {"fastenings.first", "0.28 m", "track", {"motion.start=moving"}},
      {"fastenings.stiffness", "23 MN/m"},
      {"fastenings.damping", "210 kN s/m", "track", {"fastenings.damping=200 kN s/m"}},
      {"fastenings.pad_length", "50 mm"},
      {"fastenings.pad_width", "30 mm"},
      {"fastenings.columns", "3"},
      {"fastenings.rows", "3"},
      {"fastenings.along", "elastic", "track", {}, {"fastenings.along_stiffness=20 MN/m"}},
      {"fastenings.along_stiffness", "30 MN/m", "elastic track"},
      {"fastenings.along_damping", "210 kN s/m", "elastic track"},
      {"fastenings.across", "elastic", "track", {}, {"fastenings.across_stiffness=20 MN/m"}},
      {"fastenings.across_stiffness", "30 MN/m", "elastic track"},
      {"fastenings.across_damping", "210 kN s/m", "elastic track"},
      {"fastenings.held_at", "springs"},
      {"fastenings.supports", "supports.txt", "ballasted"},
      {"slab.pitch", "0.5 m"},
      {"slab.gap", "80 mm"},
      {"slab.first_gap", "0.1 m"},
      {"slab.width", "0.42 m"},
      {"slab.thickness", "0.21 m"},
      {"slab.mortar_thickness", "35 mm"},
      {"slab.offset", "10 mm"},
      {"slab.material", "hard", "track", {}, {"material.slab.present=false"}},
      {"slab.gap_material", "slab", "track", {}, {"material.gap_filler.present=false"}},
      {"slab.mortar_material", "slab", "track", {}, {"material.hard.present=false"}},
      {"vehicle.sprung_mass", "12000 kg", "sprung", {"motion.start=moving"}},
      {"vehicle.unsprung_mass", "15000 kg", "sprung", {"motion.start=moving"}},
      {"vehicle.suspension_stiffness", "900 MN/m", "sprung"},
      {"vehicle.suspension_damping", "9000 kN s/m", "sprung"},
      {"vehicle.longitudinal", "free", "sprung"},
      {"load.wheel_load", "300 kN", "track", {"motion.start=moving"}},
      {"contact.friction_law", "falling", "track", kSliding, {"contact.friction_memory=1 um"}},
      {"contact.friction", "0.3", "track", kSliding},
      {"contact.friction_fast", "0.3", "falling", kSliding},
      {"contact.friction_speed", "0.5 m/s", "falling", kSliding},
      {"contact.friction_memory", "200 um", "falling", kSliding},
      {"contact.friction_file", "other_friction.txt", "spotted", kSliding},
      {"contact.friction_start", "5 mm", "spotted", kSliding},
      {"contact.penetration_ratio", "0.04"},
      {"contact.depth_room", "0.5 mm"},
      {"contact.surface", "facets"},
      {"contact.points", "2"},
      {"motion.speed", "41 km/h"},
      {"motion.duration", "1.0001 ms"},
      {"motion.run_up", "20 mm"},
      {"motion.traction.mu", "0.12"},
      {"motion.traction.torque", "2 kN m"},
      {"motion.traction.ramp", "6 us"},
      {"motion.traction.shape", "smooth"},
      {"motion.traction.reversals", "0"},
      {"motion.spin_in_preload", "false"},
      {"motion.creepage", "1"},
      {"motion.start", "moving"},
      {"motion.step_safety", "0.9"},
      {"corrugation.kind",
       "random",
       "track",
       {},
       {"corrugation.shortest=40 mm", "corrugation.longest=80 mm"}},
      {"corrugation.wavelength", "40 mm"},
      {"corrugation.depth", "0.1 mm"},
      {"corrugation.width", "20 mm"},
      {"corrugation.start", "20 mm"},
      {"corrugation.length", "100 mm"},
      {"corrugation.rms", "3 um", "random"},
      {"corrugation.shortest", "50 mm", "random"},
      {"corrugation.longest", "90 mm", "random"},
      {"corrugation.seed", "2", "random"},
      {"corrugation.centre", "1 mm"},
      {"corrugation.apply", "nodes"},
      {"corrugation.file", "other_depth.txt", "measured"},
      {"surface.shape.kind", "waves", "dipped", {}, {"surface.shape.wavelength=50 mm"}},
      {"surface.shape.on", "wheel", "dipped"},
      {"surface.shape.at", "8 mm", "dipped"},
      {"surface.shape.depth", "0.04 mm", "dipped"},
      {"surface.shape.length", "120 mm", "dipped"},
      {"surface.shape.width", "80 mm", "dented"},
      {"surface.shape.centre", "3 mm", "dented"},
      {"surface.shape.shape", "pointed", "dipped"},
      {"surface.shape.wavelength", "0.14 m", "wavy"},
      {"surface.shape.order", "22", "polygonal"},
      {"surface.shape.file", "other_depth.txt", "measured depths"},
      {"body.web.replaces",
       "rail",
       "wheelset",
       {"body.web.unit=mm"},
       {"body.web.file=base.inp", "body.web.head=head", "body.web.foot=foot"},
       {"body.web.replaces=disc", "body.web.file=disc.inp", "body.web.tread=tread", "body.web.axle=axle"}},
      {"body.web.file", "other_disc.inp", "webbed"},
      {"body.web.unit", "cm", "webbed", {}, {"body.web.file=other_disc_cm.inp"}},
      {"body.web.part", "holed", "webbed"},
      {"body.web.material",
       "light",
       "webbed",
       {"material.light.youngs_modulus=205.9 GPa", "material.light.poissons_ratio=0.3",
        "material.light.density=7600 kg/m3", "rail.material=light"}},
      {"body.web.origin_x", "0.01 mm", "webbed"},
      {"body.web.origin_y", "0.01 mm", "webbed"},
      {"body.web.origin_z", "0.01 mm", "webbed"},
      {"body.web.tread", "all of tread", "webbed", {}, {"body.web.file=other_disc.inp"}},
      {"body.web.axle", "most of axle", "webbed"},
      {"body.web.head", "all of head", "footed", {}, {"body.web.file=other_base.inp"}},
      {"body.web.foot", "most of foot", "footed"},
      {"wear.coefficient", "3e-9 kg/N/m"},
      {"wear.change", "0.1"},
      {"wear.shortest", "40 mm"},
      {"wear.longest", "120 mm"},
      {"wear.across", "true"},
      {"pulse.velocity", "2 m/s", "bar"},
      {"pulse.length", "0.2 m", "bar"},
      {"hammer.position", "0.4 m", "hammer"},
      {"hammer.force", "2 kN", "hammer"},
      {"hammer.duration", "30 us", "hammer"},
      {"forks.at", "0.2 ms"},
      {"sleepers.width", "0.24 m", "ballasted"},
      {"sleepers.length", "1.2 m", "ballasted"},
      {"sleepers.height", "0.22 m", "ballasted"},
      {"sleepers.offset", "-50 mm", "ballasted"},
      {"sleepers.material", "steel", "ballasted", {}, {"material.hard.present=false"}},
      {"sleepers.stiffness", "60 MN/m", "ballasted"},
      {"sleepers.damping", "600 MN s/m", "ballasted", {"sleepers.damping=500 MN s/m"}},
      {"support.odd.fastening", "1", "odd support"},
      {"support.odd.shift", "20 mm", "odd support"},
      {"support.odd.stiffness", "0.5", "odd support"},
      {"support.odd.damping", "1000", "odd support"},
      {"support.odd.bed", "0", "odd support"},
      {"support.odd.holds", "false", "odd support"},
      {"probe.midspan.body", "axle_box", "probed"},
      {"probe.midspan.x", "0.1 m", "probed"},
      {"probe.midspan.y", "3 mm", "probed"},
      {"probe.midspan.depth", "5 mm", "probed"},
      {"probe.midspan.quantity", "all", "probed"},
      {"output.history_interval", "20 us"},
      {"output.fastening_forces", "true"},
      {"output.stress_depth", "30 mm"},
      {"output.progress_interval", "3 s"},
      {"output.checkpoint_interval", "5 min"},
      {"output.frames", "5"},
      {"output.frame_cells", "elements"},
      {"output.disk_limit", "1 GB"},
      {"stop.steps", "100000"},
      {"stop.wall_time", "2 h"},
      {"stop.penetration", "900 um"},
  };
  return kChanges;
}

std::string table_in(const std::string& key) {
  return key.substr(0, key.find('.'));
}

/// Bits of each scene before the change, found once.
const Bits& bits_before(const Change& change) {
  static std::map<std::pair<std::string, Overrides>, Bits> known;
  const auto [found, is_new] = known.try_emplace({change.scene, change.before()});
  if (is_new) found->second = bits_of(resolve(change.scene, change.before()));
  return found->second;
}

bool same_run(const Scene& a, const Scene& b) {
  const Span one = run_span(a);
  const Span other = run_span(b);
  return one.first == other.first && one.last == other.last;
}

class KeysOf : public testing::TestWithParam<std::string> {};

TEST_P(KeysOf, AffectWhatTheyState) {
  for (const Change& change : changes()) {
    if (table_in(change.key) != GetParam()) continue;
    SCOPED_TRACE(change.key + " in " + change.scene);
    const Effects effects = find_key(change.key)->effects;
    Overrides with = change.with;
    with.insert(with.end(), change.then.begin(), change.then.end());
    with.push_back(change.key + "=" + change.value);
    const Scene scene = resolve(change.scene, with);
    const Scene unchanged = resolve(change.scene, change.before());
    const bool same_mesh = mesh_bits(Model(scene)) == mesh_bits(Model(unchanged));
    if (same_run(scene, unchanged)) {
      EXPECT_EQ(!same_mesh, effects.has(Effect::mesh)) << "mesh";
    }
    if (!same_mesh) continue;
    const Bits& before = bits_before(change);
    const Bits after = bits_of(scene);
    EXPECT_EQ(before.preload != after.preload, effects.has(Effect::preload)) << "preload";
    if (before.preload == after.preload) {
      EXPECT_EQ(before.motion != after.motion, effects.has(Effect::motion)) << "motion";
    }
    EXPECT_EQ(before.surface != after.surface, effects.has(Effect::surface)) << "surface";
    // The place of a probe tells another motion in as many columns.
    const bool same_columns = GetParam() == "probe" && change.key != "probe.midspan.quantity";
    if (!effects.has(Effect::duration) && !same_columns) {
      EXPECT_EQ(before.cost != after.cost, effects.any_of({Effect::cost, Effect::output})) << "cost";
    }
  }
}

std::vector<std::string> tables() {
  std::vector<std::string> names;
  for (const Change& change : changes())
    if (std::find(names.begin(), names.end(), table_in(change.key)) == names.end())
      names.push_back(table_in(change.key));
  return names;
}

INSTANTIATE_TEST_SUITE_P(Tables, KeysOf, testing::ValuesIn(tables()),
                         [](const auto& table) { return table.param; });

TEST(KeyEffects, EveryKeyIsChanged) {
  for (const Key& key :
       scene_keys(TableNames{{"steel"}, {"weld"}, {"odd"}, {"shape"}, {"web"}, {"midspan"}})) {
    const auto is_of_key = [&](const Change& change) { return change.key == key.path; };
    const auto count = std::count_if(changes().begin(), changes().end(), is_of_key);
    EXPECT_EQ(count, key.kind == Kind::directive ? 0 : 1) << key.path;
  }
}

TEST(KeyEffects, DirectivesAffectWhatTheyBring) {
  EXPECT_TRUE(find_key("scene.based_on")->effects.has(Effect::mesh));
  EXPECT_EQ(find_key("slab.present")->effects, (Effects{Effect::mesh, Effect::preload, Effect::cost}));
  EXPECT_EQ(find_key("corrugation.present")->effects, Effects{Effect::surface});
  EXPECT_TRUE(find_key("material.any_name.present")->effects.has(Effect::mesh));
}

}  // namespace
}  // namespace tread
