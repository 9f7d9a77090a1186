#include "drivers/report/report_references.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "drivers/results/resolution.hpp"
#include "io/files/share_folder.hpp"
#include "io/report/markup.hpp"
#include "io/scene/scene_library.hpp"

namespace tread {

namespace {

/// Returns true if the wheel has rolled over the whole stretch up to x [m].
bool reached(const RunResults& r, double x) {
  return !r.samples.empty() && r.reached >= x;
}

/// Steady values count once the torque has ramped up and the smooth rail before the corrugation is behind.
bool steady(const Model& model, const RunResults& r) {
  return reached(r, r.steady_last) && torque_has_settled(model.scene, r);
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
                                    const RunResults& r, const JsonRecord& summary) {
  std::vector<Comparison> rows;
  if (!model.contact) return rows;
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
  double area = std::numbers::pi * hertz.semi_axis_x * hertz.semi_axis_y;
  std::string remark = fmt::format("Hertz for radii {} and {} mm", readable(1e3 * model.wheel_radius(), 4),
                                   readable(1e3 * model.hertz_radius_y, 4));
  if (model.line_width > 0) {
    if (model.wheel_load() <= 0) return rows;
    area = 2 * model.line_semi_axis() * model.line_width;
    remark = fmt::format("a cylinder of radius {} mm on a plane {} mm wide",
                         readable(1e3 * model.wheel_radius(), 4), readable(1e3 * model.line_width, 4));
  }
  if (const std::optional<double> across = too_few_elements_across_patch(model))
    remark += fmt::format("; {:.1f} elements across the patch do not resolve it", *across);
  else if (model.line_width > 0)
    remark += scene.plane_strain ? "" : "; its edges carry more";
  else if (scene.wheel->profile != "arc" || scene.rail->profile != "box")
    remark += "; the profiles' curvature varies over the patch: not Hertzian";
  rows.push_back({"Patch area, static", "mm²", 1e6 * area, 1e6 * r.preload.contact.area, remark});
  rows.push_back({"Largest pressure, static", "MPa", 1e-6 * model.hertz_pressure(),
                  1e-6 * r.preload.max_pressure, "nodal average; " + remark});
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
