#include "io/scene/scene_library.hpp"

namespace tread {

namespace {

constexpr std::string_view kTable1 = "Table 1";
constexpr std::string_view kText = "section 2.1.1";
constexpr std::string_view kVertical = "section 2.1.1: the fastenings \"can only move vertically\"";
constexpr std::string_view kNegligible = "section 2.1.2: the gain of speed under traction \"is negligible\"";
constexpr std::string_view kCorrugation = "section 2.3, corrugation D";
constexpr std::string_view kPad = "rail pad of the fastening WJ-7";
constexpr std::string_view kSlab = "half of a CRTS II slab, 6.45 m x 2.55 m x 0.2 m";
constexpr std::string_view kChosen = "chosen here, not stated there";

LibraryEntry highspeed_slab_2014() {
  return {"highspeed-slab-2014",
          "",
          "Half a wheelset on half a slab track of a Chinese high-speed line: X. Zhao, Z.F. Wen, H.Y. Wang, "
          "X.S. Jin, "
          "M.H. Zhu, Modeling of high-speed wheel-rail rolling contact on a corrugated rail and corrugation "
          "development, "
          "Journal of Zhejiang University-SCIENCE A 15 (2014) 946-963. Tables and sections named as sources "
          "are this "
          "paper's.",
          {
              {"scene.gravity", "9.81 m/s2", "standard gravity"},
              {"solution_zone.start", "2.4 m", "section 3.1, distance AB"},
              {"solution_zone.length", "0.6 m", kChosen},
              {"material.steel.youngs_modulus", "205.9 GPa", kTable1},
              {"material.steel.poissons_ratio", "0.3", kTable1},
              {"material.steel.density", "7790 kg/m3", kTable1},
              {"material.steel.damping", "{ kind = \"high_frequency_fraction\", value = 1e-4 }",
               "Table 1, read as a fraction of critical damping"},
              {"material.slab.youngs_modulus", "34.5 GPa", kTable1},
              {"material.slab.poissons_ratio", "0.25", kTable1},
              {"material.slab.density", "2400 kg/m3", kTable1},
              {"material.gap_filler.youngs_modulus", "29.5 GPa", kTable1},
              {"material.gap_filler.poissons_ratio", "0.25", kTable1},
              {"material.gap_filler.density", "2400 kg/m3", kTable1},
              {"material.mortar.youngs_modulus", "8 GPa", kTable1},
              {"material.mortar.poissons_ratio", "0.2", kTable1},
              {"material.mortar.density", "1600 kg/m3", kTable1},
              {"wheel.shape", "half_wheelset", kText},
              {"wheel.profile", "LMA", kText},
              {"wheel.diameter", "0.86 m", kTable1},
              {"wheel.lateral_offset", "6.5 mm",
               "gauge 1435 mm, wheels 1353 mm back to back, upright rail; 6 mm on 1:40"},
              {"wheel.mass", "586 kg", kTable1},
              {"wheel.brake_rings", "false", kChosen},
              {"wheel.axle_bore", "60 mm", kChosen},
              {"rail.profile", "CN60", kText},
              {"rail.inclination", "1:40", kText},
              {"rail.length", "15.2 m", kText},
              {"rail.origin", "6.1 m", kChosen},
              {"rail.support", "fastenings", kText},
              {"fastenings.count", "24", kText},
              {"fastenings.spacing", "0.65 m", "Fig. 1"},
              {"fastenings.first", "0.125 m", kChosen},
              {"fastenings.stiffness", "22 MN/m", kTable1},
              {"fastenings.damping", "200 kN s/m", kTable1},
              {"fastenings.pad_length", "0.17 m", kPad},
              {"fastenings.pad_width", "0.15 m", kPad},
              {"fastenings.columns", "3", kText},
              {"fastenings.rows", "4", kText},
              {"fastenings.along", "held", kVertical},
              {"fastenings.across", "held", kVertical},
              {"fastenings.held_at", "pad", kChosen},
              {"slab.pitch", "6.5 m", "Fig. 2, read as slab and gap together"},
              {"slab.gap", "50 mm", "Fig. 2"},
              {"slab.first_gap", "0 m", kChosen},
              {"slab.width", "1.275 m", kSlab},
              {"slab.thickness", "0.2 m", kSlab},
              {"slab.mortar_thickness", "30 mm", "usual thickness of the CRTS II mortar"},
              {"slab.offset", "0 m", kChosen},
              {"vehicle.sprung_mass", "8000 kg", kTable1},
              {"vehicle.unsprung_mass", "340 kg", kTable1},
              {"vehicle.suspension_stiffness", "880 kN/m", kTable1},
              {"vehicle.suspension_damping", "4 kN s/m", kTable1},
              {"vehicle.longitudinal", "carried", kNegligible},
              {"contact.friction", "0.5", kTable1},
              {"motion.speed", "300 km/h", "section 3.2"},
              {"motion.duration", "0.04 s", "section 2.1.2"},
              {"motion.traction.ramp", "5 ms", "section 3.2, T1"},
              {"corrugation.present", "false", "smooth unless the scene has the table"},
              {"corrugation.kind", "sine", "eqs. (6), (7)"},
              {"corrugation.wavelength", "80 mm", kCorrugation},
              {"corrugation.depth", "0.14 mm", kCorrugation},
              {"corrugation.width", "30 mm", kCorrugation},
              {"corrugation.start", "2.4 m", "section 2.3"},
              {"corrugation.length", "0.56 m", "whole waves inside the solution zone"},
              {"corrugation.apply", "nodes", kText},
          }};
}

LibraryEntry highspeed_slab_2014_calibrated() {
  return {"highspeed-slab-2014-calibrated",
          "highspeed-slab-2014",
          "highspeed-slab-2014 with two other values, chosen for the paper's forces over corrugation D "
          "([the paper's figures](../records/paper.md)).\nThe paper does not state the wheel's place at the "
          "start.",
          {
              {"fastenings.damping", "100 kN s/m", "fits F_N over corrugation D; Table 1: 200 kN s/m"},
              {"rail.origin", "6.4625 m", "fits F_N over corrugation D; not stated there"},
          }};
}

LibraryEntry highspeed_slab_2014_thin_web() {
  constexpr std::string_view kWeb = "keeps contact at 500 km/h over 0.18 mm, as in Fig. 28; not stated there";
  return {"highspeed-slab-2014-thin-web",
          "highspeed-slab-2014",
          "highspeed-slab-2014 with other values, chosen for most of the paper's conclusions at once "
          "([the paper's figures](../records/paper.md)).",
          {
              {"fastenings.damping", "50 kN s/m", "fits the shift at 100 km/h; Table 1: 200 kN s/m"},
              {"rail.origin", "6.4625 m", "fits F_N over corrugation D; not stated there"},
              {"wheel.web_thickness", "25 mm", kWeb},
              {"wheel.brake_rings", "true", "makes up the mass of 586 kg"},
          }};
}

LibraryEntry ballasted_cn60() {
  constexpr std::string_view kTrack = "Table 1 of the paper named above";
  return {"ballasted-cn60",
          "highspeed-slab-2014",
          "A ballasted track with CN60 rails and concrete sleepers of 2.6 m.\nTrack values: Study on "
          "Transmission "
          "Characteristics of Vertical Rail Vibrations in Ballast Track, Mathematical Problems in "
          "Engineering 2017, "
          "5872419.\nIts loss factors became the dashpots that lose as much at the frequency named.",
          {
              {"slab.present", "false", "ballasted"},
              {"material.concrete.youngs_modulus", "35 GPa", "concrete of the class C50/60"},
              {"material.concrete.poissons_ratio", "0.2", "concrete"},
              {"material.concrete.density", "2400 kg/m3", "concrete"},
              {"rail.origin", "6.15 m", "the wheel starts over fastening 12"},
              {"fastenings.count", "28", "as many as the rail takes"},
              {"fastenings.spacing", "0.55 m", kTrack},
              {"fastenings.first", "0.1 m", kChosen},
              {"fastenings.stiffness", "225 MN/m", kTrack},
              {"fastenings.damping", "9 kN s/m", "Table 1, loss factor 0.25, at 1 kHz"},
              {"fastenings.along", "elastic", "the ballast yields along the track"},
              {"fastenings.along_stiffness", "8.25 MN/m",
               "half of a loaded track, 60 kN/m at 2 mm (UIC 774-3), by the spacing"},
              {"fastenings.along_damping", "13 kN s/m", "as the bed: loss factor 1, at 100 Hz"},
              {"sleepers.width", "0.275 m", kTrack},
              {"sleepers.length", "1.3 m", "half of a sleeper of 2.6 m"},
              {"sleepers.height", "0.198 m", "Table 1, 170 kg by half sleeper"},
              {"sleepers.offset", "-0.1025 m", "rails 1505 mm apart"},
              {"sleepers.stiffness", "20 MN/m", kTrack},
              {"sleepers.damping", "32 kN s/m", "Table 1, loss factor 1, at 100 Hz"},
              {"motion.speed", "140 km/h", kChosen},
              {"motion.duration", "80 ms", "past the solution zone"},
          }};
}

LibraryEntry ballasted_60e1() {
  return {"ballasted-60e1",
          "ballasted-cn60",
          "The same ballasted track with rails 60E1 (EN 13674-1) and a wheel S1002 (EN 13715).",
          {
              {"rail.profile", "60E1", "EN 13674-1"},
              {"rail.section", "60E1", "EN 13674-1"},
              {"wheel.profile", "S1002", "EN 13715"},
              {"wheel.diameter", "920 mm", "usual for coaches"},
              {"wheel.lateral_offset", "5 mm",
               "wheels 1360 mm back to back, gauge 1435 mm: 3 mm on 1:40; 2 mm more, away from a jump of the "
               "contact"},
          }};
}

}  // namespace

const std::vector<LibraryEntry>& scene_library() {
  static const std::vector<LibraryEntry> library{highspeed_slab_2014(), highspeed_slab_2014_calibrated(),
                                                 highspeed_slab_2014_thin_web(), ballasted_cn60(),
                                                 ballasted_60e1()};
  return library;
}

std::string library_names() {
  std::string names;
  for (const LibraryEntry& entry : scene_library())
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  return names;
}

const LibraryEntry* find_library_entry(std::string_view name) {
  for (const LibraryEntry& entry : scene_library()) {
    if (entry.name == name) return &entry;
  }
  return nullptr;
}

}  // namespace tread
