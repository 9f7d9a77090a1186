#include "io/scene/key_builders.hpp"
#include "io/scene/key_table.hpp"

namespace tread::keys {

void add_forks(Keys& keys) {
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
