#include "drivers/engine/model/scene_requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/built_in_profiles.hpp"
#include "kernels/material/laws.hpp"

namespace tread {

namespace {

void require_name(const std::string& member, const std::string& value,
                  const std::vector<std::string_view>& names) {
  if (std::ranges::find(names, value) != names.end()) return;
  throw InputError(fmt::format("{} = \"{}\": no such name; state one of \"{}\"", member, value,
                               fmt::join(names, "\", \"")));
}

template <class BuiltIn>
std::vector<std::string_view> joined_names(const BuiltIn& built_in,
                                           std::initializer_list<std::string_view> more) {
  std::vector<std::string_view> all(built_in.begin(), built_in.end());
  all.insert(all.end(), more);
  return all;
}

struct Size {
  std::string_view name;
  double value;
  const char* unit;  ///< " m"; empty: a number
};

/// `table`: "rail."
void require_above_zero(const std::string& table, std::initializer_list<Size> sizes) {
  for (const auto& [name, value, unit] : sizes)
    if (!(value > 0 && std::isfinite(value)))
      throw InputError(
          fmt::format("{}{} = {:g}{}: nothing can be computed with it; state a finite value above zero",
                      table, name, value, unit));
}

void require_material(const std::string& name, const Material& material) {
  const std::string table = fmt::format("material.{}.", name);
  require_name(table + "law", material.law, Laws::names());
  require_above_zero(
      table, {{"youngs_modulus", material.youngs_modulus, " Pa"}, {"density", material.density, " kg/m3"}});
  if (!(material.poissons_ratio > -1 && material.poissons_ratio < 0.5))
    throw InputError(
        fmt::format("{}poissons_ratio = {:g}: such a material does not resist every deformation; state a "
                    "value above -1 and below 0.5",
                    table, material.poissons_ratio));
}

void require_wheel(const WheelSpec& wheel) {
  require_name("wheel.shape", wheel.shape, {"half_wheelset", "tyre"});
  require_name("wheel.bore", wheel.bore, {"free", "guided"});
  if (wheel.profile_y.empty())
    require_name("wheel.profile", wheel.profile, joined_names(kBuiltInWheels, {"arc", "cylinder"}));
  require_above_zero("wheel.", {{"diameter", wheel.diameter, " m"},
                                {"crown_radius", wheel.crown_radius, " m"},
                                {"width", wheel.width, " m"},
                                {"thickness", wheel.thickness, " m"}});
}

void require_rail(const RailSpec& rail) {
  require_name("rail.support", rail.support, {"fastenings", "rigid", "free"});
  if (rail.profile_y.empty())
    require_name("rail.profile", rail.profile, joined_names(kBuiltInRails, {"box"}));
  require_name("rail.section", rail.section, joined_names(kBuiltInRails, {}));
  require_above_zero(
      "rail.", {{"length", rail.length, " m"}, {"width", rail.width, " m"}, {"height", rail.height, " m"}});
}

void require_fastenings(const FasteningSpec& fastenings) {
  for (const auto& [name, hold] : {std::pair("along", &fastenings.along), {"across", &fastenings.across}})
    require_name(fmt::format("fastenings.{}", name), hold->kind, {"held", "free", "elastic"});
  require_name("fastenings.held_at", fastenings.held_at, {"pad", "springs"});
  require_above_zero("fastenings.", {{"count", 1.0 * fastenings.count, ""},
                                     {"spacing", fastenings.spacing, " m"},
                                     {"pad_length", fastenings.pad_length, " m"},
                                     {"pad_width", fastenings.pad_width, " m"},
                                     {"columns", 1.0 * fastenings.columns, ""},
                                     {"rows", 1.0 * fastenings.rows, ""}});
}

/// Sizes of slab and sleepers.
void require_foundation(const Scene& scene) {
  if (const auto& slab = scene.slab_track)
    require_above_zero("slab.", {{"pitch", slab->pitch, " m"},
                                 {"gap", slab->gap, " m"},
                                 {"width", slab->width, " m"},
                                 {"thickness", slab->thickness, " m"},
                                 {"mortar_thickness", slab->mortar_thickness, " m"}});
  if (const auto& sleepers = scene.sleepers)
    require_above_zero("sleepers.", {{"width", sleepers->width, " m"},
                                     {"length", sleepers->length, " m"},
                                     {"height", sleepers->height, " m"}});
}

void require_contact(const ContactSpec& contact) {
  require_name("contact.surface", contact.surface, {"exact", "facets"});
  require_name("contact.friction_law", contact.friction_law, {"coulomb", "table", "falling"});
  if (contact.friction_law == "falling")
    require_above_zero("contact.", {{"friction_memory", contact.friction_memory, " m"},
                                    {"friction_speed", contact.friction_speed, " m/s"}});
  const std::size_t rows = contact.friction_x.size();
  if (contact.friction_law == "table" && (rows == 0 || contact.friction_at_x.size() != rows))
    throw InputError(
        fmt::format("contact.friction_law = \"table\" with {} places and {} coefficients; state as many "
                    "coefficients, one at least",
                    rows, contact.friction_at_x.size()));
}

void require_motion(const MotionSpec& motion) {
  require_name("motion.start", motion.start, {"auto", "rigid", "moving", "rolling"});
  require_name("motion.traction.shape", motion.ramp_shape, {"linear", "smooth"});
  require_above_zero("motion.",
                     {{"duration", motion.duration, " s"}, {"step_safety", motion.step_safety, ""}});
}

void require_corrugation(const CorrugationSpec& corrugation) {
  require_name("corrugation.kind", corrugation.kind, {"sine", "table", "map", "random"});
  require_name("corrugation.apply", corrugation.apply, {"nodes", "gap"});
  require_above_zero("corrugation.", {{"wavelength", corrugation.wavelength, " m"},
                                      {"length", corrugation.length, " m"},
                                      {"width", corrugation.width, " m"},
                                      {"shortest", corrugation.shortest, " m"},
                                      {"longest", corrugation.longest, " m"}});
  constexpr double kRounding = 1e-9;
  if (corrugation.kind == "sine" && corrugation.wavelength > corrugation.length * (1 + kRounding))
    throw InputError(fmt::format(
        "corrugation.wavelength = {:g} m: not one wave fits into corrugation.length = {:g} m; state "
        "a shorter wave or a larger length",
        corrugation.wavelength, corrugation.length));
  const std::size_t columns = corrugation.table_x.size();
  const std::size_t rows = corrugation.kind == "map" ? corrugation.map_y.size() : 1;
  if (corrugation.in_file() && (columns < 2 || rows < 1 || corrugation.table_depth.size() != columns * rows))
    throw InputError(fmt::format(
        "corrugation.kind = \"{}\" with {} depths at {} places along and {} across; state a depth "
        "at each, and two places along at least",
        corrugation.kind, corrugation.table_depth.size(), columns, rows));
}

void require_surface(const std::string& name, const SurfaceSpec& surface) {
  const std::string table = fmt::format("surface.{}.", name);
  require_name(table + "kind", surface.kind, {"dip", "dent", "waves", "polygon", "flat", "profile", "map"});
  require_name(table + "on", surface.on, {"rail", "wheel"});
  require_name(table + "shape", surface.shape, {"smooth", "pointed"});
  require_above_zero(table, {{"length", surface.length, " m"},
                             {"width", surface.width, " m"},
                             {"wavelength", surface.wavelength, " m"},
                             {"order", 1.0 * surface.order, ""}});
}

void require_tables(const Scene& scene) {
  for (const auto& [name, material] : scene.materials) require_material(name, material);
  for (const auto& [name, surface] : scene.surfaces) require_surface(name, surface);
  for (const auto& [name, zone] : scene.zones)
    require_above_zero(fmt::format("zone.{}.", name), {{"length", zone.length, " m"}});
  for (const auto& [name, body] : scene.bodies) {
    require_name(fmt::format("body.{}.replaces", name), body.replaces, {"disc", "rail"});
    require_name(fmt::format("body.{}.unit", name), body.unit, {"mm", "cm", "m"});
  }
  for (const auto& [name, probe] : scene.probes) {
    const std::string table = fmt::format("probe.{}.", name);
    require_name(table + "body", probe.body, {"rail", "wheel", "axle_box"});
    require_name(table + "quantity", probe.quantity, {"motion", "stress", "all"});
  }
}

}  // namespace

void require_scene(const Scene& scene) {
  require_name("scene.quality", scene.quality, {"draft", "standard", "paper"});
  require_name("scene.precision", scene.precision, {"double", "mixed", "single"});
  require_name("output.frame_cells", scene.output.frame_cells, {"faces", "elements"});
  require_above_zero("scene.", {{"element_size", scene.element_size.value_or(1), " m"}});
  require_above_zero("solution_zone.", {{"length", scene.zone_length, " m"}});
  require_tables(scene);
  if (scene.wheel) require_wheel(*scene.wheel);
  if (scene.rail) require_rail(*scene.rail);
  if (scene.fastenings) require_fastenings(*scene.fastenings);
  require_foundation(scene);
  if (scene.vehicle) require_name("vehicle.longitudinal", scene.vehicle->longitudinal, {"carried", "free"});
  if (scene.vehicle && scene.load)
    throw InputError(
        fmt::format("load.wheel_load = {:g} N beside a vehicle: a wheel carries one of them; leave the other "
                    "out",
                    scene.load->wheel_load));
  if (scene.contact) require_contact(*scene.contact);
  if (scene.motion) require_motion(*scene.motion);
  if (!scene.corrugation) return;
  require_corrugation(*scene.corrugation);
  if (!scene.contact || !scene.wheel || !scene.rail)
    throw InputError(fmt::format(
        "corrugation.kind = \"{}\": no wheel rolls over it; add wheel, rail and contact, or leave "
        "the corrugation out",
        scene.corrugation->kind));
}

}  // namespace tread
