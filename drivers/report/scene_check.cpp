#include "drivers/report/scene_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/parallel/parallel.hpp"
#include "drivers/engine/device/device_movers.hpp"
#include "drivers/engine/model/surfaces.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/report/mesh_measures.hpp"
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

/// A shape's depths and where it meets the rail, "flat on the wheel, depths of 0 to 0.73 mm, x = 0.875 to
/// 0.925 m".
std::string surface_text(const Scene& scene, const std::string& name, const SurfaceSpec& spec) {
  const DepthBounds bounds = shape_of(scene, spec)->bounds();
  std::string text =
      fmt::format("{}: {} on the {}, depths of {:.4g} to {:.4g} mm, ", name, spec.kind,
                  spec.on_wheel() ? "wheel" : "rail", -1e3 * bounds.highest + 0.0, 1e3 * bounds.deepest);
  const std::vector<Span> places = places_of(scene, spec, run_span(scene));
  if (places.empty()) return text + "which the run does not meet";
  text += "x =";
  for (const Span& place : places)
    text +=
        fmt::format("{} {:.4g} to {:.4g} m", &place == &places.front() ? "" : ",", place.first, place.last);
  return text;
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

}  // namespace

std::string check_text(const Model& model, const ResolvedScene& resolved, const Estimate& e, bool verbose) {
  const std::vector<std::string> warnings = resolution_warnings(model);
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
    line("Device", fmt::format("{}, about {}; the processor moves {} of {} nodes", device_name(),
                               bytes_text(need.bytes), grouped(std::min(need.host_nodes, model.nodes())),
                               grouped(model.nodes())));
  }
  if (verbose)
    text += fmt::format("\n{}\n{}", plain_text(phase_table(model)), plain_text(field_table(model)));
  return text;
}

Json check_json(const Model& model, const Estimate& e) {
  Json json = {{"ok", true}, {"problems", Json::array()}};
  json["warnings"] = resolution_warnings(model);
  json["notes"] = body_notes(model.scene);
  json["elements"] = model.elements();
  json["nodes"] = model.nodes();
  json["blocks"] = Json::array();
  const auto add_part = [&](const auto& part) {
    json["blocks"].push_back({{"name", part.name}, {"elements", part.elements()}, {"nodes", part.nodes()}});
  };
  for (const SweptBlock& block : model.mesh.blocks) add_part(block);
  for (const HexBody& body : model.mesh.bodies) add_part(body);
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
