#include <utility>

#include "io/scene/key_builders.hpp"
#include "io/scene/key_table.hpp"

namespace tread::keys {

namespace {

void add_friction(Keys& keys) {
  const auto with = [](std::vector<std::string> laws, Key key) {
    return only_with("contact.friction_law", std::move(laws), std::move(key));
  };
  keys.push_back(choice("contact.friction_law", {Effect::motion, Effect::cost},
                        at(&Scene::contact, &ContactSpec::friction_law), {"coulomb", "table", "falling"},
                        "Coefficient of friction: one for all, along the rail by a file, or falling with "
                        "the slip speed"));
  keys.push_back(
      with({"coulomb", "falling"},
           number("contact.friction", {Effect::motion}, at(&Scene::contact, &ContactSpec::friction), {0, 2},
                  "Coefficient of friction f; for falling friction, f without slip")));
  keys.push_back(with({"falling"}, number("contact.friction_fast", {Effect::motion},
                                          at(&Scene::contact, &ContactSpec::friction_fast), {0, 2},
                                          "Coefficient of friction of fast slip; dry rails: 0.4 f after "
                                          "Polach (2005)")));
  keys.push_back(with(
      {"falling"}, quantity("contact.friction_speed", {Effect::motion},
                            at(&Scene::contact, &ContactSpec::friction_speed), kSpeed, "m/s", above(0, 1000),
                            "Slip speed that leaves 1/e of the fall; dry rails: 1.67 m/s after Polach "
                            "(2005), wet ones 5 m/s")));
  keys.push_back(
      with({"falling"},
           required(quantity("contact.friction_memory", {Effect::motion},
                             at(&Scene::contact, &ContactSpec::friction_memory), kLength, "um", from(0, 1),
                             "Sliding length over which the coefficient follows the slip speed; "
                             "above zero"))));
  Key table =
      file("contact.friction_file", {Effect::motion}, at(&Scene::contact, &ContactSpec::friction_file),
           "File of two columns, x and coefficient of friction, after a line such as "
           "`# x [m]  f [-]`; linear between the rows, constant beyond them");
  // A table of a later layer takes the place of an earlier coefficient.
  keys.push_back(with({"table"}, required(instead_of("contact.friction", std::move(table)))));
  keys.push_back(with({"table"}, quantity("contact.friction_start", {Effect::motion},
                                          at(&Scene::contact, &ContactSpec::friction_start), kLength, "m",
                                          from(-1000, 1000), "x on the rail where the file's x is zero")));
}

}  // namespace

void add_contact(Keys& keys) {
  add_friction(keys);
  keys.push_back(
      number("contact.penetration_ratio", {Effect::preload},
             at(&Scene::contact, &ContactSpec::penetration_ratio), above(0, 0.5),
             "Penetration divided by the Hertz approach: sets the penalty stiffness; absent: 10 E / element "
             "size, E the harmonic mean of wheel and rail, but at most 2 %"));
  keys.push_back(quantity("contact.depth_room", {Effect::room, Effect::cost},
                          at(&Scene::contact, &ContactSpec::depth_room), kLength, "mm", from(0, 0.01),
                          "Corrugation depth that the searched surface has room for: the deepest that a fork "
                          "of the run may have; absent: the scene's own, with [forks] at least 0.2 mm"));
  keys.push_back(choice("contact.surface", {Effect::preload}, at(&Scene::contact, &ContactSpec::surface),
                        {"exact", "facets"},
                        "Surface that the gap is measured to: the profile's curves or the element faces"));
  keys.push_back(number("contact.points", {Effect::preload, Effect::cost},
                        at(&Scene::contact, &ContactSpec::points), {1, 4},
                        "Integration points per face and direction", Kind::integer));
}

void add_motion(Keys& keys) {
  const auto rolling = [](Key key) { return with_table("wheel", std::move(key)); };
  keys.push_back(rolling(quantity("motion.speed", {Effect::preload}, at(&Scene::motion, &MotionSpec::speed),
                                  kSpeed, "km/h", from(0, 300), "Forward speed at the start")));
  keys.push_back(quantity("motion.duration", {Effect::duration}, at(&Scene::motion, &MotionSpec::duration),
                          kTime, "s", above(0, 100), "Simulated time, from the start on"));
  keys.push_back(rolling(quantity("motion.run_up", {Effect::mesh}, at(&Scene::motion, &MotionSpec::run_up),
                                  kLength, "m", from(0, 1000),
                                  "Way from the start to the solution zone; absent: the wheel starts at "
                                  "x = 0")));
  keys.push_back(rolling(
      instead_of("motion.traction.torque",
                 number("motion.traction.mu", {Effect::motion}, at(&Scene::motion, &MotionSpec::traction_mu),
                        {-2, 2}, "Target traction coefficient; negative brakes"))));
  keys.push_back(rolling(instead_of(
      "motion.traction.mu",
      quantity("motion.traction.torque", {Effect::motion}, at(&Scene::motion, &MotionSpec::traction_torque),
               kTorque, "kN m", {-1e6, 1e6}, "Torque on the axle after the ramp; negative brakes"))));
  keys.push_back(rolling(quantity("motion.traction.ramp", {Effect::motion},
                                  at(&Scene::motion, &MotionSpec::ramp), kTime, "ms", from(0, 100),
                                  "Time T1 in which the torque grows from zero; 0: the wheel has long been "
                                  "rolling under it, as the static state has, too; a guided bore gets it at "
                                  "once")));
  keys.push_back(rolling(choice("motion.traction.shape", {Effect::motion},
                                at(&Scene::motion, &MotionSpec::ramp_shape), {"linear", "smooth"},
                                "Growth and reversal of the torque: linear, or as half a cosine")));
  keys.push_back(rolling(
      number("motion.traction.reversals", {Effect::motion}, at(&Scene::motion, &MotionSpec::reversals),
             {0, 1000}, "Number of later reversals of the full torque, each in 2 T1", Kind::integer)));
  keys.push_back(rolling(flag("motion.spin_in_preload", {Effect::preload},
                              at(&Scene::motion, &MotionSpec::spin_in_preload),
                              "The static state carries the spin's body force")));
  keys.push_back(rolling(number("motion.creepage", {Effect::mesh}, at(&Scene::motion, &MotionSpec::creepage),
                                {-2, 2, false, true},
                                "Creepage at the start, relative to free rolling; -2: a locked wheel")));
  keys.push_back(rolling(
      choice("motion.start", {Effect::preload}, at(&Scene::motion, &MotionSpec::start),
             {"auto", "rigid", "moving", "rolling"},
             "Motion at t = 0: of rigid bodies, with the static deflection moving along, or that of a "
             "wheel that has been rolling over the fastenings; auto: rolling on [fastenings], else moving")));
  keys.push_back(number("motion.step_safety", {Effect::motion, Effect::cost},
                        at(&Scene::motion, &MotionSpec::step_safety), above(0, 1),
                        "Time step divided by the stable step"));
}

void add_corrugation(Keys& keys) {
  const auto sine = [](Key key) { return only_with("corrugation.kind", "sine", std::move(key)); };
  const auto length = [](const char* name, Effects effects, auto member, const char* unit, Bounds range,
                         const char* description) {
    return quantity(name, effects, at(&Scene::corrugation, member), kLength, unit, range, description);
  };
  const auto random = [](Key key) { return only_with("corrugation.kind", "random", std::move(key)); };
  keys.push_back(
      choice("corrugation.kind", {Effect::surface}, at(&Scene::corrugation, &CorrugationSpec::kind),
             {"sine", "table", "map", "random"},
             "Sine waves, measured depths along, measured depths along and across, or random roughness"));
  keys.push_back(sine(length("corrugation.wavelength", {Effect::surface}, &CorrugationSpec::wavelength, "mm",
                             above(0, 10), "Wavelength L")));
  keys.push_back(sine(length("corrugation.depth", {Effect::surface}, &CorrugationSpec::depth, "mm",
                             above(0, 0.01), "Depth d_m from crest to trough")));
  keys.push_back(
      only_with("corrugation.kind", std::vector<std::string>{"sine", "table", "random"},
                length("corrugation.width", {Effect::surface}, &CorrugationSpec::width, "mm", above(0, 0.1),
                       "Half width W across the rail, where the depth has fallen to zero")));
  keys.push_back(length("corrugation.start", {Effect::surface}, &CorrugationSpec::start, "m",
                        from(-1000, 1000), "x_s where it starts, a sine at a crest"));
  keys.push_back(
      only_with("corrugation.kind", std::vector<std::string>{"sine", "random"},
                length("corrugation.length", {Effect::surface}, &CorrugationSpec::length, "m", above(0, 1000),
                       "Length that the whole waves must fit into; of the roughness, which fades over half "
                       "the longest wave at either end")));
  keys.push_back(random(length("corrugation.rms", {Effect::surface}, &CorrugationSpec::rms, "um",
                               above(0, 0.01), "Root mean square of the roughness")));
  keys.push_back(random(length("corrugation.shortest", {Effect::surface}, &CorrugationSpec::shortest, "mm",
                               above(0, 10), "Shortest wave of the roughness")));
  keys.push_back(random(length("corrugation.longest", {Effect::surface}, &CorrugationSpec::longest, "mm",
                               above(0, 10), "Longest wave of the roughness")));
  keys.push_back(
      random(number("corrugation.seed", {Effect::surface}, at(&Scene::corrugation, &CorrugationSpec::seed),
                    {0, 2e9}, "Seed of the phases of the roughness' waves", Kind::integer)));
  keys.push_back(length("corrugation.centre", {Effect::surface}, &CorrugationSpec::centre, "mm", {-0.1, 0.1},
                        "y of the deepest line; absent: at the preload's largest pressure"));
  keys.push_back(choice("corrugation.apply", {Effect::surface},
                        at(&Scene::corrugation, &CorrugationSpec::apply), {"nodes", "gap"},
                        "Moved nodes, or depths added to the contact gap"));
  keys.push_back(only_with(
      "corrugation.kind", std::vector<std::string>{"table", "map"},
      required(
          file("corrugation.file", {Effect::surface}, at(&Scene::corrugation, &CorrugationSpec::file),
               "File of two columns, x from the start and depth positive downwards, after a line such as "
               "`# x [m]  d [mm]`; map: three, `# x [m]  y [mm]  d [um]`, each x with each y once, or HDF5 "
               "with x, "
               "y and depth; y counts from corrugation.centre"))));
}

void add_wear(Keys& keys) {
  keys.push_back(quantity("wear.coefficient", {Effect::wear}, at(&Scene::wear, &WearSpec::coefficient), kWear,
                          "ug/N/m", above(0, 1e-3),
                          "Mass worn off per frictional work: 2.5e-9 kg/(N m) is usual for mild wear, after "
                          "Krause and Poll (1984)"));
  keys.push_back(number(
      "wear.change", {Effect::wear}, at(&Scene::wear, &WearSpec::change), above(0, 1),
      "Largest relative change of the depth by one simulated passage; sets the number of real passages "
      "that it stands for"));
  keys.push_back(quantity("wear.shortest", {Effect::wear}, at(&Scene::wear, &WearSpec::shortest), kLength,
                          "mm", above(0, 10),
                          "Shortest wave that wear changes; shorter waves count as noise of the mesh"));
  keys.push_back(quantity("wear.longest", {Effect::wear}, at(&Scene::wear, &WearSpec::longest), kLength, "mm",
                          above(0, 10), "Longest wave that wear changes"));
  keys.push_back(
      flag("wear.across", {Effect::wear}, at(&Scene::wear, &WearSpec::across),
           "Each row of nodes across the rail wears by its own work; without it the depth keeps its "
           "parabola across"));
}

void add_impacts(Keys& keys) {
  keys.push_back(
      required(quantity("pulse.velocity", {Effect::motion}, at(&Scene::pulse, &PulseSpec::velocity), kSpeed,
                        "m/s", {-1000, 1000}, "Initial velocity along x of the bar's left end")));
  keys.push_back(required(quantity("pulse.length", {Effect::motion}, at(&Scene::pulse, &PulseSpec::length),
                                   kLength, "m", above(0, 1000), "Length of the part with this velocity")));
  keys.push_back(quantity("hammer.position", {Effect::motion}, at(&Scene::hammer, &HammerSpec::position),
                          kLength, "m", from(-1000, 1000), "x of the struck point on the rail's crown"));
  keys.push_back(required(quantity("hammer.force", {Effect::motion}, at(&Scene::hammer, &HammerSpec::force),
                                   kForce, "kN", {-1e6, 1e6}, "Largest force of the blow, downwards")));
  keys.push_back(
      required(quantity("hammer.duration", {Effect::motion}, at(&Scene::hammer, &HammerSpec::duration), kTime,
                        "ms", above(0, 1), "Duration of the blow, a half sine from t = 0 on")));
  keys.push_back(quantity("forks.at", {Effect::forks}, at(&Scene::forks, &ForkSpec::at), kTime, "ms",
                          from(0, 100),
                          "Time of the state; absent: 20 mm before the patch meets the corrugation, or the "
                          "solution zone of a smooth rail"));
}

void add_probe(Keys& keys, const std::string& name) {
  const std::string table = std::string(kProbeTables) + name;
  const auto placed = [&](const char* key, double ProbeSpec::*member, const char* unit, Bounds range,
                          const char* description) {
    return only_with(table + ".body", std::vector<std::string>{"rail", "wheel"},
                     quantity(table + key, {Effect::output}, at(&Scene::probes, name, member), kLength, unit,
                              range, description));
  };
  keys.push_back(choice(table + ".body", {Effect::output}, at(&Scene::probes, name, &ProbeSpec::body),
                        {"rail", "wheel", "axle_box"},
                        "Body of the point: the rail; the wheel's rim, a point that turns with it; or the "
                        "axle box, which moves as the journal does in the mean"));
  keys.push_back(placed(".x", &ProbeSpec::x, "m", from(-1000, 1000),
                        "Place along the rail; of a point of the wheel: where it would meet the rail in free "
                        "rolling"));
  keys.push_back(placed(".y", &ProbeSpec::y, "mm", {-0.2, 0.2}, "Place across, from the rail's centre line"));
  keys.push_back(placed(".depth", &ProbeSpec::depth, "mm", from(0, 0.3),
                        "Depth below the running surface at that place"));
  keys.push_back(choice(table + ".quantity", {Effect::output}, at(&Scene::probes, name, &ProbeSpec::quantity),
                        {"motion", "stress", "all"},
                        "Displacement, velocity and acceleration; or the stress of the element about the "
                        "point; or both. A point of the wheel has stress alone, the axle box motion alone"));
}

void add_output(Keys& keys) {
  keys.push_back(quantity("output.history_interval", {Effect::output},
                          at(&Scene::output, &OutputSpec::history_interval), kTime, "s", above(0, 100),
                          "Simulated time between samples of the histories"));
  keys.push_back(quantity("output.progress_interval", {Effect::process},
                          at(&Scene::output, &OutputSpec::progress_interval), kTime, "s", above(0, 1e5),
                          "Wall-clock time between progress lines"));
  keys.push_back(quantity("output.checkpoint_interval", {Effect::process},
                          at(&Scene::output, &OutputSpec::checkpoint_interval), kTime, "min", above(0, 1e7),
                          "Wall-clock time between checkpoints"));
  keys.push_back(with_table(
      "fastenings",
      flag("output.fastening_forces", {Effect::output}, at(&Scene::output, &OutputSpec::fastening_forces),
           "The histories hold the vertical force of each fastening on the rail")));
  keys.push_back(with_table(
      "contact", quantity("output.stress_depth", {Effect::output},
                          at(&Scene::output, &OutputSpec::stress_depth), kLength, "mm", above(0, 0.1),
                          "Depth under the running surface down to which the histories hold the largest Von "
                          "Mises stress of the rail under the patch; none: they do not")));
  keys.push_back(
      number("output.frames", {Effect::output}, at(&Scene::output, &OutputSpec::frames), {0, 1e6},
             "Frames for ParaView, evenly over the duration from the first step to the last; 0: none",
             Kind::integer));
  keys.push_back(choice("output.frame_cells", {Effect::output}, at(&Scene::output, &OutputSpec::frame_cells),
                        {"faces", "elements"},
                        "Content of the frames: the outer faces of the bodies, or all elements"));
  keys.push_back(quantity("output.disk_limit", {Effect::process}, at(&Scene::output, &OutputSpec::disk_limit),
                          kData, "GB", above(0, 1e15),
                          "Largest size of the run's folder; a larger one ends the run"));
  keys.push_back(number("stop.steps", {Effect::stop}, at(&Scene::stop, &StopSpec::steps), {0, 2e9},
                        "Steps after which the run ends; 0: any number", Kind::integer));
  keys.push_back(quantity("stop.wall_time", {Effect::stop}, at(&Scene::stop, &StopSpec::wall_time), kTime,
                          "h", above(0, 1e8),
                          "Time of the process after which it leaves a checkpoint and ends"));
  keys.push_back(with_table(
      "contact", quantity("stop.penetration", {Effect::stop}, at(&Scene::stop, &StopSpec::penetration),
                          kLength, "um", above(0, 1), "Penetration that ends the run")));
}

}  // namespace tread::keys
