#include "drivers/results/inventory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "drivers/engine/simulation.hpp"
#include "drivers/results/frame_files.hpp"
#include "io/report/plain_text.hpp"

namespace tread {

namespace {

// What the static solver holds beside the displacement, in vector fields: the residual, two of conjugate
// gradients, one and a half of the preconditioner; aggregates and coarse factor as measured on runs.
constexpr double kSolverVectors = 4.5 + 2;
// A node of std::map: key, value, colour and three links.
constexpr std::int64_t kMapNode = 64;

template <class T>
std::int64_t bytes_of(const T& array) {
  return static_cast<std::int64_t>(array.size() * sizeof(array[0]));
}

bool vertical_blocks(const Model& model) {
  return std::any_of(model.mesh.blocks.begin(), model.mesh.blocks.end(),
                     [](const SweptBlock& block) { return block.vertical_only; });
}

bool fixed_blocks(const Model& model) {
  return model.index.rail_cap >= 0;
}

/// The run's fields are copies of the static state's.
bool rounded(const Model& model) {
  return model.scene.precision != "double";
}

std::int64_t moved_nodes(const Model& model) {
  std::int64_t count = 0;
  for (const SweptBlock& block : model.mesh.blocks)
    count += static_cast<std::int64_t>(block.node_shift.size());
  return count;
}

std::vector<std::string> with_restraints(const Model& model, std::vector<std::string> names) {
  if (!model.restrained.empty()) names.emplace_back("restrained unknowns");
  return names;
}

std::int64_t sample_count(const MotionSpec& motion, const OutputSpec& output) {
  return static_cast<std::int64_t>(std::ceil(motion.duration / output.history_interval)) + 1;
}

/// Collects phases; `when` keeps out those whose parts the model lacks.
class Phases {
 public:
  void add(bool when, PhaseInfo phase) {
    if (when) list_.push_back(std::move(phase));
  }
  std::vector<PhaseInfo> take() { return std::move(list_); }

 private:
  std::vector<PhaseInfo> list_;
};

/// Displacement, velocity in single precision and the branches' lag, until the frame is written; grid,
/// arrays, file and its image.
std::int64_t frame_memory(const Model& model) {
  const FrameBytes bytes = frame_bytes(make_vtk_grid(model.mesh, frame_cells(model.scene)));
  constexpr int kTimes = 3;
  const std::size_t component = (model.has_branches() ? 2 : 1) * sizeof(double) + sizeof(float);
  return 3 * model.mesh.slots * static_cast<std::int64_t>(component) + bytes.mesh + kTimes * bytes.frame;
}

void add_preload(const Model& model, Phases& list) {
  const bool wheel = model.wheelset.has_value();
  std::vector<std::string> reads = with_restraints(model, {"coefficients", "mass"});
  if (moved_nodes(model) > 0) reads.emplace_back("moved nodes");
  if (model.ties) reads.emplace_back("tie links");
  if (model.fastenings) reads.emplace_back("fastening elements");
  if (!model.journal.empty()) reads.emplace_back("journal nodes");
  if (model.contact) reads.emplace_back("contact points");
  std::vector<std::string> writes = {"displacement", "solver"};
  if (wheel) writes.emplace_back("wheel frame");
  list.add(true, {"preload", "static equilibrium of all blocks", reads, writes});
}

}  // namespace

std::vector<PhaseInfo> phases(const Model& model) {
  Phases list;
  add_preload(model, list);
  if (!model.scene.motion) return list.take();
  const bool wheel = model.wheelset.has_value();
  const bool vehicle = model.scene.vehicle && !model.journal.empty();
  const bool load = model.scene.load && !model.journal.empty();

  std::vector<std::string> deformed_by = {"coefficients", "displacement", "velocity"};
  if (model.has_branches()) deformed_by.emplace_back("branch lag");
  list.add(true, {"internal force", "all blocks", deformed_by, {"force"}});
  list.add(model.has_branches(), {"Maxwell branches", "blocks that have them", {"velocity"}, {"branch lag"}});
  list.add(model.ties.has_value(), {"tied forces", "tied nodes", {"tie links"}, {"force"}});
  list.add(model.fastenings.has_value(),
           {"fastenings", "spring-dampers", {"fastening elements", "displacement", "velocity"}, {"force"}});
  list.add(vehicle, {"suspension",
                     "sprung mass and journal",
                     {"journal nodes", "displacement", "velocity"},
                     {"force", "sprung mass"}});
  list.add(load, {"wheel load", "journal", {"journal nodes"}, {"force"}});
  list.add(model.contact != nullptr, {"contact search",
                                      "rail faces near the wheel",
                                      {"displacement", "velocity", "wheel frame"},
                                      {"contact points"}});
  list.add(!model.torque.empty(), {"torque", "end of the axle", {"torque nodes", "velocity"}, {"force"}});
  list.add(model.hammer.has_value(), {"hammer", "rail head", {"displacement"}, {"force"}});
  list.add(vehicle, {"unsprung mass", "journal", {"journal nodes"}, {"force"}});
  list.add(
      fixed_blocks(model),
      {"update", "extruded blocks", with_restraints(model, {"force", "mass"}), {"velocity", "displacement"}});
  list.add(vertical_blocks(model), {"vertical update",
                                    "slab and mortar",
                                    with_restraints(model, {"force", "mass"}),
                                    {"velocity", "displacement"}});
  list.add(wheel, {"spinning update",
                   "wheel blocks",
                   with_restraints(model, {"force", "mass", "wheel frame"}),
                   {"velocity", "displacement"}});
  list.add(model.contact != nullptr, {"contact tractions",
                                      "points of the patch",
                                      {"mass", "wheel frame"},
                                      {"contact points", "velocity", "displacement"}});
  list.add(model.ties.has_value(),
           {"tied motion", "tied nodes", {"tie links"}, {"velocity", "displacement"}});
  list.add(wheel,
           {"frame", "mean motion of the wheel", {"mass"}, {"wheel frame", "displacement", "velocity"}});
  list.add(model.contact != nullptr, {"surface fields",
                                      "rail surface near the patch",
                                      {"contact points", "displacement"},
                                      {"surface fields"}});
  list.add(true, {"samples", "on their own clock", {"displacement", "velocity", "force"}, {"samples"}});
  list.add(true, {"checkpoint",
                  "a copy of the state, on the wall clock",
                  {"displacement", "velocity", "samples"},
                  {"checkpoint"}});
  list.add(model.scene.output.frames > 0, {"frames",
                                           "a copy of the motion, evenly over the duration",
                                           {"displacement", "velocity", "coefficients"},
                                           {"frames"}});
  return list.take();
}

std::vector<FieldInfo> fields(const Model& model) {
  const std::int64_t vector = 3 * model.mesh.slots * static_cast<std::int64_t>(sizeof(double));
  const ValueBytes bytes = value_bytes(model.scene);
  std::vector<FieldInfo> list;
  const auto add = [&](bool when, FieldInfo field) {
    if (when) list.push_back(std::move(field));
  };
  const bool motion = model.scene.motion.has_value();
  const bool wheel = model.wheelset.has_value();
  add(true, {"coefficients", "m, Pa", "quad and pitch class; moved node", model.internal->bytes()});
  add(moved_nodes(model) > 0,
      {"moved nodes", "m", "node on a chord or on the corrugation", kMapNode * moved_nodes(model)});
  add(true, {"mass", "kg, 1/kg", "node", bytes_of(model.mass) + bytes_of(model.inverse_mass)});
  add(!model.restrained.empty(), {"restrained unknowns", "-", "unknown", bytes_of(model.restrained)});
  add(model.ties.has_value(), {"tie links", "-", "tied node", model.ties ? model.ties->bytes() : 0});
  add(model.fastenings.has_value(), {"fastening elements", "N/m, N s/m", "spring-damper",
                                     model.fastenings ? bytes_of(model.fastenings->elements()) : 0});
  add(!model.journal.empty(), {"journal nodes", "-", "node of the journal's ring", model.journal.bytes()});
  add(motion && !model.torque.empty(),
      {"torque nodes", "1/m", "node of the axle's end", model.torque.bytes()});
  add(model.contact != nullptr,
      {"contact points", "Pa, s", "rail integration point", model.contact ? model.contact->bytes() : 0});
  add(wheel, {"wheel frame", "m, rad", "wheel", static_cast<std::int64_t>(sizeof(BodyFrame))});
  add(motion && model.scene.vehicle && !model.journal.empty(),
      {"sprung mass", "m, m/s", "sprung mass", static_cast<std::int64_t>(sizeof(SprungMass))});
  add(true, {"displacement", "m", "node", vector});
  add(motion && rounded(model),
      {"displacement in motion", "m", "node", 3 * model.mesh.slots * bytes.displacement});
  add(motion && rounded(model), {"rounded coefficients and mass", "m, Pa, 1/kg", "quad and pitch class; node",
                                 model.internal->bytes() / 2 + model.mesh.slots * bytes.other});
  add(motion, {"velocity", "m/s", "node", 3 * model.mesh.slots * bytes.other});
  add(motion, {"force", "N", "node", 3 * model.mesh.slots * bytes.other});
  add(motion && model.has_branches(), {"branch lag", "m", "node", 3 * model.mesh.slots * bytes.other});
  add(motion && model.contact, {"surface fields", "Pa, J/m2", "rail surface node",
                                model.contact ? SurfaceFields::bytes(model.contact->nodes().grid()) : 0});
  add(motion, {"samples", "all", "sample",
               motion ? sample_count(*model.scene.motion, model.scene.output) *
                            static_cast<std::int64_t>(sizeof(Sample))
                      : 0});
  add(motion,
      {"checkpoint", "all", "copy that is being written, and read back", 2 * checkpoint_bytes(model)});
  add(motion && model.scene.output.frames > 0,
      {"frames", "m, m/s", "node, a copy; its file", frame_memory(model)});
  add(true, {"solver", "N, m", "node and aggregate, during the preload",
             static_cast<std::int64_t>(kSolverVectors * static_cast<double>(vector))});
  return list;
}

Table phase_table(const Model& model) {
  const auto joined = [](const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text.append(text.empty() ? "" : ", ").append(name);
    return text;
  };
  Table table{"Phases", {{"Phase"}, {"Works on"}, {"Writes"}, {"Reads"}}, {}};
  for (const PhaseInfo& phase : phases(model))
    table.rows.push_back({phase.name, phase.body, joined(phase.writes), joined(phase.reads)});
  return table;
}

Table field_table(const Model& model) {
  Table table{"Fields", {{"Field"}, {"Unit"}, {"By"}, {"Size", Align::right}}, {}};
  for (const FieldInfo& field : fields(model))
    table.rows.push_back({field.name, field.unit, field.entity, bytes_text(field.bytes)});
  return table;
}

std::int64_t checkpoint_bytes(const Model& model) {
  const ValueBytes bytes = value_bytes(model.scene);
  const std::int64_t motion =
      3 * model.mesh.slots * (bytes.displacement + bytes.other * (model.has_branches() ? 2 : 1));
  if (!model.contact) return motion;
  return motion + model.contact->bytes() + SurfaceFields::bytes(model.contact->nodes().grid());
}

std::int64_t peak_bytes(const Model& model) {
  constexpr std::array<std::string_view, 9> kInMotion = {"displacement in motion",
                                                         "rounded coefficients and mass",
                                                         "velocity",
                                                         "force",
                                                         "branch lag",
                                                         "surface fields",
                                                         "samples",
                                                         "checkpoint",
                                                         "frames"};
  std::int64_t always = 0;
  std::int64_t preload = 0;
  std::int64_t rolling = 0;
  for (const FieldInfo& field : fields(model)) {
    if (field.name == "solver")
      preload += field.bytes;
    else if (std::find(kInMotion.begin(), kInMotion.end(), field.name) != kInMotion.end())
      rolling += field.bytes;
    else
      always += field.bytes;
  }
  return always + std::max(preload, rolling);
}

}  // namespace tread
