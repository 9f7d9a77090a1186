#include "io/scene/unknown_key.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>
#include <utility>

#include "io/scene/key.hpp"
#include "io/scene/schema.hpp"

namespace tread {

namespace {

struct Purpose {
  std::array<std::string_view, 8> words;
  std::string_view instead;
};

constexpr std::array kPurposes = {
    Purpose{{"sleeper", "tie", "ties", "ballast", "ballasted"},
            "[sleepers] holds sleepers on ballast, with stiffness and damping of the bed; leave out [slab]"},
    Purpose{{"support", "hanging", "hanging_sleeper", "broken_clip", "clip", "spacings"},
            "a table [support.NAME] alters one fastening and its sleeper: fastening = 12, bed = 0"},
    Purpose{{"plasticity", "plastic", "yield", "yield_stress", "hardening"},
            "plasticity is a law of a material: law = \"j2\" in [material.NAME]"},
    Purpose{{"gpu", "cuda", "device"}, "a device belongs to the command: --device gpu, or emulated"},
    Purpose{
        {"mpi", "ranks", "nodes"},
        "`mpirun -n 2 tread run` shares a run among processes, -t states the threads, and --launcher runs "
        "the points of a study on a cluster"},
    Purpose{{"threads", "cores"}, "threads belong to the command: -t"},
    Purpose{{"yaw", "angle_of_attack"}, "the axle stays square to the rail"},
    Purpose{{"lateral", "hunting", "lateral_motion"},
            "the wheelset does not move across; wheel.lateral_offset selects the place of contact"},
    Purpose{{"curve", "radius_of_curve", "cant", "superelevation"},
            "the track is straight; wheel.lateral_offset selects the place of contact"},
    Purpose{{"temperature", "thermal", "heat"},
            "there is no temperature; the frictional work of surface.h5 is the heat of a thermal model"},
    Purpose{{"flat", "wheel_flat", "flats", "polygon", "out_of_round", "out_of_roundness"},
            "a table [surface.NAME] with kind = \"flat\", \"polygon\" or \"profile\" makes the wheel out of "
            "round"},
    Purpose{{"weld", "joint", "squat", "dent", "defect", "dip", "irregularity", "alignment"},
            "a table [surface.NAME] with kind = \"dip\", \"dent\", \"waves\", \"profile\" or \"map\" shapes "
            "the rail"},
    Purpose{{"roughness"}, "[corrugation] with kind = \"random\" makes a roughness"},
    Purpose{{"probe", "probes", "sensor", "sensors", "accelerometer"},
            "a probe has a table of its own, [probe.NAME], with body, x, y, depth and quantity"},
    Purpose{{"bogie", "car", "carbody", "primary_suspension"},
            "[vehicle] holds one sprung mass on a suspension"},
    Purpose{{"mass_scaling"},
            "masses are not scaled; scene.precision = \"mixed\" or larger elements are faster"},
    Purpose{{"mesh", "nodes_file", "elements", "import"},
            "a table [body.NAME] puts the mesh of a file in place of the wheel's disc or of the rail below "
            "its head; the other bodies are swept from profiles, scene.element_size sets their mesh"},
    Purpose{{"export", "keyword", "lsdyna", "ls_dyna"},
            "`tread export` writes a keyword deck, `tread mesh -o DIR` nodes and hexahedra as VTKHDF"},
    Purpose{{"switch", "turnout", "crossing", "transition", "bridge"},
            "the rail's section is the same along the track; tables [support.NAME] alter single supports"},
    Purpose{{"wheelset", "axle", "brake_discs", "web"},
            "the wheelset is a flexible half; wheel.web_thickness, web_offset, web_wave, web and "
            "brake_rings shape it"},
    Purpose{{"wear", "growth"}, "`tread develop` wears the rail, with the keys of [wear]"},
    Purpose{{"crack", "cracks", "fatigue", "residual_stress"},
            "there are no cracks; surface.h5 and the frames hold the stresses for a criterion of your own"},
    Purpose{{"wet", "adhesion", "third_body", "sand", "lubrication"},
            "contact.friction_law = \"falling\" or \"table\" states f; there is no film and no layer"},
    Purpose{{"spin", "spin_creepage"}, "spin follows from profiles and inclination"},
    Purpose{{"receptance", "impact_hammer"}, "[hammer] strikes the rail; the report shows the receptance"},
    Purpose{{"spectrum", "spectra", "fft", "octave"},
            "the report shows the spectrum of F_N, summary.json its one-third octaves; `tread roughness` and "
            "`tread develop` leave those of surfaces"},
    Purpose{{"noise", "acoustic", "sound"},
            "there is no noise; the frames hold the surface velocities of an acoustic model"},
    Purpose{{"implicit", "solver"},
            "the preload is implicit, the rolling explicit; `tread multibody` for long ways"},
    Purpose{{"restart", "continue"},
            "`tread resume DIR` goes on with a run, `tread run --from DIR` begins with its state"},
    Purpose{{"axle_load", "axleload", "static_load"},
            "vehicle.sprung_mass sets it: half the axle load is the weight of sprung mass, unsprung mass and "
            "the half wheelset; `tread check` shows both"},
    Purpose{{"velocity", "train_speed", "vehicle_speed"}, "motion.speed is the wheel's forward speed"},
    Purpose{{"mu", "friction_coefficient", "coefficient_of_friction", "cof"},
            "contact.friction is the coefficient of friction, motion.traction.mu the traction coefficient"},
    Purpose{{"penalty", "penalty_stiffness", "contact_stiffness"},
            "contact.penetration_ratio sets the penalty stiffness"},
    Purpose{{"wheel.radius", "wheel_radius"}, "wheel.diameter is twice the wheel's radius"},
    Purpose{{"gauge", "track_gauge"},
            "the model is half a track and has no gauge; wheel.lateral_offset selects the place of contact"},
    Purpose{{"sleepers.pitch", "fastenings.pitch", "sleeper_spacing", "fastening_spacing"},
            "fastenings.spacing is the distance of the fastenings and of their sleepers"},
    Purpose{{"pad_stiffness", "pad_damping", "pad", "railpad"},
            "fastenings.stiffness and fastenings.damping are those of a fastening with its pad"},
    Purpose{{"amplitude"}, "the depth is twice the amplitude: corrugation.depth, or depth of [surface.NAME]"},
    Purpose{{"time_step", "timestep", "dt"}, "the time step is motion.step_safety times the stable step"},
    Purpose{{"uic60", "s49"}, "UIC 60 is rail.profile = \"60E1\", S 49 is \"49E1\""},
};

/// Names that a scene gives to its tables, by the start of their paths.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kOwnNames = {
    {{kMaterialTables, "a material's name"},
     {kZoneTables, "a zone's name"},
     {kSupportTables, "a support's name"},
     {kSurfaceTables, "the name of a surface's depth"},
     {kBodyTables, "a body's name"},
     {kProbeTables, "a probe's name"}}};

/// instead_of() the path, or the first part of it that has an answer, among those below all known tables.
std::string instead_of_part(std::string_view path) {
  std::string found = instead_of(path);
  if (!found.empty()) return found;
  for (; !path.empty() && !is_table(path); path = table_above(path))
    if (std::string instead = instead_of(path.substr(path.rfind('.') + 1)); !instead.empty()) found = instead;
  return found;
}

}  // namespace

std::string instead_of(std::string_view word) {
  const auto same = [](unsigned char typed, unsigned char known) { return std::tolower(typed) == known; };
  for (const Purpose& purpose : kPurposes)
    for (const std::string_view known : purpose.words)
      if (!known.empty() && std::equal(word.begin(), word.end(), known.begin(), known.end(), same))
        return fmt::format("{} (see can-and-cannot.md)", purpose.instead);
  return "";
}

std::string unknown_key(const std::string& path, bool is_a_table, bool suggest) {
  const std::string parent(table_above(path));
  for (const auto& [tables, name] : kOwnNames)
    if (parent + "." == tables) return fmt::format("{} consists of letters, digits, _ and -", name);
  const std::string what = is_a_table ? "table" : "key";
  if (const std::optional<SceneTable> table = table_of(parent);
      table && path == table->name + ".present" && !table->removable())
    return fmt::format("unknown {}: [{}] is always there and cannot be left out", what, parent);
  if (const std::string instead = instead_of_part(path); !instead.empty())
    return fmt::format("unknown {}: {}", what, instead);
  const std::string similar = suggest ? similar_path(path) : "";
  if (!similar.empty()) return fmt::format("unknown {} (did you mean {}?)", what, similar);
  return fmt::format("unknown {} (known: {})", what, names_in(is_table(parent) ? parent : ""));
}

std::string not_a_table(const std::string& path, const std::string& got) {
  const std::optional<SceneTable> table = table_of(path);
  const bool removable = table && table->removable() && table->name == path;
  return fmt::format("expected a table with keys among {}; got {}{}", names_in(path), got,
                     removable ? fmt::format(" (to leave it out, write {}.present = false)", path) : "");
}

std::string needs_name(std::string_view tables) {
  for (const auto& [known, name] : kOwnNames)
    if (tables == known)
      return fmt::format("the table needs a name: write [{}NAME]; {} consists of letters, digits, _ and -",
                         tables, name);
  return "";
}

}  // namespace tread
