#include "drivers/report/report_references.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "io/files/share_folder.hpp"
#include "io/report/markup.hpp"
#include "io/scene/scene_library.hpp"
#include "io/text/json.hpp"

namespace tread {

namespace {

bool is(double value, double wanted) {
  return std::abs(value - wanted) <= 1e-6 * std::abs(wanted);
}

/// The vehicle and track of the paper's Table 1, whatever runs on them.
bool has_paper_vehicle(const Scene& s) {
  return s.wheel && s.wheel->shape == "half_wheelset" && s.wheel->profile == "LMA" &&
         is(s.wheel->diameter, 0.86) && s.rail && s.rail->profile == "CN60" && s.vehicle &&
         is(s.vehicle->sprung_mass, 8000) && is(s.vehicle->unsprung_mass, 340) &&
         is(s.vehicle->suspension_stiffness, 880e3) && is(s.steel.youngs_modulus, 205.9e9);
}

bool has_paper_track(const Scene& s) {
  return s.slab_track && s.fastenings && is(s.fastenings->spacing, 0.65) &&
         is(s.fastenings->stiffness, 22e6) && is(s.fastenings->damping, 200e3);
}

bool rolls_at_300(const Scene& s) {
  return s.motion && is(s.motion->speed, 300 / 3.6) && s.motion->traction_mu &&
         is(*s.motion->traction_mu, 0.3) && s.contact && s.contact->friction_law == "coulomb" &&
         is(s.contact->friction, 0.5);
}

bool is_corrugation_d(const Scene& s) {
  return s.corrugation && s.corrugation->kind == "sine" && is(s.corrugation->wavelength, 0.08) &&
         is(s.corrugation->depth, 0.14e-3) && is(s.corrugation->width, 0.03) && is(s.corrugation->start, 2.4);
}

/// Whether the whole stretch of a figure has been rolled over.
bool reached(const RunResults& r, double x) {
  return !r.samples.empty() && r.samples.back().wheel_x >= x;
}

/// Steady values count once the torque has ramped up and the smooth rail before the corrugation is behind.
bool steady(const Model& model, const RunResults& r) {
  const MotionSpec& motion = *model.scene.motion;
  return reached(r, r.steady_last) && r.steady_first >= 1.5 * motion.ramp * motion.speed;
}

bool counts(Reference::After after, const Model& model, const RunResults& r) {
  switch (after) {
    case Reference::After::ramp:
      return model.contact && model.scene.motion && steady(model, r);
    case Reference::After::corrugation:
      return model.contact && reached(r, model.contact->corrugation().last());
    default:
      return true;
  }
}

std::string filled(std::string text, const std::string& name, const std::string& value) {
  const auto at = text.find(name);
  return at == std::string::npos ? text : text.replace(at, name.size(), value);
}

/// The run's value in the reference's unit.
std::optional<double> value_of(const Reference& reference, const JsonRecord& summary) {
  std::optional<double> value = number_in(summary, reference.result);
  if (value) *value *= reference.scale;
  if (!value || reference.over.empty()) return value;
  const std::optional<double> divisor = number_in(summary, reference.over);
  return divisor && *divisor > 0 ? std::optional(*value / *divisor) : std::nullopt;
}

bool within(const Reference& reference, const JsonRecord& summary) {
  return std::all_of(reference.ranges.begin(), reference.ranges.end(), [&](const auto& range) {
    const std::optional<double> value = number_in(summary, range.first);
    return value && *value >= range.second[0] && *value <= range.second[1];
  });
}

}  // namespace

std::vector<References> library_references(const Scene& scene) {
  std::vector<References> all;
  for (const LibraryEntry& entry : scene_library()) {
    const std::filesystem::path file = find_share_file(fmt::format("references/{}.toml", entry.name));
    if (!file.empty()) all.push_back(read_references(file, scene));
  }
  return all;
}

std::vector<Comparison> comparisons(const References& references, bool theory, const Model& model,
                                    const ResolvedScene& resolved, const RunResults& r) {
  std::vector<Comparison> rows;
  if (!model.contact) return rows;
  const JsonRecord summary = parse_json(summary_json(model, resolved, r), "summary");
  for (const Reference& reference : references.rows) {
    if (reference.theory != theory || !within(reference, summary)) continue;
    std::optional<double> ours = value_of(reference, summary);
    if (!counts(reference.after, model, r)) ours.reset();
    if (theory && !ours) continue;
    const std::string remark =
        filled(filled(reference.remark, "{contact_mm}", readable(1e3 * model.sizes.contact, 3)), "{quality}",
               model.scene.quality);
    rows.push_back({reference.label, reference.unit, reference.value, ours, remark});
  }
  return rows;
}

std::vector<Comparison> hertz_comparisons(const Model& model, const RunResults& r) {
  std::vector<Comparison> rows;
  if (!model.contact) return rows;
  const Scene& scene = model.scene;
  const HertzPatch& hertz = model.hertz_patch;
  const bool sphere = scene.wheel->profile == "arc" && scene.rail->profile == "box";
  const std::string shape =
      fmt::format("Hertz for radii {} and {} mm", readable(1e3 * model.wheel_radius(), 4),
                  readable(1e3 * model.hertz_radius_y, 4));
  const std::string remark =
      sphere ? shape : shape + "; the profiles' curvature varies over the patch: not Hertzian";
  rows.push_back({"Patch area, static", "mm²", 1e6 * std::numbers::pi * hertz.semi_axis_x * hertz.semi_axis_y,
                  1e6 * r.preload.contact.area, remark});
  rows.push_back({"Largest pressure, static", "MPa", 1e-6 * hertz.max_pressure, 1e-6 * r.preload.max_pressure,
                  "nodal average; " + remark});
  return rows;
}

std::vector<Marker> creepage_levels(const std::vector<References>& references) {
  std::vector<Marker> levels;
  for (const References& file : references)
    for (const Reference& reference : file.rows)
      if (!reference.level.empty()) levels.push_back({reference.value, reference.level});
  return levels;
}

}  // namespace tread
