#pragma once
// The user's request as plain data in SI units. io fills it, drivers build the model from it. An absent
// optional is a part that the scene does not contain and does not pay for.

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/body_spec.hpp"
#include "core/material.hpp"
#include "core/math/elastic_pair.hpp"
#include "core/surface_spec.hpp"

namespace tread {

/// [wheel]
struct WheelSpec {
  std::string shape = "half_wheelset";  ///< "half_wheelset" or "tyre" (a ring: profile of one arc)
  std::string material = "steel";       ///< one of Scene::materials
  std::string profile = "LMA";          ///< built in ("LMA", "S1002"), "arc", "cylinder", or a file
  double diameter = 0.86;               ///< [m]
  double lateral_offset = 6.5e-3;  ///< rail centre line in wheel coordinates, positive to the field side [m]
  double mass = 586;               ///< mass that web or brake rings are sized to reach [kg] (half_wheelset)
  std::optional<double>
      web_thickness;         ///< absent: by the mass, or 30 mm with brake rings [m] (half_wheelset)
  bool brake_rings = false;  ///< two plates on the web, sized by the mass (half_wheelset)
  double web_offset =
      0;                ///< of the web at the rim to the field side of the web at the hub [m] (half_wheelset)
  double web_wave = 0;  ///< of an S-shaped web to either side [m] (half_wheelset)
  std::string web = "stated";  ///< by the keys above, or a file of its outline (half_wheelset)
  std::vector<double> web_y;   ///< of the file, to the field side of the nominal rolling circle [m]
  std::vector<double> web_r;   ///< of the file, from the axis [m]
  double axle_bore = 0.060;    ///< bore of the hollow axle [m] (half_wheelset)
  double crown_radius = 0.43;  ///< lateral radius of the profile "arc" [m] (tyre)
  double width = 0.060;        ///< width of the ring [m] (tyre)
  double thickness = 0.060;    ///< radial thickness of the ring [m] (tyre)
  std::string bore = "free";   ///< of a tyre: "free" or "guided" (rigid, moves at the motion's speed)
  /// Tread of a guided tyre beyond the run, before and behind it; absent: the whole ring. [m]
  std::optional<double> overhang;
  double profile_shift = 0;       ///< added to y of the profile's file [m]
  double profile_smoothing = 0;   ///< largest deviation of a spline from the file's points; 0: none [m]
  std::vector<double> profile_y;  ///< of the profile's file, growing, to the field side [m]
  std::vector<double> profile_z;  ///< towards the flange tip [m]
  std::string profile_reading;    ///< sentence on what the file holds and what was changed
};

/// [rail]
struct RailSpec {
  std::string material = "steel";      ///< one of Scene::materials
  std::string head_material;           ///< of the finely divided head; empty: `material`
  std::string profile = "CN60";        ///< built in ("CN60", "60E1" ...), "box", or a file of a head
  std::string section = "CN60";        ///< built-in rail that a head from a file belongs to
  double inclination = 1.0 / 40;       ///< [-]
  double length = 15.2;                ///< [m]
  double origin = 6.1;                 ///< distance of x = 0 from the left end [m]
  std::string support = "fastenings";  ///< "fastenings", "rigid" (bottom fixed) or "free" (no support)
  double width = 0.060;                ///< [m] (box)
  double height = 0.060;               ///< [m] (box)
  double crown_radius = 0;             ///< radius of the running surface across the rail, 0 = flat [m] (box)
  double profile_shift = 0;            ///< added to y of the profile's file [m]
  bool profile_mirrored = false;       ///< y of the profile's file changes its sign, before the shift
  double profile_smoothing = 0;        ///< largest deviation of a spline from the file's points; 0: none [m]
  std::vector<double> profile_y;       ///< of the profile's file, growing, to the field side [m]
  std::vector<double> profile_z;       ///< upwards [m]
  std::string profile_reading;         ///< sentence on what the file holds and what was changed
};

/// Hold of the fastenings on the rail's foot in a horizontal direction.
struct FootHold {
  std::string kind = "held";  ///< "held", "free" or "elastic"
  double stiffness = 0;       ///< elastic: of one fastening, to the ground [N/m]
  double damping = 0;         ///< elastic: of one fastening, to the ground [N s/m]
};

/// [support.NAME], or a row of the file `fastenings.supports`: one fastening, and the sleeper under it, that
/// differs from the others
struct SupportSpec {
  int fastening = 1;                   ///< counted along x from 1
  double shift = 0;                    ///< of fastening and sleeper along x [m]
  double stiffness = 1;                ///< of the fastening, vertical, over that of the others [-]
  std::optional<double> damping = {};  ///< likewise; absent: 1, or 0 where the stiffness is 0 [-]
  double bed = 1;     ///< stiffness and damping of the sleeper's bed over those of the others [-]
  bool holds = true;  ///< the rail's foot along and across, as the others do

  /// Vertical damping of the fastening over that of the others [-].
  double damping_share() const { return damping.value_or(stiffness > 0 ? 1.0 : 0.0); }

  bool operator==(const SupportSpec&) const = default;
};

/// [fastenings]
struct FasteningSpec {
  int count = 24;
  double spacing = 0.65;     ///< [m]
  double first = 0.125;      ///< distance of the first from the rail's left end [m]
  double stiffness = 22e6;   ///< of one fastening, vertical [N/m]
  double damping = 200e3;    ///< of one fastening, vertical [N s/m]
  double pad_length = 0.17;  ///< along x: the columns stand at the thirds' centres [m]
  double pad_width = 0.15;   ///< across: the rows stand at the quarters' centres [m]
  int columns = 3;           ///< spring-dampers along x
  int rows = 4;              ///< spring-dampers across
  FootHold along;            ///< of the foot's motion along x
  FootHold across;           ///< of the foot's motion along y
  /// Where "held" acts: "pad", all of the foot over the pad, or "springs", the foot's nodes nearest to the
  /// spring-dampers.
  std::string held_at = "pad";
  std::string supports = "alike";   ///< or a file of those that differ, a row each
  std::vector<SupportSpec> listed;  ///< its rows, in ascending order of the fastenings

  /// Distance of a column from the middle of its fastening [m].
  double column_offset(int column) const { return pad_length * ((column + 0.5) / columns - 0.5); }
  /// Distance of a row from the middle of the foot [m].
  double row_offset(int row) const { return pad_width * ((row + 0.5) / rows - 0.5); }
};

/// [slab]; without it the fastenings stand on rigid ground
struct SlabSpec {
  /// Materials of slab, gaps and mortar, each one of Scene::materials.
  std::string material = "slab";
  std::string gap_material = "gap_filler";
  std::string mortar_material = "mortar";
  double pitch = 6.5;              ///< slab and gap together [m]
  double gap = 0.05;               ///< [m]
  double first_gap = 0;            ///< distance of the first gap's centre from the rail's left end [m]
  double width = 1.275;            ///< of the half track [m]
  double thickness = 0.20;         ///< [m]
  double mortar_thickness = 0.03;  ///< [m]
  double offset = 0;               ///< y of the slab's middle from the rail's centre line [m]
};

/// [sleepers]: one under each fastening, half of it on this side of the track's middle, on ballast
struct SleeperSpec {
  std::string material = "concrete";  ///< one of Scene::materials
  double width = 0.26;                ///< along x [m]
  double length = 1.3;                ///< of the half, across [m]
  double height = 0.2;                ///< [m]
  double offset = -0.1;               ///< y of the half's middle from the rail's centre line [m]
  double stiffness = 50e6;            ///< of the bed under the half, vertical [N/m]
  double damping = 50e3;              ///< of the bed under the half, vertical [N s/m]
};

/// [vehicle]
struct VehicleSpec {
  double sprung_mass = 8000;            ///< M_c [kg]
  double unsprung_mass = 340;           ///< M_a, attached to the wheelset [kg]
  double suspension_stiffness = 880e3;  ///< K [N/m]
  double suspension_damping = 4e3;      ///< C [N s/m]
  /// Motion of M_c along x: "carried" rigidly with the journal, or "free", without inertia along x.
  std::string longitudinal = "carried";

  /// Mass that moves along x with the wheelset [kg].
  double mass_along() const { return unsprung_mass + (longitudinal == "carried" ? sprung_mass : 0); }
};

/// [load]: a force pressed on the wheel instead of a vehicle
struct LoadSpec {
  double wheel_load = 0;  ///< downward force on the wheel's bore or journal [N]
};

/// [contact]
struct ContactSpec {
  std::string friction_law = "coulomb";  ///< "coulomb", "table" or "falling"
  double friction = 0.5;                 ///< coefficient of friction f; falling: without slip [-]
  double friction_fast = 0.2;            ///< falling: f of fast slip [-]
  double friction_speed = 5.0 / 3;       ///< falling: slip speed that leaves 1/e of the fall [m/s]
  double friction_memory = 0;            ///< falling: sliding length over which f follows the slip speed [m]
  std::string friction_file;             ///< table: two columns, x from `friction_start` and f
  double friction_start = 0;             ///< table: x of its zero [m]
  std::vector<double> friction_x;        ///< table: increasing [m]
  std::vector<double> friction_at_x;     ///< table: f there [-]
  /// Penetration / Hertz approach under the static wheel load; absent: the stiffest penalty that the mesh
  /// bears. [-]
  std::optional<double> penetration_ratio;
  /// Corrugation depth that the searched surface has room for; absent: what the scene itself needs. [m]
  std::optional<double> depth_room;
  std::string surface = "exact";  ///< "exact" (profile curves) or "facets"
  int points = 3;                 ///< integration points per face and direction

  /// The largest coefficient of friction that the law knows: what a patch can transmit at the most [-].
  double largest_friction() const { return friction_range().second; }
  /// The least that the law knows: all that a sliding patch may transmit [-].
  double least_friction() const { return friction_range().first; }
  /// Throws the InputError for a law that does not exist.
  [[noreturn]] void refuse_friction_law() const;

 private:
  std::pair<double, double> friction_range() const;  ///< InputError for a law without one
};

/// [motion]; absent: the scene ends with its static state
struct MotionSpec {
  double speed = 300 / 3.6;               ///< [m/s]
  double duration = 0.04;                 ///< from the start on [s]
  std::optional<double> run_up;           ///< from the start to the solution zone; absent: start at x = 0 [m]
  std::optional<double> traction_mu;      ///< target traction coefficient; negative brakes [-]
  std::optional<double> traction_torque;  ///< M_max on the axle [N m]; one of the two at the most
  double ramp = 5e-3;                     ///< T1; 0: the torque has long acted at the start [s]
  std::string ramp_shape = "linear";      ///< or "smooth": half a cosine
  int reversals = 0;  ///< times that the full torque then turns into its opposite, each in 2 T1
  bool spin_in_preload = true;
  double creepage = 0;  ///< of the wheel at t = 0, relative to free rolling; -2: locked [-]
  /// Motion at t = 0: of "rigid" bodies, with the static deflection "moving" along, or of a wheel that has
  /// been "rolling" over the fastenings; "auto": rolling on fastenings, else moving.
  std::string start = "auto";
  double step_safety = 0.95;  ///< fraction of the computed stable step

  /// Spin over that of free rolling. [theory.md, eq. 13]
  static double spin_ratio(double creepage) { return (1 + 0.5 * creepage) / (1 - 0.5 * creepage); }
  double spin_ratio() const { return spin_ratio(creepage); }

  /// Torque over the full torque, -1 to 1, at a time [s].
  double torque_share(double time) const {
    if (ramp <= 0) return 1;
    const double turns = std::min(0.5 * std::max(time / ramp - 1, 0.0), 1.0 * reversals);
    const double done = std::floor(turns);
    const double sign = std::fmod(done, 2) == 0 ? 1 : -1;
    const bool growing = time < ramp;
    const double part = growing ? time / ramp : turns - done;
    const double share = ramp_shape == "smooth" ? 0.5 * (1 - std::cos(std::numbers::pi * part)) : part;
    return growing ? share : sign * (1 - 2 * share);
  }
};

/// [corrugation]
struct CorrugationSpec {
  std::string kind = "sine";        ///< "sine" (eqs. 6 and 7), "table", "map" or "random"
  double wavelength = 0.08;         ///< L [m]
  double depth = 0.14e-3;           ///< d_m [m]
  double width = 30e-3;             ///< W: depth is zero beyond |y - centre| = W [m]
  double start = 2.4;               ///< x_s [m]
  double length = 0.56;             ///< whole waves that fit are cut [m]
  std::optional<double> centre;     ///< y of the deepest line; absent: the preload's pressure maximum [m]
  double rms = 2e-6;                ///< of random depths [m]
  double shortest = 0.02;           ///< of their waves [m]
  double longest = 0.15;            ///< of their waves [m]
  int seed = 1;                     ///< that draws their phases
  std::string apply = "nodes";      ///< "nodes" (moved nodes) or "gap" (added to the contact gap)
  std::string file;                 ///< table: x from `start` and depth; map: x, y from `centre` and depth
  std::vector<double> table_x;      ///< [m]
  std::vector<double> map_y;        ///< of a map [m]
  std::vector<double> table_depth;  ///< positive downwards; of a map: a row of x for each y [m]

  bool in_file() const { return kind == "table" || kind == "map"; }
  /// Shortest wave of depths that are not in a file [m].
  double shortest_wave() const { return kind == "random" ? shortest : wavelength; }
};

/// [wear]: how passages change the rail's profile
struct WearSpec {
  double coefficient = 2.5e-9;  ///< mass worn off per frictional work [kg/(N m)]
  double change = 0.05;         ///< of the depth by one simulated passage, at the most [-]
  double shortest = 0.03;       ///< wavelength that wears [m]
  double longest = 0.15;        ///< wavelength that wears [m]
  bool across = false;          ///< each row of the running surface wears by itself
};

/// [pulse]: an initial velocity along x over one end of a bar (a box rail without a wheel)
struct PulseSpec {
  double velocity = 0;  ///< [m/s]
  double length = 0;    ///< [m]
};

/// [hammer]: a blow on the rail head, a half sine of downward force from t = 0 on
struct HammerSpec {
  double position = 0;  ///< x of the struck point [m]
  double force = 0;     ///< largest [N]
  double duration = 0;  ///< of the half sine [s]

  double force_at(double time) const {
    return time < duration ? force * std::sin(std::numbers::pi * time / duration) : 0.0;
  }
};

/// [forks]: a state is kept that other runs begin with
struct ForkSpec {
  /// Absent: 20 mm before the patch meets the corrugation, or the solution zone of a smooth rail. [s]
  std::optional<double> at;
};

/// [zone.NAME]
struct ZoneSpec {
  double start = 0;     ///< [m]
  double length = 0.1;  ///< [m]

  double end() const { return start + length; }  ///< [m]
};

/// [probe.NAME]: a point of a body whose motion or stress the histories hold
struct ProbeSpec {
  std::string body = "rail";        ///< "rail", "wheel" (a point that turns with the wheel) or "axle_box"
  double x = 0;                     ///< of the rail's point, or where the wheel's point meets the rail [m]
  double y = 0;                     ///< across, from the rail's centre line [m]
  double depth = 0;                 ///< below the running surface [m]
  std::string quantity = "motion";  ///< "motion", "stress" or "all"

  bool has_motion() const { return quantity != "stress"; }
  bool has_stress() const { return quantity != "motion"; }
  bool operator==(const ProbeSpec&) const = default;
};

/// [output]
struct OutputSpec {
  double history_interval = 1e-5;      ///< [s]
  double progress_interval = 2;        ///< wall clock [s]
  double checkpoint_interval = 600;    ///< wall clock [s]
  bool fastening_forces = false;       ///< of each fastening, in the histories
  std::optional<double> stress_depth;  ///< down to which the histories hold the stress under the patch [m]
  int frames = 40;                     ///< for ParaView; 0: none
  std::string frame_cells = "faces";   ///< "faces" or "elements"
  std::optional<double> disk_limit;    ///< of the run's folder [B]
};

/// [stop]: what ends a run before its duration, besides errors
struct StopSpec {
  int steps = 0;                      ///< that a run may take; 0: any number
  std::optional<double> wall_time;    ///< of one process [s]
  std::optional<double> penetration;  ///< [m]
};

struct Scene {
  std::string title;
  std::string quality = "draft";     ///< "draft", "standard" or "paper"
  std::string precision = "double";  ///< of nodal fields and elements: "double", "mixed" or "single"
  double zone_start = 2.4;           ///< solution zone [m]
  double zone_length = 0.6;          ///< [m]
  double zone_margin = 2.5;          ///< way beside each zone with the approach pitch [m]
  std::map<std::string, ZoneSpec, std::less<>> zones;  ///< other finely divided parts of the rail, by name
  double gravity = 9.81;                               ///< [m/s2]
  bool plane_strain = false;                           ///< nothing moves across: a slice of wide bodies
  std::optional<double> element_size;                  ///< overrides the quality's contact element size [m]

  std::map<std::string, Material, std::less<>> materials;  ///< by Material::name

  std::optional<WheelSpec> wheel;
  std::optional<RailSpec> rail;
  std::optional<FasteningSpec> fastenings;
  std::optional<SlabSpec> slab_track;
  std::optional<SleeperSpec> sleepers;
  std::map<std::string, SupportSpec, std::less<>> supports;  ///< by name; of different fastenings
  std::optional<VehicleSpec> vehicle;
  std::optional<LoadSpec> load;
  std::optional<ContactSpec> contact;
  std::optional<MotionSpec> motion;
  std::optional<CorrugationSpec> corrugation;
  std::map<std::string, SurfaceSpec, std::less<>> surfaces;  ///< by name
  std::map<std::string, BodySpec, std::less<>> bodies;       ///< by name
  std::optional<WearSpec> wear;
  std::optional<PulseSpec> pulse;
  std::optional<HammerSpec> hammer;
  std::optional<ForkSpec> forks;
  std::map<std::string, ProbeSpec, std::less<>> probes;  ///< by name
  OutputSpec output;
  StopSpec stop;

  /// The material of that name. InputError, with the names that there are, where the scene has none.
  const Material& material(std::string_view name) const;
  const Material& wheel_material() const;  ///< InputError without [wheel]
  const Material& rail_material() const;   ///< InputError without [rail]
  const Material& head_material() const;   ///< of the rail's running surface; InputError without [rail]
  ElasticPair elastic_pair() const;        ///< of the running surfaces; InputError without [wheel] or [rail]
  /// The body that replaces a part, "disc" or "rail", and its name; null: none does.
  const std::pair<const std::string, BodySpec>* body_replacing(std::string_view part) const;
  /// Names of all materials, "mortar, slab, steel"; "none" where there are none.
  std::string material_names() const;

  /// The support of a fastening, counted from 0, as [support.NAME] states it; unaltered where none does.
  SupportSpec support(int fastening) const;
  /// All fastenings are alike.
  bool alike_supports() const { return supports.empty() && (!fastenings || fastenings->listed.empty()); }
  /// x of the middle of a fastening, counted from 0, negative before the rail [m]. With [rail], [fastenings].
  double fastening_x(int fastening) const;

  ZoneSpec solution_zone() const { return {zone_start, zone_length}; }
  /// The solution zone, then the others.
  std::vector<ZoneSpec> all_zones() const;

  /// x of the wheel at t = 0 and in the static state [m].
  double start_x() const { return motion && motion->run_up ? zone_start - *motion->run_up : 0; }

  /// MotionSpec::start, "auto" resolved; without [motion]: "rigid".
  std::string start() const {
    if (!motion) return "rigid";
    if (motion->start != "auto") return motion->start;
    return fastenings && wheel && wheel->bore == "free" && motion->speed > 0 ? "rolling" : "moving";
  }
};

}  // namespace tread
