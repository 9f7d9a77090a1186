#include "drivers/report/scene_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/parallel/parallel.hpp"
#include "drivers/engine/device/device_movers.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/report/mesh_measures.hpp"
#include "drivers/report/surface_check.hpp"
#include "drivers/results/disk_use.hpp"
#include "drivers/results/estimate.hpp"
#include "drivers/results/inventory.hpp"
#include "drivers/results/resolution.hpp"
#include "drivers/results/run_results.hpp"
#include "io/report/plain_text.hpp"
#include "io/scene/body_file.hpp"
#include "io/text/json.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

std::string disk_text(const Model& model, const DiskUse& disk) {
  std::string text = fmt::format("about {}", bytes_text(disk.results + disk.frames));
  if (disk.rows == 0) return text;
  text += fmt::format(": {} rows of {} channels, {}report {}; ", grouped(disk.rows), disk.channels,
                      model.contact ? "patch, " : "", bytes_text(disk.results));
  if (disk.frames > 0)
    text += fmt::format("{} frames of {} {}; ", model.scene.output.frames, model.scene.output.frame_cells,
                        bytes_text(disk.frames));
  return text + fmt::format("{} more for checkpoints while it runs", bytes_text(disk.checkpoints));
}

/// "body.disc.tread: 4,200 nodes of the tread follow its faces, 0.231 mm off before at the most"
std::string tie_text(const Model& model, std::size_t i) {
  const BodyTieSpec& spec = model.body_ties[i];
  const BodyTie& made = model.made_ties[i];
  const std::string& block = model.mesh.blocks[static_cast<std::size_t>(spec.block)].name;
  const std::string who = made.body_leads ? fmt::format("nodes of the {} follow its faces", block)
                                          : fmt::format("of its nodes follow the faces of the {}", block);
  return fmt::format("{}: {} {}, {:.3g} mm off before at the most", spec.key,
                     grouped(static_cast<std::int64_t>(made.nodes.size())), who, 1e3 * made.farthest);
}

bool has_wheelset(const Model& model) {
  return model.wheelset && model.scene.wheel->shape == "half_wheelset";
}

/// Returns true where the program chooses the web's thickness.
bool sizes_web(const Model& model) {
  const WheelSpec& wheel = *model.scene.wheel;
  return model.web_thickness > 0 && wheel.web == "stated" && !wheel.web_thickness && !wheel.brake_rings;
}

/// "588.5 kg, inertia 45.5 kg m2 about the axle, 56.1 kg m2 across it; web 52.7 mm, sized by wheel.mass"
std::string wheelset_text(const Model& model) {
  constexpr double kUsualThinnest = 18e-3, kUsualThickest = 40e-3;  // of webs [m]
  const SpinningBody& body = *model.wheelset;
  std::string text = fmt::format("{:.4g} kg, inertia {:.4g} kg m2 about the axle, {:.4g} kg m2 across it",
                                 body.mass(), body.inertia(), body.transverse_inertia());
  if (model.web_thickness > 0) text += fmt::format("; web {:.1f} mm", 1e3 * model.web_thickness);
  if (!sizes_web(model)) return text;
  text += ", sized by wheel.mass";
  if (model.web_thickness >= kUsualThinnest && model.web_thickness <= kUsualThickest) return text;
  return text + fmt::format("; usual webs have {:g} to {:g} mm, wheel.web_thickness states one",
                            1e3 * kUsualThinnest, 1e3 * kUsualThickest);
}

/// "87.57 kN on the rail: 8000 kg sprung, 340 kg unsprung, 586.1 kg of the wheel at 9.81 m/s2"; beside it the
/// axle load of a half wheelset.
std::string load_text(const Model& model) {
  const Scene& scene = model.scene;
  std::string parts;
  if (const std::optional<VehicleSpec>& vehicle = scene.vehicle)
    parts =
        fmt::format("{:.6g} kg sprung, {:.6g} kg unsprung, ", vehicle->sprung_mass, vehicle->unsprung_mass);
  if (scene.load) parts = fmt::format("{:.6g} kN pressed on the wheel, ", 1e-3 * scene.load->wheel_load);
  const double load = model.wheel_load();
  return fmt::format("{:.4g} kN on the rail: {}{:.5g} kg of the wheel at {:.4g} m/s2{}", 1e-3 * load, parts,
                     model.wheelset->mass(), scene.gravity,
                     has_wheelset(model) ? fmt::format("; axle load {:.4g} kN", 2e-3 * load) : "");
}

}  // namespace

std::vector<std::string> check_warnings(const Model& model, const Estimate& e) {
  std::vector<std::string> warnings = resolution_warnings(model);
  if (const std::int64_t there = machine_memory(); e.memory > there)
    warnings.push_back(fmt::format(
        "a run needs about {} of memory, this machine has {}: raise scene.element_size or shorten "
        "solution_zone.length",
        bytes_text(e.memory), bytes_text(there)));
  if (const std::optional<std::int64_t> left = free_disk("."); left && e.disk.total() > *left)
    warnings.push_back(fmt::format(
        "a run needs about {} of disk, this folder's has {} left: free some, choose another folder "
        "for results with -o, or state less output.frames",
        bytes_text(e.disk.total()), bytes_text(*left)));
  return warnings;
}

std::string check_text(const Model& model, const ResolvedScene& resolved, const Estimate& e, bool verbose) {
  const std::vector<std::string> warnings = check_warnings(model, e);
  std::string text = fmt::format("{}: {}\n", resolved.name,
                                 warnings.empty() ? "no problems found" : "no errors, but warnings");
  for (const std::string& warning : warnings) text += fmt::format("  warning: {}\n", warning);
  for (const std::string& note : body_notes(model.scene)) text += fmt::format("  note: {}\n", note);
  text += fmt::format("\n{}\n", plain_text(count_table(by_group(model, measure_blocks(model)))));
  const auto line = [&](const char* name, const std::string& value) {
    text += fmt::format("{:<10}{}\n", name, value);
  };
  if (const std::optional<WheelSpec>& wheel = model.scene.wheel; wheel && !wheel->profile_y.empty())
    line("Wheel", fmt::format("{}: {}", wheel->profile, wheel->profile_reading));
  if (const std::optional<RailSpec>& rail = model.scene.rail; rail && !rail->profile_y.empty()) {
    line("Rail", fmt::format("{}: {}", rail->profile, rail->profile_reading));
    line("",
         fmt::format("replaces the surface of the head; the section below stays that of {}", rail->section));
  }
  if (has_wheelset(model)) line("Wheelset", wheelset_text(model));
  if (model.wheel_load() > 0) line("Load", load_text(model));
  const char* of_body = "Body";
  for (const auto& [name, spec] : model.scene.bodies) {
    line(of_body,
         fmt::format("{}: {}, {}", name, std::filesystem::path(spec.file).filename().string(), spec.reading));
    of_body = "";
  }
  for (std::size_t i = 0; i < model.body_ties.size(); ++i) line("", tie_text(model, i));
  const char* head = "Surface";
  for (const auto& [name, spec] : model.scene.surfaces) {
    line(head, surface_text(model.scene, name, spec));
    head = "";
  }
  if (e.steps > 0) {
    line("Step", fmt::format("{:.4e} s = {:g} of the stable step", e.dt, model.scene.motion->step_safety));
    line("", e.limit.reason);
    line("Steps", fmt::format("{} for {:g} ms", grouped(e.steps), 1e3 * model.scene.motion->duration));
  }
  line("Memory", fmt::format("about {}", bytes_text(e.memory)));
  line("Disk", disk_text(model, e.disk));
  line("Time", fmt::format("about {} with {} thread{}: preload {}{}", duration_text(e.seconds()), threads(),
                           threads() == 1 ? "" : "s", duration_text(e.preload_seconds),
                           e.steps > 0 ? ", rolling " + duration_text(e.rolling_seconds) : ""));
  if (chosen_device()) {
    const DeviceNeed need = device_need(model);
    line("Device", fmt::format("{}, about {}; the processor moves {} of {} nodes; its time stands above",
                               device_name(), bytes_text(need.bytes),
                               grouped(std::min(need.host_nodes, model.nodes())), grouped(model.nodes())));
  }
  if (verbose)
    text += fmt::format("\n{}\n{}", plain_text(phase_table(model)), plain_text(field_table(model)));
  return text;
}

Json check_json(const Model& model, const Estimate& e) {
  Json json = {{"ok", true}, {"problems", Json::array()}};
  json["warnings"] = check_warnings(model, e);
  json["notes"] = body_notes(model.scene);
  json["elements"] = model.elements();
  json["nodes"] = model.nodes();
  json["blocks"] = Json::array();
  const auto add_part = [&](const auto& part) {
    json["blocks"].push_back({{"name", part.name}, {"elements", part.elements()}, {"nodes", part.nodes()}});
  };
  for (const SweptBlock& block : model.mesh.blocks) add_part(block);
  for (const HexBody& body : model.mesh.bodies) add_part(body);
  if (model.wheel_load() > 0) json["wheel_load_N"] = model.wheel_load();
  if (has_wheelset(model)) {
    json["wheelset"] = {{"mass_kg", model.wheelset->mass()},
                        {"polar_inertia_kg_m2", model.wheelset->inertia()},
                        {"transverse_inertia_kg_m2", model.wheelset->transverse_inertia()},
                        {"web_thickness_m", model.web_thickness},
                        {"web_sized_by_mass", sizes_web(model)}};
  }
  for (const auto& [name, spec] : model.scene.surfaces)
    json["surfaces"].push_back(surface_shape_json(model.scene, name, spec));
  if (e.steps > 0) {
    json["dt_s"] = e.dt;
    json["stable_step_s"] = e.limit.stable_step;
    json["dt_reason"] = e.limit.reason;
    json["steps"] = e.steps;
  }
  json["memory_bytes"] = e.memory;
  json["disk_bytes"] = e.disk.results;
  json["frame_bytes"] = e.disk.frames;
  json["checkpoint_bytes"] = e.disk.checkpoints;
  json["history_rows"] = e.disk.rows;
  json["threads"] = threads();
  json["device"] = device_name();
  if (chosen_device()) {
    const DeviceNeed need = device_need(model);
    json["device_bytes"] = need.bytes;
    json["times_of"] = "cpu";
    json["host_nodes"] = std::min(need.host_nodes, model.nodes());
  }
  json["preload_s"] = e.preload_seconds;
  json["rolling_s"] = e.rolling_seconds;
  json["phases"] = Json::array();
  for (const PhaseRow& phase : phases(model))
    json["phases"].push_back({{"name", phase.name}, {"reads", phase.reads}, {"writes", phase.writes}});
  json["fields"] = Json::array();
  for (const FieldRow& field : fields(model))
    json["fields"].push_back(
        {{"name", field.name}, {"unit", field.unit}, {"entity", field.entity}, {"bytes", field.bytes}});
  return json;
}

}  // namespace tread
