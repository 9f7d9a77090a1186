#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/profiles/profile_format.hpp"
#include "io/scene/problems.hpp"
#include "io/scene/scene_checks.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/scene/table_reader.hpp"
#include "tests/refusal.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;

using samples::expect_part;

const std::string kBase = "[scene]\nbased_on = \"highspeed-slab-2014\"\n";

/// The message with which the scene is refused; empty where it is accepted.
std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return samples::refusal<InputError>([&] {
    resolve_scene(SceneSource{"x.toml", text, "/nowhere"}, overrides);
  });
}

struct Case {
  std::string text;     ///< follows kBase, so that its first line is line 3
  std::string message;  ///< the whole message
};

void expect_messages(const std::vector<Case>& cases) {
  for (const Case& c : cases) EXPECT_EQ(error_of(kBase + c.text), c.message);
}

TEST(SceneErrors, Names) {
  expect_messages({
      {"[rail]\nlenght = \"3 m\"", "x.toml:4:1: rail.lenght: unknown key (did you mean rail.length?)"},
      {"[rail]\n  friction = 0.4", "x.toml:4:3: rail.friction: unknown key (did you mean contact.friction?)"},
      {"[ballast]\nstiffness = \"20 MN/m\"",
       "x.toml:3:2: ballast: unknown table: [sleepers] holds sleepers on ballast, with stiffness and damping "
       "of the bed; leave out [slab] (see can-and-cannot.md)"},
      {"[wheel]\nflat = \"40 mm\"",
       "x.toml:4:1: wheel.flat: unknown key: a table [surface.NAME] with kind = \"flat\", \"polygon\" or "
       "\"profile\" makes the wheel out of round (see can-and-cannot.md)"},
      {"[motion]\ntractoin = { mu = 0.1 }",
       "x.toml:4:1: motion.tractoin: unknown table (did you mean motion.traction?)"},
      {"[rial]\nlength = \"3 m\"", "x.toml:3:2: rial: unknown table (did you mean rail?)"},
      {"[zones.weld]\nstart = \"3 m\"", "x.toml:3:2: zones: unknown table (did you mean zone.NAME?)"},
      {"[material.stel]",
       "x.toml:3:11: material.stel: has no effect, because no part is of it; the parts state wheel.material "
       "= "
       "\"steel\", rail.material = \"steel\", slab.material = \"slab\", slab.gap_material = \"gap_filler\", "
       "slab.mortar_material = \"mortar\""},
      {"[material.\"wheel steel\"]",
       "x.toml:3:11: material.wheel steel: a material's name consists of letters, digits, _ and -"},
      {"[material.\"\"]", "x.toml:3:11: material.: a material's name consists of letters, digits, _ and -"},
      {"[material.steel]\ndensty = \"1 kg/m3\"",
       "x.toml:4:1: material.steel.densty: unknown key (did you mean material.steel.density?)"},
      {"[vehicle]\ncolour = \"red\"",
       "x.toml:4:1: vehicle.colour: unknown key (known: sprung_mass, unsprung_mass, suspension_stiffness, "
       "suspension_damping, longitudinal, present)"},
      {"[motion]\ntraction = { mue = 0.3 }",
       "x.toml:4:14: motion.traction.mue: unknown key (did you mean motion.traction.mu?)"},
      {"[solution_zone]\npresent = false",
       "x.toml:4:1: solution_zone.present: unknown key: [solution_zone] is always there and cannot be left "
       "out"},
      {"[motion]\ntraction = { present = false }",
       "x.toml:4:14: motion.traction.present: unknown key (known: mu, torque, ramp, shape, reversals)"},
  });
  expect_part(
      error_of("[scene]\nbased_on = \"highspeed\"\n[motion]\nspeed = \"3 m/s\""),
      "x.toml:2:1: scene.based_on: expected the name of a library entry (highspeed-slab-2014, "
      "highspeed-slab-2014-calibrated, highspeed-slab-2014-thin-web, ballasted-cn60, ballasted-60e1), got "
      "the string");
}

/// Every part of a path below the known tables may be a word with an answer.
TEST(SceneErrors, WordsOfOtherPrograms) {
  for (const auto& [typed, answer] :
       {std::pair{"noise.present=true", "unknown key: there is no noise"},
        {"temperature.initial=20", "unknown key: there is no temperature"},
        {"motion.gauge.width=\"1 m\"", "unknown key: the model is half a track"},
        {"support.a.fastenin=1", "unknown key (did you mean support.a.fastening?)"},
        {"load.axle_load=\"200 kN\"", "unknown key: vehicle.sprung_mass sets it: half the axle load"},
        {"curve.radius=\"3 m\"", "unknown key: the track is straight"},
        {"wheel.radius=\"0.4 m\"", "unknown key: wheel.diameter is twice"},
        {"motion.velocity=\"3 m/s\"", "unknown key: motion.speed is"},
        {"contact.mu=0.3", "unknown key: contact.friction is"},
        {"sleepers.pitch=\"0.6 m\"", "unknown key: fastenings.spacing is"},
        {"rail.profile=UIC60", "\"UIC60\" is unknown: UIC 60 is rail.profile = \"60E1\""},
        {"slab.stiffness=1", "unknown key (known: pitch, gap, first_gap,"},
        {"vehicle.mass=\"1 t\"", "unknown key (did you mean vehicle.sprung_mass?)"},
        {"fastenings.support_stiffness=1", "unknown key (did you mean fastenings.stiffness?)"},
        {"track.stiffness=1", "unknown key (did you mean fastenings.stiffness?)"}})
    expect_part(error_of(kBase, {typed}), answer);
}

TEST(SceneErrors, TablesWithoutTheirNames) {
  expect_messages({
      {"[support]\nfastening = 3\nbed = 0",
       "x.toml:3:2: support: the table needs a name: write [support.NAME]; a support's name consists of "
       "letters, digits, _ and -"},
      {"[material]\ndensity = \"1 kg/m3\"\ndamping = { kind = \"rayleigh_beta\", value = \"1e-8 s\" }",
       "x.toml:3:2: material: the table needs a name: write [material.NAME]; a material's name consists of "
       "letters, digits, _ and -"},
      {"[zone]\nstart = \"3 m\"\n[zone.weld]\nstart = \"1 m\"\n[probe]",
       "2 problems\nx.toml:3:2: zone: the table needs a name: write [zone.NAME]; a zone's name consists of "
       "letters, digits, _ and -\n"
       "x.toml:7:2: probe: the table needs a name: write [probe.NAME]; a probe's name consists of letters, "
       "digits, _ and -"},
  });
  for (const char* table : {"surface", "body"})
    expect_part(error_of(kBase + "[" + table + "]\nkind = \"dip\""),
                std::string("the table needs a name: write [") + table + ".NAME]");
  EXPECT_EQ(error_of(kBase + "[probe]\nx = { y = \"1 mm\" }\n[probe.depth]"), "");
}

TEST(SceneErrors, Types) {
  expect_messages({
      {"[rail]\nlength = 15.2",
       "x.toml:4:1: rail.length: 15.2 has no unit; expected a length, such as \"15.2 m\" (units: m, cm, mm, "
       "um, km)"},
      {"[rail]\nlength = \"15.2 kg\"",
       "x.toml:4:1: rail.length: \"15.2 kg\" is a mass; expected a length, such as \"15.2 m\" (units: m, cm, "
       "mm, um, "
       "km)"},
      {"[rail]\nlength = [1]",
       "x.toml:4:1: rail.length: got an array; expected a length, such as \"1 m\" (units: m, cm, mm, um, "
       "km)"},
      {"[rail]\nlength = nan",
       "x.toml:4:1: rail.length: got the number nan; expected a length, such as \"1 m\" (units: m, cm, mm, "
       "um, km)"},
      {"[rail]\nprofile = 60", "x.toml:4:1: rail.profile: expected a string in quotes, got the number 60"},
      {"[contact]\nfriction = \"0.5\"",
       "x.toml:4:1: contact.friction: expected a number without quotes, got the string \"0.5\"; write 0.5"},
      {"[contact]\nfriction = \".5\"",
       "x.toml:4:1: contact.friction: expected a number without quotes, got the string \".5\"; write 0.5"},
      {"[contact]\nfriction = inf", "x.toml:4:1: contact.friction: the number must be finite"},
      {"[fastenings]\ncount = 23.5",
       "x.toml:4:1: fastenings.count: expected a whole number without quotes, got the number 23.5"},
      {"[fastenings]\ncount = 24.0",
       "x.toml:4:1: fastenings.count: expected a whole number without quotes, got the number 24.0"},
      {"[rail]\ninclination = \"1/40\"",
       "x.toml:4:1: rail.inclination: \"1/40\" is not a number; write 1:40 or 0.025"},
      {"[fastenings]\ncount = 99999999999", "x.toml:4:1: fastenings.count: 99999999999 is too large"},
      {"[motion]\nspin_in_preload = 1",
       "x.toml:4:1: motion.spin_in_preload: expected true or false without quotes, got the number 1"},
      {"[slab]\npresent = \"no\"",
       "x.toml:4:1: slab.present: expected true or false without quotes, got the string \"no\""},
      {"[motion]\ntraction = 0.3",
       "x.toml:4:1: motion.traction: expected a table with keys among mu, torque, ramp, shape, reversals; "
       "got the number 0.3"},
      {"[rail.length]\nvalue = 3",
       "x.toml:3:7: rail.length: got a table; expected a length, such as \"1 m\" (units: m, cm, mm, um, km)"},
      {"[wheel]\nprofile = \"LMAA\"",
       "x.toml:4:1: wheel.profile: \"LMAA\" is unknown; did you mean \"LMA\"? choose from: LMA, S1002, arc, "
       "cylinder, or a "
       "file"},
      {"[corrugation]\nkind = \"square\"",
       "x.toml:4:1: corrugation.kind: \"square\" is unknown; choose from: sine, table, map, random"},
      {"[material.steel]\ndamping = { kind = \"rayleigh_beta\", value = 1e-8 }",
       "x.toml:4:1: material.steel.damping: 1e-08 has no unit; expected a time, such as \"1e-08 s\" (units: "
       "s, ms, us, "
       "min, h)"},
  });
  expect_part(error_of("rail = \"none\""),
              "x.toml:1:1: rail: expected a table with keys among material, head_material, profile,");
  expect_part(error_of("rail = \"none\""), "(to leave it out, write rail.present = false)");
  expect_part(
      error_of(kBase + "[material.slab]\ndamping = { kind = \"high_frequency_fraction\", value = 0.01 }"),
      "x.toml:4:1: material.slab.damping: slab, gap filler and mortar are damped as one body");
  expect_part(
      error_of(kBase + "[material.steel]\ndamping_up_to = \"3 kHz\""),
      "x.toml:4:1: material.steel.damping_up_to: a frequency up to which damping holds belongs to damping "
      "= { kind = \"rayleigh_beta\"");
  expect_part(error_of(kBase + "[material.slab]\ndamping = { kind = \"rayleigh_beta\", value = \"1e-5 s\" }\n"
                               "damping_up_to = \"3 kHz\""),
              "slab, gap filler and mortar are damped as one body");
  expect_part(error_of(kBase + "[material.steel]\ndamping_up_to = \"0 Hz\""),
              "damping_up_to: 0 kHz is not allowed");
  expect_part(error_of(kBase + "[material.steel]\ndamping = 1e-4"),
              "expected { kind = \"high_frequency_fraction\"");
  expect_part(error_of(kBase + "[material.steel]\ndamping = { kind = \"viscous\", value = 1 }"),
              "kind \"viscous\"");
  expect_part(error_of(kBase + "[material.steel]\ndamping = { kind = \"rayleigh_beta\" }"),
              "expected { kind");
}

TEST(SceneErrors, Ranges) {
  expect_messages({
      {"[fastenings]\nstiffness = \"-22 MN/m\"",
       "x.toml:4:1: fastenings.stiffness: -22 MN/m is not allowed; it must be above 0 MN/m and at most 10000 "
       "MN/m"},
      {"[vehicle]\nsprung_mass = \"0 kg\"",
       "x.toml:4:1: vehicle.sprung_mass: 0 kg is not allowed; it must be above 0 kg and at most 100000 kg"},
      {"[material.slab]\npoissons_ratio = 0.5",
       "x.toml:4:1: material.slab.poissons_ratio: 0.5 is not allowed; it must be at least 0 and at most "
       "0.49"},
      {"[material.slab]\nyoungs_modulus = \"0 GPa\"",
       "x.toml:4:1: material.slab.youngs_modulus: 0 GPa is not allowed; it must be above 0 GPa and at most "
       "10000 GPa"},
      {"[wheel]\naxle_bore = \"120 mm\"",
       "x.toml:4:1: wheel.axle_bore: 120 mm is not allowed; it must be at least 20 mm and at most 110 mm"},
      {"[rail]\ninclination = \"1:2\"",
       "x.toml:4:1: rail.inclination: 0.5 is not allowed; it must be at least 0 and at most 0.1"},
      {"[fastenings]\ncount = 0",
       "x.toml:4:1: fastenings.count: 0 is not allowed; it must be at least 1 and at most 10000"},
      {"[motion]\nduration = \"-1 ms\"",
       "x.toml:4:1: motion.duration: -0.001 s is not allowed; it must be above 0 s and at most 100 s"},
  });
}

TEST(SceneErrors, PartsThatDoNotFit) {
  expect_messages({
      {"[corrugation]\nstart = \"30 m\"",
       "x.toml:4:1: corrugation.start: the corrugation, x = 30 m to 30.56 m, is not on the rail, -6.1 m to "
       "9.1 m; move it, or lengthen the rail"},
      {"[corrugation]\nstart = \"2.5 m\"",
       "x.toml:4:1: corrugation.start: the corrugation, x = 2.5 m to 3.06 m, is not inside the solution "
       "zone, 2.4 m to 3 m; move one of them, or widen the zone"},
      {"[corrugation]\nwavelength = \"0.7 m\"",
       "x.toml:4:1: corrugation.wavelength: not one wave of 700 mm fits into the corrugation's length of 560 "
       "mm; "
       "state a smaller corrugation.wavelength or a larger corrugation.length"},
      {"[solution_zone]\nstart = \"9 m\"",
       "x.toml:4:1: solution_zone.start: the solution zone, x = 9 m to 9.6 m, is not inside the track, -6.1 "
       "m to 9.1 m; move or shorten it, or lengthen the rail"},
      {"[motion]\nduration = \"0.2 s\"",
       "x.toml:4:1: motion.duration: the wheel rolls to x = 16.6667 m, beyond 9.08 m, where it is 0.02 m "
       "from the rail's end; state a shorter motion.duration, or rail.length = \"22.9 m\" and "
       "fastenings.count = 35"},
      {"[motion]\nduration = \"0.2 s\"\n[rail]\nlength = \"22.9 m\"\n[fastenings]\ncount = 35", ""},
      {"[motion]\nspeed = \"100 km/h\"\nduration = \"0.32 s\"\ntraction.mu = 0.3\n[vehicle]\nlongitudinal = "
       "\"free\"",
       "x.toml:5:1: motion.duration: the wheel rolls to x = 10.3188 m, beyond 9.08 m, where it is 0.02 m "
       "from the rail's end; state a shorter motion.duration, or rail.length = \"16.6 m\" and "
       "fastenings.count = 26"},
      {"[rail]\norigin = \"0 m\"",
       "x.toml:4:1: rail.origin: the wheel starts at x = 0 m; the rail lets it start from 0.02 m on: "
       "state a larger rail.origin"},
      {"[motion]\nrun_up = \"9 m\"",
       "x.toml:4:1: motion.run_up: the wheel starts at x = -6.6 m; the rail lets it start from -6.08 m on: "
       "state a larger rail.origin or a smaller motion.run_up"},
      {"[fastenings]\ncount = 25",
       "x.toml:4:1: fastenings.count: the last fastening's pad ends at 15.81 m, beyond the rail of 15.2 m; "
       "state a smaller fastenings.count or a larger rail.length"},
      {"[fastenings]\nfirst = \"0.05 m\"",
       "x.toml:4:1: fastenings.first: the first fastening's pad begins 0.035 m before the rail's left end; "
       "state a larger fastenings.first or a shorter fastenings.pad_length"},
      {"[fastenings]\npad_length = \"0.7 m\"\nfirst = \"0.4 m\"\ncount = 10",
       "x.toml:4:1: fastenings.pad_length: the pads of neighbouring fastenings overlap: they are 700 mm "
       "long, "
       "650 mm apart; state a shorter fastenings.pad_length or a larger fastenings.spacing"},
      {"[fastenings]\nacross = \"free\"",
       "x.toml:4:1: fastenings.across: nothing would hold the rail sideways; state \"held\", or \"elastic\" "
       "with fastenings.across_stiffness"},
      {"[slab]\ngap = \"7 m\"",
       "x.toml:4:1: slab.gap: the gap, 7000 mm, is not shorter than the pitch of slab and gap "
       "together, 6500 mm; state a smaller slab.gap or a larger slab.pitch"},
      {"[motion]\ntraction = { mu = 0.3, torque = \"3 kN m\" }",
       "x.toml:4:24: motion.traction.torque: state the traction by mu or by torque, not both"},
      {"[motion]\ntraction = { mu = -0.6 }",
       "x.toml:4:14: motion.traction.mu: a traction coefficient of -0.6 cannot be reached with the "
       "coefficient of friction 0.5; state at most that, or more friction"},
      {"[wheel]\nshape = \"tyre\"",
       "x.toml:4:1: wheel.shape: a tyre has the profile arc or cylinder; state one of them, or wheel.shape = "
       "\"half_wheelset\""},
      {"[wheel]\nprofile = \"arc\"",
       "x.toml:4:1: wheel.profile: a half wheelset has the profile LMA, S1002 or a file; state one of them, "
       "or "
       "wheel.shape = \"tyre\""},
      {"[wheel]\ndiameter = \"0.4 m\"\nlateral_offset = \"40 mm\"",
       "2 problems\nx.toml:4:1: wheel.diameter: 400 mm is outside 660 to 1400 mm of a half wheelset: rim, "
       "brake ring and hub need their room between tread and axle; wheel.shape = \"tyre\" takes other "
       "diameters\nx.toml:5:1: wheel.lateral_offset: 40 mm is outside -30 to 30 mm of a half wheelset: the "
       "rail has to lie under the tread"},
  });
}

TEST(SceneErrors, RoughnessWithoutAWave) {
  const std::string random = "[corrugation]\nkind = \"random\"\n";
  expect_messages({
      {random + "shortest = \"100 mm\"\nlongest = \"110 mm\"",
       "x.toml:6:1: corrugation.longest: no wave from 100 mm to 110 mm fits as a whole number into the "
       "length, 0.56 m: the rail would be smooth; state a corrugation.longest above 112 mm or a "
       "corrugation.shortest below 93.3333 mm, or another corrugation.length"},
      {random + "shortest = \"0.1 mm\"",
       "x.toml:5:1: corrugation.shortest: the shortest wave, 0.1 mm, fits 5600 times into the length, "
       "0.56 m; at most 5000 times are possible: state a corrugation.shortest of at least 0.112 mm, or a "
       "smaller corrugation.length"},
      {random + "shortest = \"1e-20 mm\"",
       "x.toml:5:1: corrugation.shortest: the shortest wave, 1e-20 mm, fits 5.6e+22 times into the length, "
       "0.56 m; at most 5000 times are possible: state a corrugation.shortest of at least 0.112 mm, or a "
       "smaller corrugation.length"},
      {random + "shortest = \"100 mm\"\nlongest = \"113 mm\"", ""},
      {random + "shortest = \"93 mm\"\nlongest = \"110 mm\"", ""},
      {random + "shortest = \"0.112 mm\"", ""},
      // The ends fade up to the middle, where rms is reached.
      {random + "longest = \"0.56 m\"", ""},
  });
}

TEST(SceneErrors, FasteningsBesideFootAndSlab) {
  expect_messages({
      {"[fastenings]\npad_width = \"0.3 m\"",
       "x.toml:4:1: fastenings.pad_width: the outer spring-dampers lie 112.5 mm from the middle of the foot, "
       "half of which is 74.98 mm wide (CN60); state a smaller fastenings.pad_width"},
      {"[slab]\nwidth = \"0.1 m\"",
       "x.toml:4:1: slab.width: the slab lies from y = -0.05 m to 0.05 m, the fastenings' spring-dampers "
       "from -0.05185 m to 0.06065 m; state a larger slab.width, another slab.offset or a smaller "
       "fastenings.pad_width"},
      {"[rail]\nprofile = \"49E1\"", ""},
      {"[slab]\nwidth = \"0.13 m\"", ""},
  });
  expect_part(error_of(kBase + "[slab]\noffset = \"0.6 m\""),
              "x.toml:4:1: slab.offset: the slab lies from y = -0.0375 m to ");
}

/// The rail leans 1:40 about its crown, and its foot lies beside y = 0.
TEST(SceneErrors, FastenersBesideTheSleeper) {
  const std::string base = "[scene]\nbased_on = \"ballasted-60e1\"\n[sleepers]\noffset = \"0 m\"\n";
  expect_part(
      error_of(base + "length = \"0.115 m\""),
      "the pad does not lie on the sleeper, y = -0.0575 m to 0.0575 m: the fastenings' spring-dampers "
      "lie from ");
  EXPECT_EQ(error_of(base + "length = \"0.13 m\""), "");
}

TEST(SceneErrors, ComponentsThatLackOthers) {
  expect_messages({
      {"[load]\nwheel_load = \"98.1 kN\"",
       "x.toml:3:2: load: a wheel carries a vehicle or a load; vehicle.sprung_mass = \"9660 kg\" presses as "
       "much as the load: state it in place of [load], or leave one out: vehicle.present = false takes its "
       "masses and suspension away"},
      {"[load]\nwheel_load = \"1 kN\"",
       "x.toml:3:2: load: a wheel carries a vehicle or a load; leave one out: vehicle.present = false takes "
       "its masses and suspension away"},
      {"[contact]\npresent = false", "x.toml: wheel: wheel and rail need [contact]; add it"},
      {"[rail]\npresent = false\n[fastenings]\npresent = false\n[slab]\npresent = false\n[contact]\npresent "
       "= "
       "false",
       "x.toml: motion: a wheel without a rail moves freely and carries neither load nor vehicle; add "
       "[rail], or "
       "state load.present = false or vehicle.present = false"},
      {"[fastenings]\npresent = false",
       "2 problems\nx.toml: slab: a slab needs fastenings; add [fastenings]\n"
       "x.toml: rail.support: the rail stands on fastenings; add [fastenings], or "
       "state rail.support = \"rigid\" or \"free\""},
      {"[rail]\nsupport = \"rigid\"",
       "x.toml:4:1: rail.support: a rail with support = \"rigid\" has no fastenings; "
       "state fastenings.present = false"},
      {"[material.steel]\npresent = false",
       "x.toml:3:11: material.steel: the wheel needs [material.steel]; the scene's materials: gap_filler, "
       "mortar, "
       "slab"},
      {"[pulse]\nvelocity = \"1 m/s\"\nlength = \"1 m\"",
       "x.toml:3:2: pulse: a pulse needs [rail] and no wheel; state [rail] alone, or leave [pulse] out"},
      {"[hammer]\nposition = \"20 m\"\nforce = \"1 kN\"\nduration = \"1 ms\"",
       "x.toml:4:1: hammer.position: the struck point, x = 20 m, is not on the rail, -6.1 m to 9.1 m; "
       "move it, or lengthen the rail"},
      {"[motion]\npresent = false\n[hammer]\nforce = \"1 kN\"\nduration = \"1 ms\"",
       "x.toml:5:2: hammer: a hammer needs [motion] with the duration"},
  });
  EXPECT_EQ(error_of(""),
            "x.toml: scene.based_on: the scene is empty; add [wheel] or [rail], or scene.based_on = "
            "\"highspeed-slab-2014\"");
  expect_part(
      error_of("[material.steel]\ndensity = \"7790 kg/m3\"\npoissons_ratio = 0.3\n[wheel]\n[vehicle]"),
      "x.toml:1:11: material.steel.youngs_modulus: is missing; [material.steel] needs a stress");
  expect_part(error_of("[vehicle]"), "x.toml:1:2: vehicle: a vehicle needs a wheel; add [wheel]");
}

/// Nodes are held across: nothing may push them there.
TEST(SceneErrors, PlaneStrainOfBodiesThatAreNotStraightAcross) {
  const std::string slice =
      "[scene]\nplane_strain = true\n[material.steel]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\n"
      "density = \"7850 kg/m3\"\n[load]\nwheel_load = \"20 kN\"\n[contact]\n[motion]\nduration = \"1 ms\"\n"
      "[rail]\nprofile = \"box\"\nsupport = \"rigid\"\n";
  const std::string wheel = "[wheel]\nshape = \"tyre\"\nprofile = \"cylinder\"\n";
  EXPECT_EQ(error_of(slice + wheel), "");
  EXPECT_EQ(error_of(slice + wheel +
                     "[surface.a]\nkind = \"dip\"\nat = \"0 m\"\ndepth = \"1 mm\"\nlength = \"0.1 m\""),
            "");
  EXPECT_EQ(error_of(slice + "[wheel]\nshape = \"tyre\"\nprofile = \"arc\""),
            "x.toml:2:1: scene.plane_strain: plane strain is that of a wheel that is straight across; state "
            "wheel.profile = \"cylinder\", or scene.plane_strain = false");
  expect_part(error_of(slice + "crown_radius = \"0.3 m\"\n" + wheel), "state rail.crown_radius = 0");
  expect_part(error_of(slice + wheel + "[corrugation]"), "state a [surface.NAME] with kind = \"waves\"");
  expect_part(error_of(slice + wheel +
                       "[surface.a]\nkind = \"dent\"\nat = \"0 m\"\ndepth = \"0.1 mm\"\nlength = \"0.1 "
                       "m\"\nwidth = \"30 mm\""),
              "a dent varies across, and plane strain has no depth that does; state kind = \"dip\"");
}

TEST(SceneErrors, KeysWithoutEffect) {
  expect_messages({
      {"[rail]\nsection = \"60E1\"",
       "x.toml:4:1: rail.section: has an effect only with rail.profile = a file"},
      {"[wheel]\nprofile_smoothing = \"0.1 mm\"",
       "x.toml:4:1: wheel.profile_smoothing: has an effect only with wheel.profile = a file"},
      {"[rail]\nprofile = \"box\"\nwidth = \"160 mm\"\ninclination = \"1:20\"",
       "x.toml:6:1: rail.inclination: has no effect with rail.profile = \"box\""},
      {"[rail]\nwidth = \"60 mm\"", "x.toml:4:1: rail.width: has an effect only with rail.profile = \"box\""},
      {"[slab]\npresent = false\nwidth = \"1 m\"",
       "x.toml:5:1: slab.width: has no effect, because slab.present = "
       "false"},
      {"[slab]\npresent = false\n[material.mortar]\ndensity = \"1600 kg/m3\"",
       "x.toml:5:11: material.mortar: has no effect without [slab]"},
      {"[motion]\npresent = false\n[material.steel]\nlaw = \"j2\"\nyield_stress = \"300 MPa\"",
       "x.toml:6:1: material.steel.law: law = \"j2\" has no effect without [motion]: the static state is "
       "elastic; "
       "state \"elastic\", or add [motion]"},
      {"[corrugation]\nkind = \"table\"\ndepth = \"1 mm\"",
       "2 problems\nx.toml:3:2: corrugation.file: is missing; [corrugation] needs a value: File of two "
       "columns, x from "
       "the start and depth positive downwards, after a line such as `# x [m]  d [mm]`; map: three, "
       "`# x [m]  y [mm]  d [um]`, each x with each y once, or HDF5 with x, y and depth; y counts from "
       "corrugation.centre\n"
       "x.toml:5:1: corrugation.depth: has an effect only with corrugation.kind = \"sine\""},
  });
}

TEST(SceneErrors, TractionThatActsOnNothing) {
  const auto traction = [](const std::string& keys) {
    return error_of(kBase + "[motion]\ntraction = { " + keys + " }");
  };
  for (const char* torque : {"mu = 0.3", "torque = \"3 kN m\""})
    expect_part(
        traction(torque + std::string(", ramp = \"0 ms\", reversals = 2")),
        "motion.traction.reversals: a reversal takes 2 T1, and motion.traction.ramp = 0 leaves no time "
        "for it; state a motion.traction.ramp above 0, or motion.traction.reversals = 0");
  // Resolved scenes list the keys of the torque without one, too.
  for (const char* keys :
       {"mu = 0.3, ramp = \"1 ms\", reversals = 2", "torque = \"3 kN m\", shape = \"smooth\"",
        "mu = 0.3, ramp = \"0 ms\"", "ramp = \"1 ms\"", "shape = \"smooth\"", "reversals = 2",
        "ramp = \"0 ms\", reversals = 2", "ramp = \"5 ms\", shape = \"linear\", reversals = 0"})
    EXPECT_EQ(traction(keys), "") << keys;
}

TEST(SceneErrors, WheelsWithoutARail) {
  std::string alone = kBase;
  for (const char* table : {"rail", "fastenings", "slab", "contact", "vehicle"})
    alone += fmt::format("[{}]\npresent = false\n", table);
  EXPECT_EQ(error_of(alone), "");
  expect_part(error_of(alone + "[motion]\ntraction = { mu = 0.1 }"),
              "motion.traction.mu: a traction coefficient is a share of F_N and needs [contact]; state "
              "motion.traction.torque");
  expect_part(error_of(alone + "[wheel]\nshape = \"tyre\"\nprofile = \"arc\"\nbore = \"guided\""),
              "wheel.bore: a guided bore rolls on a rail; add [rail], or state wheel.bore = \"free\"");
}

TEST(SceneErrors, Materials) {
  const std::string own =
      "[material.wheel_steel]\nyoungs_modulus = \"70 GPa\"\npoissons_ratio = 0.3\ndensity = \"7790 kg/m3\"\n";
  expect_messages({
      {own + "[wheel]\nmaterial = \"wheel_stell\"",
       "x.toml:8:1: wheel.material: the wheel needs [material.wheel_stell]; the scene's materials: "
       "gap_filler, "
       "mortar, slab, steel, wheel_steel (did you mean wheel_steel?)"},
      {own + "[wheel]\nmaterial = 3",
       "x.toml:8:1: wheel.material: expected a string in quotes, got the number 3"},
      {own,
       "x.toml:3:11: material.wheel_steel: has no effect, because no part is of it; the parts state "
       "wheel.material "
       "= \"steel\", rail.material = \"steel\", slab.material = \"slab\", slab.gap_material = "
       "\"gap_filler\", "
       "slab.mortar_material = \"mortar\""},
      {"[material.wheel_steel]\nyoungs_modulus = \"70 GPa\"\n[wheel]\nmaterial = \"wheel_steel\"",
       "2 problems\nx.toml:3:11: material.wheel_steel.poissons_ratio: is missing; [material.wheel_steel] "
       "needs a "
       "value: Poisson's ratio\nx.toml:3:11: material.wheel_steel.density: is missing; "
       "[material.wheel_steel] needs "
       "a density: Density"},
      {"[slab]\nmortar_material = \"steel\"",
       "x.toml: material.slab.damping: slab, gap filler and mortar are damped as one body; state the same "
       "damping "
       "for all three"},
  });
  EXPECT_EQ(error_of(kBase, {"rail.material=iron"}),
            "--set: rail.material: the rail needs [material.iron]; the scene's materials: gap_filler, "
            "mortar, slab, "
            "steel");
  EXPECT_EQ(
      error_of(kBase, {"material.steel=7"}),
      "--set: material.steel: expected a table with keys among youngs_modulus, poissons_ratio, density, "
      "law, yield_stress, isotropic_hardening, kinematic_hardening, damping, damping_up_to, present; got the "
      "number 7 (to leave it out, write material.steel.present = "
      "false)");
  expect_part(error_of(kBase, {"material.soft.youngs_modulus=70"}), "material.soft.youngs_modulus: ");
  // The wheel's own steel bounds the speed of its rim.
  expect_part(error_of(kBase + own + "[wheel]\nmaterial = \"wheel_steel\"\n[motion]\ncreepage = 1.5\n"),
              "the wheel's rim moves at 583.3 m/s");
}

TEST(SceneErrors, DepthsOfSurfaces) {
  expect_messages({
      {"[surface.a]\nkind = \"flat\"\nat = \"2.7 m\"",
       "x.toml:3:10: surface.a.length: is missing; [surface.a] needs a length: Length of dip or dent; of the "
       "flat's chord; that the whole waves must fit into"},
      {"[surface.a]\nkind = \"flat\"\nat = \"2.7 m\"\nlength = \"40 mm\"\ndepth = \"1 mm\"",
       "x.toml:7:1: surface.a.depth: has an effect only with surface.a.kind = \"dip\" or \"dent\" or "
       "\"waves\" or "
       "\"polygon\""},
      {"[surface.a]\nkind = \"flat\"\nat = \"2.7 m\"\nlength = \"500 mm\"",
       "x.toml:6:1: surface.a.length: a chord of 500 mm on a wheel of 860 mm is no flat; state at most half "
       "the "
       "diameter"},
      {"[surface.a]\nkind = \"dip\"\nat = \"12 m\"\nlength = \"1 m\"\ndepth = \"1 mm\"",
       "x.toml:5:1: surface.a.at: the depth's place, x = 12 m, is not on the rail, -6.1 m to 9.1 m; move it, "
       "or "
       "lengthen the rail"},
      {"[surface.a]\nkind = \"dip\"\non = \"wheel\"\nat = \"1 m\"\nlength = \"3 m\"\ndepth = \"1 mm\"",
       "x.toml:7:1: surface.a.length: the depth is 3 m long, the wheel's circumference 2.70177 m; shorten "
       "the depth"},
      {"[surface.a]\nkind = \"waves\"\nat = \"1 m\"\nlength = \"0.3 m\"\ndepth = \"1 mm\"\nwavelength = \"1 "
       "m\"",
       "x.toml:8:1: surface.a.wavelength: not one wave of 1000 mm fits into the length of 300 mm; "
       "state a smaller wavelength or a larger length"},
      {"[surface.a]\nkind = \"hole\"\nat = \"1 m\"\ndepth = \"1 mm\"\nlength = \"1 m\"",
       "x.toml:4:1: surface.a.kind: \"hole\" is unknown; choose from: dip, dent, waves, polygon, flat, "
       "profile, map"},
  });
}

TEST(SceneErrors, AllInOnePassInTheOrderOfTheFile) {
  const std::string text = kBase +
                           "[rail]\nlenght = \"3 m\"\norigin = 6.1\n"
                           "[fastenings]\nstiffness = \"-1 MN/m\"\n"
                           "[motion]\nduration = \"1 s\"\n";
  EXPECT_EQ(
      error_of(text, {"motion.sped=3 m/s"}),
      "4 problems\n"
      "--set: motion.sped: unknown key (did you mean motion.speed?)\n"
      "x.toml:4:1: rail.lenght: unknown key (did you mean rail.length?)\n"
      "x.toml:5:1: rail.origin: 6.1 has no unit; expected a length, such as \"6.1 m\" (units: m, cm, mm, um, "
      "km)\n"
      "x.toml:7:1: fastenings.stiffness: -1 MN/m is not allowed; it must be above 0 MN/m and at most 10000 "
      "MN/m");
}

TEST(SceneErrors, AMisspeltTableIsNotAlsoReportedAsMissing) {
  EXPECT_EQ(error_of("[whel]\n[rail]\nprofile = \"box\"\nsupport = \"rigid\"\n[contact]\n[motion]\n"),
            "x.toml:1:2: whel: unknown table (did you mean wheel?)");
}

TEST(SceneErrors, Overrides) {
  EXPECT_EQ(error_of(kBase, {"motion.speed=250"}),
            "--set: motion.speed: \"250\" has no unit; expected a speed, such as \"250 km/h\" (units: m/s, "
            "mm/s, km/h)");
  expect_part(error_of(kBase, {"motion.speed"}), "--set: \"motion.speed\" is not of the form key=value");
  expect_part(error_of(kBase, {"=3"}), "is not of the form key=value");
  for (const char* typed : {"scene.title=caf\xE9 3", "scene.title=\"caf\xE9 3\""})
    expect_part(error_of(kBase, {typed}), "caf? 3");
  expect_part(error_of(kBase, {"rail.profile=\xFF.txt"}),
              "--set: rail.profile: \"rail.profile=?.txt\" has bytes that are not UTF-8");
  EXPECT_EQ(error_of(kBase, {"scene.title=caf\xC3\xA9"}), "");
  EXPECT_EQ(error_of(kBase, {"motion.duration=1 s"}).substr(0, 24), "--set: motion.duration: ");
  expect_part(error_of(kBase, {"motion.traction={mu=0.3, rmp=1}"}),
              "--set: motion.traction.rmp: unknown key");
  expect_part(error_of(kBase, {"contact.friction=high"}),
              "expected a number without quotes, got the string \"high\"");
  for (const auto& [typed, number] :
       {std::pair{".5", "0.5"}, std::pair{"5.", "5"}, std::pair{"0,3", "0.3"}, std::pair{"05", "5"}})
    EXPECT_EQ(error_of(kBase, {fmt::format("contact.friction={}", typed)}),
              fmt::format("--set: contact.friction: \"{}\" is not valid TOML; write {}", typed, number));
  for (const char* typed : {"024", "+024"})
    expect_part(error_of(kBase, {fmt::format("fastenings.count={}", typed)}),
                fmt::format("\"{}\" is not valid TOML; write 24", typed));
  for (const char* typed : {"1,000", "24.", "2,5"})
    EXPECT_EQ(error_of(kBase, {fmt::format("fastenings.count={}", typed)}),
              fmt::format("--set: fastenings.count: expected a whole number without quotes, got the string "
                          "\"{}\"",
                          typed));
  expect_part(error_of(kBase, {"slab.present=True"}), "\"True\" is not valid TOML; write true");
}

TEST(SceneErrors, Texts) {
  const auto title = [](const std::string& text) { return "title = \"" + text + "\"\n"; };
  const std::string start = "x.toml:3:1: scene.title: ";
  std::string longest;
  for (int i = 0; i < 1000; ++i) longest += "\xC3\xA9";
  expect_messages({
      {title(longest), ""},
      {title(longest + "x"), start + "the text has 1001 characters, more than the limit of 1000; shorten it"},
      {title("\xC3\xA9\\u0000"),
       start + "character 2 is the control character U+0000; state printable characters alone"},
      {title("\\u007f"),
       start + "character 1 is the control character U+007F; state printable characters alone"},
      {"[wheel]\nprofile = \"a\\u0000.txt\"",
       "x.toml:4:1: wheel.profile: character 2 is the control character U+0000; state printable characters "
       "alone"},
  });
  expect_part(error_of(kBase, {"scene.title=a\rb"}), "--set: scene.title: character 2 is");
}

TEST(SceneErrors, Syntax) {
  expect_part(error_of("[rail]\nlength = = 3\n"), "x.toml:2:10: ");
  expect_part(error_of("[rail]\nlength = \"3 m\"\nlength = \"4 m\"\n"), "x.toml:3:");
  expect_part(error_of("[rail\n"), "x.toml:1:");
  EXPECT_EQ(
      error_of("a" + std::string(400000, '.')),
      "x.toml:1: the line has more than 2000 bytes outside of quotes and comments; an array may go on in "
      "the next lines");
  std::string quoted = "title = \"\"\"\n\"\"\"\n\"a\"";
  for (int part = 0; part < 1000; ++part) quoted += ".\"a\"";
  expect_part(error_of(quoted), "x.toml:3: the line has more than 2000 bytes");
  expect_part(error_of("a = " + std::string(1000, '[')), "x.toml:1:");
  EXPECT_EQ(error_of("[scene]\n[\\x]\n[rail]\n"), "x.toml:2: the line is not valid TOML");
  const std::string foreign = "a character that is not ASCII stands outside of quotes and comments";
  for (const char* text :
       {"[scene]\n[mat\xC3\xA9riau]\n", "[scene]  # \xC3\xA9\ntitle = \"\xC3\xA9\" \xC2\xA0\n",
        "scene.title = \"\\\"\xC3\xA9\"\n\xC3\xA9 = 1\n", "scene.title = '\\'\n\xC3\xA9 = 1\n",
        "scene.title = \"\"\"a\"\"\"\"\n\xC3\xA9 = '''\xC3\xA9'''\n"})
    EXPECT_EQ(error_of(text), "x.toml:2: " + foreign) << text;
  EXPECT_EQ(error_of("scene.title = '''\xC3\xA9\n''\xC3\xA9'''\n[\\x]\n"),
            "x.toml:3: the line is not valid TOML");
  expect_part(error_of("[rail]\nlength = \"\xff\xfe\"\n"), "x.toml:2:");
  // To the parser this quote is part of a number.
  expect_part(error_of("[output]\nframes = 9223372((\"\xC3\xA9ri!=(\n"), "x.toml:2:");
  expect_part(error_of("[output]\nframes = 9223372[\"\xC3\xA9\"]\n"), "x.toml:2:");
}

TEST(SceneErrors, ThousandsOfProblemsAreListedInShort) {
  std::string message;
  const auto processor_time = [&](int keys) {
    std::string text;
    for (int i = 0; i < keys; ++i) text += "key" + std::to_string(i) + " = 1\n";
    const std::clock_t start = std::clock();
    message = error_of(text);
    return static_cast<double>(std::clock() - start);
  };
  // Ten times the problems: about ten times the time, not a hundred.
  const double few = processor_time(5000);
  EXPECT_LT(processor_time(50000), 40 * few);
  EXPECT_EQ(message.substr(0, 15), "50000 problems\n");
  EXPECT_LT(std::count(message.begin(), message.end(), '\n'), 60);
}

TEST(SceneErrors, ThousandsOfTablesTakeTimeInProportion) {
  const auto processor_time = [](int probes) {
    std::string text = kBase;
    for (int i = 0; i < probes; ++i) text += "[probe.p" + std::to_string(i) + "]\nx = \"2.5 m\"\n";
    const std::clock_t start = std::clock();
    EXPECT_EQ(error_of(text), "");
    return static_cast<double>(std::clock() - start);
  };
  const double few = processor_time(300);
  EXPECT_LT(processor_time(3000), 40 * few);
}

class Files : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  static std::string scene_error(const fs::path& path) {
    return samples::refusal<InputError>([&] { read_scene(path); });
  }

  static std::string table_error(const fs::path& path, const TableRules& rules) {
    return samples::refusal<InputError>([&] { read_two_columns(path, rules); });
  }

  samples::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path;
};

TEST_F(Files, ThatCannotBeRead) {
  EXPECT_EQ(scene_error(folder_ / "none.toml"),
            "cannot read " + (folder_ / "none.toml").string() + ": No such file or directory");
  expect_part(scene_error(folder_), "it is a directory, not a file");
  expect_part(scene_error("/dev/null"), "it is not a regular file");
  expect_part(scene_error(write("big.toml", std::string(2 << 20, '\n'))), "more than the limit of 1048576");
  expect_part(scene_error(write("binary.toml", std::string("a\0b", 3))), "it is a binary file, not text");
  const fs::path secret = write("secret.toml", "[rail]\n");
  fs::permissions(secret, fs::perms::none);
  if (geteuid() != 0) expect_part(scene_error(secret), "Permission denied");
}

TEST_F(Files, NamedInAScene) {
  const std::string corrugation = kBase + "[corrugation]\nkind = \"table\"\nfile = \"depth.txt\"\n";
  const fs::path scene = write("scene.toml", corrugation);
  const std::string place = scene.string() + ":5:1: corrugation.file: ";
  EXPECT_EQ(scene_error(scene),
            place + "cannot read " + (folder_ / "depth.txt").string() + ": No such file or directory");
  const fs::path table = write("depth.txt", "# x [m]  d [mm]\n0 0\n0.1 x\n");
  EXPECT_EQ(scene_error(scene), table.string() + ":3: \"x\" is not a number");
  write("depth.txt", "# x [m]  d [mm]\n0 0\n0.7 0.1\n");
  EXPECT_EQ(scene_error(scene), place +
                                    "the corrugation, x = 2.4 m to 3.1 m, is not inside the solution zone, "
                                    "2.4 m to 3 m; move one of them, or widen the zone");
  expect_part(scene_error(write("wheel.toml", kBase + "[wheel]\nprofile = \"worn.txt\"\n")),
              "wheel.toml:4:1: wheel.profile: cannot read");
}

TEST_F(Files, MeasuredDepths) {
  const std::string table = "[surface.squat]\nkind = \"map\"\nat = \"2.7 m\"\nfile = \"map.csv\"\n";
  const auto map = [&](const std::string& rows) {
    write("map.csv", rows);
    return scene_error(write("map.toml", kBase + table));
  };
  const std::string file = (folder_ / "map.csv").string();
  expect_part(map("0 0 1\n"),
              file + ":1: the units are missing: put a line such as \"# x [mm]  y [mm]  d [um]\"");
  expect_part(map("# x [mm], y [mm], d [um]\n0,0\n"), file + ":2: expected 3 numbers, found 2 columns");
  expect_part(map("# x [mm], y [mm], d [us]\n0,0,1\n"), file + ":1: [us] is not a length");
  expect_part(map("# x [mm], y [mm], d [um]\n0,0,1\n1,0,2\n"),
              file + ": expected at least 4 rows of numbers");
  expect_part(map("# x [mm], y [mm], d [um]\n0,0,1\n1,0,2\n2,0,1\n3,0,1\n"),
              "there are 4 places along and 1 across; a map needs two of both");
  expect_part(map("# x [mm], y [mm], d [um]\n0,0,1\n1,0,2\n0,1,1\n0,1,1\n"),
              "the point x = 0 m, y = 0.001 m stands twice");
  expect_part(map("# x [mm], y [mm], d [um]\n0,0,1\n1,0,2\n2,0,1\n0,1,1\n1,1,3\n"),
              "3 places along times 2 across are not the 5 points of the file: that at x = 0.002 m, y = "
              "0.001 m is missing");
  expect_part(map("# x [mm], y [mm], d [um]\n0,0,1\n1,1,2\n2,2,1\n3,3,1\n4,4,3\n"),
              "that at x = 0.001 m, y = 0 m is missing");
  EXPECT_EQ(map("# x [mm], y [mm], d [um]\n1,1,3\n0,0,1\n1,0,2\n0,1,1\n"), "");
  write("round.txt", "# angle [deg]  d [um]\n0 0\n90 20\n400 0\n");
  expect_part(
      scene_error(write("round.toml", kBase + "[surface.round]\nkind = \"profile\"\non = \"wheel\"\nat = "
                                              "\"0 m\"\nfile = \"round.txt\"\n")),
      "surface.round.file: the depth is 3.00197 m long, the wheel's circumference 2.70177 m");
  expect_part(
      scene_error(write("round.toml", kBase + "[surface.round]\nkind = \"profile\"\nat = \"0 m\"\nfile = "
                                              "\"round.txt\"\n")),
      "round.txt:1: unknown unit \"deg\"");
  EXPECT_EQ(map("# angle [deg], y [mm], d [um]\n0,0,1\n1,0,2\n0,1,1\n1,1,3\n"),
            file +
                ":1: [deg] is not a length: a map takes x along the circumference, in a unit such as [mm]; "
                "angles are for [surface] with kind = \"profile\" on the wheel");
}

TEST_F(Files, DepthsOfAFileLieOnTheRail) {
  write("track.txt", "# x [m]  d [mm]\n350.2 0\n350.6 0.1\n351 0\n");
  const auto at = [&](const std::string& place) {
    return scene_error(
        write("at.toml",
              kBase + "[surface.a]\nkind = \"profile\"\nfile = \"track.txt\"\nat = \"" + place + "\"\n"));
  };
  EXPECT_EQ(at("-347.8 m"), "");
  expect_part(at("2.4 m"), "the file's depths, x = 352.6 m to 353.4 m, are not on the rail, -6.1 m to 9.1 m");
}

/// The header's names tell that the columns stand in another order.
TEST_F(Files, ColumnsInAnotherOrder) {
  const auto refusal = [&](const std::string& keys, const std::string& rows) {
    write("columns.txt", rows);
    return scene_error(write("columns.toml", kBase + keys + " = \"columns.txt\"\n"));
  };
  const std::string file = (folder_ / "columns.txt").string();
  const std::string map = "[surface.a]\nkind = \"map\"\nat = \"2.7 m\"\nfile";
  const std::string grid = " d [um]\n0 0 1\n1 0 2\n0 1 1\n1 1 3\n";
  EXPECT_EQ(refusal(map, "# y [mm]  x [mm] " + grid),
            file +
                ":1: the columns are named y, x, d; expected x, y, d in this order: move the columns, and "
                "their names");
  expect_part(refusal("[corrugation]\nkind = \"map\"\nfile", "# depth [mm], x [mm], y [mm]\n0 0 1\n"),
              ":1: the columns are named depth, x, y; expected x, y, d");
  EXPECT_EQ(refusal(map, "# x [mm]  y [mm] " + grid), "");
  EXPECT_EQ(refusal(map, "# Along, s [mm]  across [mm] " + grid), "");
  const std::string depth = "[surface.a]\nkind = \"profile\"\nat = \"2.7 m\"\nfile";
  expect_part(refusal(depth, "# d [mm]  x [m]\n0 0\n0.1 1\n"),
              ":1: the columns are named d, x; expected x, d");
  expect_part(refusal("[contact]\nfriction_law = \"table\"\nfriction_file", "# f [-]  x [m]\n0.1 0\n0.2 1\n"),
              ":1: the columns are named f, x; expected x, f");
  for (const char* key : {"[rail]\nprofile", "[wheel]\nprofile"}) {
    expect_part(refusal(key, "# z [mm]  y [mm]\n0 -36\n1 0\n"),
                ":1: the columns are named z, y; expected y, z");
    expect_part(refusal(key, "A profile\nZ [mm]; Y [mm]\n0; -36\n1; 0\n"),
                ":2: the columns are named z, y; expected y, z");
  }
  EXPECT_EQ(
      table_error(write("table.txt", "# x [mm]  y [mm]\n0 0\n1 1\n"), {.names = {{"y", "x"}, {"z", "y"}}}),
      "");
}

/// Spreadsheets begin a file with three bytes that are no part of the first number.
TEST_F(Files, AByteOrderMarkIsSkipped) {
  EXPECT_EQ(read_two_columns(write("mark.txt",
                                   "\xEF\xBB\xBF"
                                   "1 2\n3 4\n"),
                             {})
                .first,
            (std::vector<double>{1e-3, 3e-3}));
  const std::string text = read_table_text(folder_ / "mark.txt");
  EXPECT_EQ(profile_format(text, "mark.txt"), ProfileFormat::two_columns);
}

TEST_F(Files, DepthsOfAWrongUnit) {
  const auto refusal = [&](const std::string& table, const std::string& rows) {
    write("depth.txt", rows);
    return scene_error(write("depth.toml", kBase + table + "file = \"depth.txt\"\n"));
  };
  const std::string file = (folder_ / "depth.txt").string();
  const auto slip = [](const std::string& place) {
    return "a depth of 30 mm" + place +
           " is not allowed; it must be from -10 to 10 mm: check the unit of the column, [mm]; in [um] it "
           "would be 0.03 mm";
  };
  const std::string map = "kind = \"map\"\n", at = "at = \"2.7 m\"\n";
  const std::string rows = "# x [m]  d [mm]\n0 0\n0.1 30\n0.2 1\n";
  EXPECT_EQ(refusal("[surface.a]\nkind = \"profile\"\n" + at, rows), file + ":3: " + slip(""));
  EXPECT_EQ(refusal("[corrugation]\nkind = \"table\"\n", rows), file + ":3: " + slip(""));
  const std::string grid = "# x [mm]  y [mm]  d [mm]\n0 0 1\n1 0 2\n0 1 30\n1 1 3\n";
  EXPECT_EQ(refusal("[surface.a]\n" + map + at, grid), file + ":4: " + slip(" at x = 0 m, y = 0.001 m"));
  EXPECT_EQ(refusal("[corrugation]\n" + map, grid), file + ":4: " + slip(" at x = 0 m, y = 0.001 m"));
  expect_part(refusal("[surface.a]\nkind = \"profile\"\n" + at, "# x [m]  d [m]\n0 0\n0.1 -20\n"),
              ":3: a depth of -2e+04 mm is not allowed; it must be from -10 to 10 mm: check the unit of the "
              "column, [m]; in [um] it would be -0.02 mm");
  EXPECT_EQ(refusal("[surface.a]\nkind = \"profile\"\n" + at, "# x [m]  d [mm]\n0 -10\n0.1 10\n"), "");
}

/// Heights count upwards, depths downwards.
TEST_F(Files, HeightsInPlaceOfDepths) {
  const auto refusal = [&](const std::string& table, const std::string& rows) {
    write("depth.txt", rows);
    return scene_error(write("depth.toml", kBase + table + "file = \"depth.txt\"\n"));
  };
  const auto counts = [&](const std::string& name) {
    return (folder_ / "depth.txt").string() + ":1: the column " + name +
           " counts upwards, and depths count downwards: turn its sign and name it d";
  };
  const std::string profile = "[surface.a]\nkind = \"profile\"\nat = \"2.7 m\"\n";
  const std::string map = "[surface.a]\nkind = \"map\"\nat = \"2.7 m\"\n";
  EXPECT_EQ(refusal("[corrugation]\nkind = \"table\"\n", "# x [m]  z [um]\n0 0\n0.1 3\n"), counts("z"));
  EXPECT_EQ(refusal(profile, "# x [m]  Height [um]\n0 0\n0.1 3\n"), counts("Height"));
  const std::string grid = "\n0 0 1\n1 0 2\n0 1 1\n1 1 3\n";
  EXPECT_EQ(refusal(map, "# x [mm]  y [mm]  z [um]" + grid), counts("z"));
  EXPECT_EQ(refusal("[corrugation]\nkind = \"map\"\n", "# x [mm]  y [mm]  z [um]" + grid), counts("z"));
  for (const char* name : {"d", "depth", "depth z", "wear"})
    EXPECT_EQ(refusal(profile, std::string("# x [m]  ") + name + " [um]\n0 0\n0.1 3\n"), "") << name;
}

TEST_F(Files, ProfilesWhoseAxesAreMistaken) {
  // Rows of the flange's back and tip, of the tread and of the rim.
  const auto wheel = [&](const std::string& rows) {
    write("wheel.txt", "# y [mm]  z [mm]\n" + rows);
    return scene_error(write("wheel.toml", kBase + "[wheel]\nprofile = \"wheel.txt\"\n"));
  };
  const std::string place =
      (folder_ / "wheel.toml").string() + ":4:1: wheel.profile: " + (folder_ / "wheel.txt").string() + ": ";
  expect_part(wheel("-70 -10\n-56 -27\n-40 -10\n0 0\n65 3\n"),
              place + "the flange, y = -56.0 mm, lies 27.0 mm above the tread");
  expect_part(wheel("-70 -10\n-56 -27\n-40 -10\n0 0\n65 3\n"), "turn the sign of z");
  expect_part(wheel("-65 -3\n0 0\n40 10\n56 27\n70 10\n"), place + "the flange is at y = 56.0 mm");
  expect_part(wheel("-65 3\n0 0\n40 -10\n56 -27\n70 -10\n"), "turn both signs");
  expect_part(wheel("0 10\n14 27\n30 10\n70 0\n130 -3\n"),
              place +
                  "y = 0.0 ... 130.0 mm counts from the flange's back, not from the nominal rolling circle; "
                  "wheel.profile_shift = \"-70 mm\" corrects it");
  expect_part(wheel("-70e-3 10e-3\n-56e-3 27e-3\n0 0\n65e-3 -3e-3\n"),
              place + "the points are 0.135 mm wide");
  expect_part(
      wheel("-70 -10\n-56 -27\n-47 -20\n"),
      place + "the points are 23 mm wide; a whole wheel profile has 90 to 200 mm: is the file whole?");
  expect_part(wheel("-70 10\n-56 27\n-57 28\n0 0\n65 -3\n"),
              (folder_ / "wheel.txt").string() + ":4: the first column must grow");
  write("wheel.prw", "point.begin\n1 2\n1 x\npoint.end\n");
  expect_part(scene_error(write("wheel.toml", kBase + "[wheel]\nprofile = \"wheel.prw\"\n")),
              (folder_ / "wheel.prw").string() + ":3: \"1 x\": expected y and z and perhaps a weight");
  write("wheel.whl", "Stock=1\n\n1 2\n3 4\n");
  expect_part(scene_error(write("wheel.toml", kBase + "[wheel]\nprofile = \"wheel.whl\"\n")),
              "wheel.toml:4:1: wheel.profile: " + (folder_ / "wheel.whl").string() +
                  ": 2 points: a profile needs at least 10");
  write("rail.txt", "# y [mm]  z [mm]\n-36 18\n-20 2\n0 0\n20 2\n36 18\n");
  expect_part(scene_error(write("rail.toml", kBase + "[rail]\nprofile = \"rail.txt\"\n")),
              "rail.txt: the head rises to both sides (18.0 mm at y = 36.0 mm), but z counts upwards");
}

TEST_F(Files, TablesOfTwoColumns) {
  const TableRules corrugation{.needs_units = true, .increasing = true};
  const struct {
    std::string text;
    std::string message;
  } cases[] = {
      {"0 0\n1 1\n", ":1: the units are missing: put a line such as \"# x [m]  d [mm]\" before the numbers"},
      {"# x [m] d [kg]\n0 0\n1 1\n", ":1: [kg] is not a length (units: m, cm, mm, um, km)"},
      {"# x [m] d [inch]\n", ":1: unknown unit \"inch\""},
      {"# x [m] d [mm]\n0 0\n1 2 3\n", ":3: expected 2 numbers, found 3 columns"},
      {"# x [m] d [mm]\n0 0\n1\n", ":3: expected 2 numbers, found 1 columns"},
      {"# x [m] d [mm]\n0 0\n0 1\n", ":3: the first column must grow from row to row"},
      {"# x [m] d [mm]\n0 0\n1 nan\n", ":3: \"nan\" is not finite"},
      {"# x [m] d [mm]\n0 0\n1 1e999\n", ":3: \"1e999\" is too large or too small"},
      {"# x [m] d [mm]\n0 0\n1 2mm\n", ":3: \"2mm\" is not a number"},
      {"# x [m] d [mm]\n0 0\n", ": expected at least two rows of numbers"},
      {"# x [m] d [mm]\n1,5;2,5\n",
       ":2: expected 2 numbers, found 4 columns; a comma separates columns: write decimal points, not "
       "commas"},
      {"# x [m] d [mm]\n1,5\t2\n", ":2: expected 2 numbers, found 3 columns; a comma separates columns"},
      {"# x [mm] d [mm]\n# x [m] d [mm]\n0 0\n1 1\n",
       ":2: the units are [m], [mm] here and [mm], [mm] on line 1; leave one of the lines out"},
      {"# x [m] d [mm]\n0 0\n# x [m] d [um]\n1 1\n",
       ":3: the units are [m], [um] here and [m], [mm] on line 1; leave one of the lines out"},
      {"", ": expected at least two rows of numbers"},
  };
  for (const auto& c : cases) {
    const fs::path path = write("table.txt", c.text);
    expect_part(table_error(path, corrugation), path.string() + c.message);
  }
  expect_part(table_error(write("table.txt", "0 0\n1 1\n"), kWebOutline), "such as \"# y [mm]  r [mm]\"");
  EXPECT_EQ(table_error(write("table.txt", "# x [m] d [mm]\n# x [m] d [mm]\n0 0\n# [a] [b]\n1 1\n"), {}), "");
  expect_part(table_error(write("table.txt", std::string("0 0\n\0", 5)), {}),
              "it is a binary file, not text");
  expect_part(table_error(folder_, {}), "it is a directory");
}

TEST_F(Files, IdenticalProblemsAreCounted) {
  std::string text = "# x [m] d [mm]\n";
  for (int i = 0; i < 300; ++i) text += "1 2 3\n";
  const fs::path path = write("table.txt", text);
  EXPECT_EQ(table_error(path, {.needs_units = true}),
            "300 problems\n" + path.string() + ":2: expected 2 numbers, found 3 columns (300 times)");
}

TEST_F(Files, ProfilesAreInMillimetresUnlessTheySayOtherwise) {
  EXPECT_EQ(read_two_columns(write("a.txt", "1;2\n0.5\t-3\n"), {}).second,
            (std::vector<double>{2e-3, -3e-3}));
  EXPECT_EQ(read_two_columns(write("b.txt", "y [m], z [cm]\n1,2\n0,3\n"), {}).second,
            (std::vector<double>{2e-2, 3e-2}));
}

/// Brackets of comments hold no units; those behind the columns' units say nothing.
TEST_F(Files, BracketsOfComments) {
  const TableRules depths{.needs_units = true, .increasing = true, .names = kDepthNames};
  const std::string comment = "# Rail [60E1], measured [2019-03-01], by [X]\n";
  const auto second = [&](const std::string& text, const TableRules& rules) {
    return read_two_columns(write("c.txt", text + "1 2\n2 3\n"), rules).second;
  };
  EXPECT_EQ(second(comment + "# x [m]  d [um]\n", depths), (std::vector<double>{2e-6, 3e-6}));
  EXPECT_EQ(second("# Rail [60E1], measured [2019-03-01]\n", {}), (std::vector<double>{2e-3, 3e-3}));
  EXPECT_EQ(second("# y [m]  z [m]  source [EN 13674]\n", {}), (std::vector<double>{2, 3}));
  expect_part(table_error(write("d.txt", comment + "1 2\n2 3\n"), depths), ":2: the units are missing");
  expect_part(table_error(write("d.txt", "# x [inch]  d [inch]\n1 2\n2 3\n"), depths),
              ":1: unknown unit \"inch\"");
  const std::string inches = "# way [inch]  wear [inch]\n";
  expect_part(table_error(write("d.txt", inches + "1 2\n2 3\n"), depths),
              "before the numbers; [inch], [inch] on line 1 are no units");
  expect_part(table_error(write("d.txt", inches + "1 2\n2 3\n"), {}), ":1: unknown unit \"inch\"");
  EXPECT_EQ(second(inches + "# x [m]  d [um]\n", depths), (std::vector<double>{2e-6, 3e-6}));
  EXPECT_EQ(second("# y [m]  z [m]\n# By [Smith], for [Miller]\n", {}), (std::vector<double>{2, 3}));
  EXPECT_EQ(second("# measured by [Smith], for [Miller]\n", {}), (std::vector<double>{2e-3, 3e-3}));
  EXPECT_EQ(table_error(write("d.txt", "# z [mm]  y [mm]  x [mm]\n1 2\n"), {.names = {{"y"}, {"z"}}}),
            (folder_ / "d.txt").string() +
                ":1: the columns are named z, y; expected y, z in this order: move the columns, and their "
                "names");
}

TEST(SceneErrors, ProblemsCanBeReadOneByOne) {
  try {
    resolve_scene(SceneSource{"x.toml", kBase + "[rail]\nlenght = 3\norigin = 4\n", "."});
    FAIL();
  } catch (const ProblemsError& error) {
    ASSERT_EQ(error.problems.size(), 2u);
    EXPECT_EQ(error.problems[0].key, "rail.lenght");
    EXPECT_EQ(error.problems[1].line, 5);
    EXPECT_EQ(error.code(), ExitCode::input);
  }
}

TEST(SceneErrors, ValidateChecksScenesBuiltInCode) {
  Scene scene;
  scene.rail = RailSpec{};
  scene.rail->support = "free";
  scene.materials["steel"] = {"steel", 205.9e9, 0.3, 7790, 0};
  ASSERT_EQ(validate(scene).size(), 1u);
  EXPECT_EQ(validate(scene)[0].message, "nothing carries a free rail; state scene.gravity = \"0 m/s2\"");
  scene.gravity = 0;
  EXPECT_TRUE(validate(scene).empty());
  Scene misnamed = scene;
  misnamed.materials.at("steel").name = "iron";
  ASSERT_EQ(validate(misnamed).size(), 1u);
  EXPECT_EQ(validate(misnamed)[0].keys.front(), "material.steel");
  scene.materials.at("steel").density = -1;
  ASSERT_EQ(validate(scene).size(), 1u);
  EXPECT_EQ(validate(scene)[0].keys.front(), "material.steel.density");
}

}  // namespace
}  // namespace tread
