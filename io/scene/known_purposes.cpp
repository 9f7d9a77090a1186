#include "io/scene/known_purposes.hpp"

#include <array>

namespace tread {

namespace {

struct Purpose {
  std::array<std::string_view, 8> words;
  std::string_view instead;
};

constexpr std::array kPurposes = {
    Purpose{{"sleeper", "sleepers", "tie", "ties", "ballast", "ballasted"},
            "there are no sleepers; leave out [slab] and let fastenings.stiffness and fastenings.damping be "
            "those of "
            "pad and bed in series"},
    Purpose{{"plasticity", "plastic", "yield", "yield_stress", "hardening"},
            "plasticity is a law of a material: law = \"j2\" in [material.NAME]"},
    Purpose{{"gpu", "cuda", "device"}, "there is no GPU; -t states the threads of the processor"},
    Purpose{{"mpi", "ranks", "nodes"},
            "there is no MPI; -t states the threads, and a study's points run by themselves"},
    Purpose{{"threads", "cores"}, "threads belong to the command: -t"},
    Purpose{{"yaw", "angle_of_attack"}, "the axle stays square to the rail"},
    Purpose{{"lateral", "hunting", "lateral_motion"},
            "the wheelset does not move across; wheel.lateral_offset selects the place of contact"},
    Purpose{{"curve", "radius_of_curve", "cant", "superelevation"},
            "the track is straight; wheel.lateral_offset selects the place of contact"},
    Purpose{{"temperature", "thermal", "heat"},
            "there is no temperature; the frictional work of surface.h5 is the heat of a thermal model"},
    Purpose{{"flat", "wheel_flat", "flats", "polygon", "out_of_round", "out_of_roundness"},
            "the wheel is round; corrugation.kind = \"table\" puts the depth on the rail, once a turn"},
    Purpose{{"weld", "joint", "squat", "dent", "defect", "dip", "roughness", "irregularity"},
            "[corrugation] with kind = \"table\" reads depths along the rail, kind = \"random\" makes a "
            "roughness"},
    Purpose{{"probe", "probes", "sensor", "sensors"},
            "there are no probes; output.frames writes the surfaces, histories are those of results.md"},
    Purpose{{"bogie", "car", "carbody", "primary_suspension"},
            "[vehicle] holds one sprung mass on a suspension"},
    Purpose{{"mass_scaling"},
            "masses are not scaled; scene.precision = \"mixed\" or larger elements are faster"},
    Purpose{{"mesh", "nodes_file", "elements"},
            "bodies are swept from profiles; scene.element_size sets the mesh"},
};

}  // namespace

std::string_view instead_of(std::string_view word) {
  for (const Purpose& purpose : kPurposes)
    for (const std::string_view known : purpose.words)
      if (!known.empty() && known == word) return purpose.instead;
  return "";
}

}  // namespace tread
