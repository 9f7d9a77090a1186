#include "drivers/results/run_results.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/results/root_attributes.hpp"
#include "drivers/results/statistics_json.hpp"
#include "io/text/json.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

struct HistoryColumn {
  Channel channel;
  std::function<double(const Sample&)> value;
};

const std::vector<HistoryColumn>& wheel_columns() {
  static const std::vector<HistoryColumn> columns = {
      {{"wheel_x", "m", "position of the wheel's axis along the rail"},
       [](const Sample& s) { return s.wheel_x; }},
      {{"vertical_force", "N", "F_N, contact force on the wheel, upwards"},
       [](const Sample& s) { return s.vertical_force; }},
      {{"longitudinal_force", "N", "F_L, contact force on the wheel, forwards"},
       [](const Sample& s) { return s.longitudinal_force; }},
      {{"lateral_force", "N", "contact force on the wheel, to the field side"},
       [](const Sample& s) { return s.lateral_force; }},
      {{"traction_coefficient", "-", "F_L / F_N"}, &Sample::traction},
      {{"patch_area", "m2", "area in contact"}, [](const Sample& s) { return s.patch_area; }},
      {{"slip_area", "m2", "part of the patch that slips"}, [](const Sample& s) { return s.slip_area; }},
      {{"max_pressure", "Pa", "largest contact pressure at a rail node"},
       [](const Sample& s) { return s.max_pressure; }},
      {{"max_shear", "Pa", "largest surface shear stress at a rail node"},
       [](const Sample& s) { return s.max_shear; }},
      {{"max_penetration", "m", "largest penetration at an integration point"},
       [](const Sample& s) { return s.max_penetration; }},
      {{"creepage_node", "-", "eq. (13) at the point of the tread that starts in the patch"},
       [](const Sample& s) { return s.creepage_node; }},
      {{"creepage_mean", "-",
        "eq. (13), mean of 28 points around the tread; guided bore: by the carrier's spin"},
       [](const Sample& s) { return s.creepage_mean; }},
      {{"lateral_creepage", "-", "mean lateral speed of the wheelset over its forward speed"},
       [](const Sample& s) { return s.lateral_creepage; }},
      {{"spin_creepage", "1/m", "rotation of the wheel about the rail's outward normal, over the way"},
       [](const Sample& s) { return s.spin_creepage; }},
      {{"torque", "N m", "on the axle"}, [](const Sample& s) { return s.torque; }},
      {{"wheel_speed", "m/s", "mean forward speed of the wheelset"},
       [](const Sample& s) { return s.wheel_speed; }},
      {{"wheel_spin", "rad/s", "mean angular speed of the wheelset"},
       [](const Sample& s) { return s.wheel_spin; }},
      {{"wheel_z", "m", "height of the wheelset's mean axis above the crown"},
       [](const Sample& s) { return s.wheel_z; }},
      {{"corrugation_depth", "m", "of the rail under the wheel's axis"},
       [](const Sample& s) { return s.corrugation_depth; }},
  };
  return columns;
}

const std::vector<HistoryColumn>& hammer_columns() {
  static const std::vector<HistoryColumn> columns = {
      {{"hammer_force", "N", "on the rail head, downwards"}, [](const Sample& s) { return s.hammer_force; }},
      {{"hammer_displacement", "m", "of the struck point since the start, downwards"},
       [](const Sample& s) { return s.hammer_displacement; }},
  };
  return columns;
}

void add_energies(EnergyPart part, std::vector<HistoryColumn>& columns) {
  for (const EnergyKind& kind : kEnergyKinds)
    if (kind.part == part)
      columns.push_back({{kind.name, "J", kind.title},
                         [member = kind.member](const Sample& s) { return s.energy.*member; }});
}

std::vector<HistoryColumn> columns_of(const Model& model) {
  std::vector<HistoryColumn> columns;
  if (model.contact) {
    columns = wheel_columns();
    add_energies(EnergyPart::contact, columns);
  }
  if (model.hammer) {
    columns.insert(columns.end(), hammer_columns().begin(), hammer_columns().end());
    add_energies(EnergyPart::hammer, columns);
  }
  add_energies(EnergyPart::bodies, columns);
  columns.push_back({{"energy_residual", "J", "what the balance misses"},
                     [](const Sample& s) { return s.energy.residual; }});
  if (model.has_branches()) add_energies(EnergyPart::branches, columns);
  if (has_laws(model.mesh)) add_energies(EnergyPart::laws, columns);
  return columns;
}

/// Steps of `dt` [s] in a time [s] that a key states. InputError where they are more than a run can take.
double steps_in(const char* key, double time, double dt) {
  constexpr double kMost = 1e15;
  const double steps = time / dt;
  if (!(steps <= kMost))
    throw InputError(
        fmt::format("{} = {:g} s has {:.3g} steps of {:.3g} s, a run at most {:g}; state a larger "
                    "motion.step_safety or a shorter {}",
                    key, time, steps, dt, kMost, key));
  return steps;
}

}  // namespace

std::vector<Channel> history_channels(const Model& model) {
  std::vector<Channel> channels = {{"time", "s", "since the start of rolling"}};
  for (const HistoryColumn& column : columns_of(model)) channels.push_back(column.channel);
  return channels;
}

std::vector<double> history_row(const Model& model, const Sample& sample) {
  std::vector<double> row = {sample.time};
  for (const HistoryColumn& column : columns_of(model)) row.push_back(column.value(sample));
  return row;
}

std::int64_t step_count(const Scene& scene, double dt) {
  return static_cast<std::int64_t>(std::ceil(steps_in("motion.duration", scene.motion->duration, dt)));
}

std::int64_t sampling_interval(const Scene& scene, double dt) {
  return std::max<std::int64_t>(
      1, std::llround(steps_in("output.history_interval", scene.output.history_interval, dt)));
}

namespace {

/// Largest values over the width and statistics on the axis, where the run has an evaluated stretch.
Json surface_json(const SurfaceResults& s) {
  Json json = {{"axis_y_m", s.axis_y}};
  if (s.last > s.first) {
    json["stretch_x_m"] = {s.first, s.last};
    json["max_pressure_Pa"] = s.max_pressure;
    json["max_shear_Pa"] = s.max_shear;
    json["max_von_mises_Pa"] = s.max_von_mises;
    json["max_frictional_work_J_per_m2"] = s.max_work;
    json["axis_max_von_mises_Pa"] = statistics_json(s.von_mises);
    json["axis_frictional_work_J_in_1.1_mm_cell"] = statistics_json(s.cell_work);
    json["axis_frictional_work_range_J_in_1.1_mm_cell"] = s.cell_work.range();
    json["axis_frictional_work_range_sampled_J_in_1.1_mm_cell"] = s.sampled_cell_work.range();
  }
  json["frictional_work_every_step_J"] = s.total_work;
  json["frictional_work_sampled_J"] = s.total_sampled_work;
  json["frictional_work_sampled_difference_percent"] =
      s.total_work > 0 ? 100 * (s.total_sampled_work / s.total_work - 1) : 0.0;
  return json;
}

void add_static_contact(const Model& model, const RunResults& r, Json& json) {
  json["static_wheel_load_N"] = -r.preload.contact.force_on_rail.z;
  json["static_max_pressure_Pa"] = r.preload.max_pressure;
  json["static_max_point_pressure_Pa"] = r.preload.contact.max_pressure;
  json["static_patch_area_m2"] = r.preload.contact.area;
  json["static_penetration_m"] = r.preload.contact.max_penetration;
  json["contact_centre_y_m"] = r.preload.contact.centre.y;
  json["rail_deflection_m"] = r.preload.rail_deflection;
  json["wheel_tilt_rad"] = r.preload.tilt;
  json["rail_tilt_rad"] = r.preload.rail_tilt;
  json["wheelset_mass_kg"] = model.wheelset->mass();
  json["wheelset_inertia_kg_m2"] = model.wheelset->inertia();
  if (model.web_thickness > 0) json["wheelset_web_thickness_m"] = model.web_thickness;
}

/// Root mean squares of F_N in one-third octaves over the evaluated stretch.
Json octaves_json(const RunResults& r) {
  const ForceSpectrum& spectrum = r.spectrum;
  Json list = Json::array();
  for (std::size_t i = 0; i < spectrum.bands.size(); ++i) {
    const ThirdOctave& band = spectrum.bands[i];
    list.push_back({{"frequency_Hz", band.nominal}, {"rms_N", spectrum.rms[i]}});
    const auto inside = [&](const ForceSine& sine) {
      return sine.frequency >= band.low() && sine.frequency <= band.high();
    };
    if (std::ranges::any_of(r.ripples, inside)) list.back()["of_elements"] = true;
  }
  return list;
}

/// Reason for the lowest band of octaves_json().
std::string octaves_reason(const RunResults& r) {
  if (r.spectrum.square.empty()) return "no band: samples there are fewer than 16 or not even";
  return fmt::format("bands below {:.4g} Hz hold fewer than 17 waves in the evaluated stretch of {:.3g} m",
                     r.spectrum.lowest(), r.evaluated_last - r.evaluated_first);
}

Json sine_json(const ForceSine& sine) {
  return {{"length_m", sine.length}, {"frequency_Hz", sine.frequency}, {"amplitude_N", sine.amplitude}};
}

Json measured_json(const Model& model, const RunResults& r) {
  Json json = Json::object();
  for (std::size_t c = 0; c < r.measured.columns(); ++c) {
    const Channel& channel = r.measured.channels()[c].channel;
    json[channel.name] = statistics_json(measured_statistics(model, r, c));
    json[channel.name]["unit"] = channel.unit;
    json[channel.name]["description"] = channel.description;
  }
  return json;
}

Json percent_or_null(const std::optional<double>& share) {
  return share ? Json(100 * *share) : Json();
}

void add_rolling_contact(const Model& model, const RunResults& r, Json& json) {
  json["vertical_force_N"] = statistics_json(r.vertical_force);
  json["dynamic_factor"] = r.dynamic_factor();
  json["vertical_force_third_octaves"] = octaves_json(r);
  json["vertical_force_third_octaves_reason"] = octaves_reason(r);
  json["vertical_force_of_elements"] = Json::array();
  for (const ForceSine& ripple : r.ripples) json["vertical_force_of_elements"].push_back(sine_json(ripple));
  json["vertical_force_of_wave"] = r.wave ? sine_json(*r.wave) : Json();
  json["longitudinal_force_N"] = statistics_json(r.longitudinal_force);
  json["lateral_force_N"] = statistics_json(r.lateral_force);
  json["lateral_creepage"] = statistics_json(r.lateral_creepage);
  json["spin_creepage_per_m"] = statistics_json(r.spin_creepage);
  json["evaluated_x_m"] = {r.evaluated_first, r.evaluated_last};
  json["passed"] = r.passed;
  json["steady_x_m"] = {r.steady_first, r.steady_last};
  json["vertical_force_steady_N"] = r.vertical_force_steady;
  json["traction_coefficient"] = r.traction_coefficient;
  json["traction_target"] = number_or_null(r.traction_target);
  json["traction_drift"] = number_or_null(r.traction_drift);
  json["traction_steady"] = traction_is_steady(model.scene, r);
  const bool rolls = !stands(model.scene);
  json["creepage_percent"] = rolls ? Json(100 * r.creepage) : Json();
  json["creepage_of_frictional_work_percent"] = percent_or_null(r.creepage_of_work);
  json["creepage_max_percent"] = rolls ? Json(100 * r.creepage_max) : Json();
  json["full_slip_share"] = r.full_slip_share;
  json["max_pressure_Pa"] = r.max_pressure;
  json["max_shear_Pa"] = r.max_shear;
  json["patch_area_m2"] = r.patch_area;
  json["frictional_work_J"] = r.samples.back().energy.frictional_work;
  json["frictional_work_decrease_J"] = r.frictional_work_decrease;
  json["momentum_error"] = r.momentum_error;
  if (r.surface_fields) json["surface"] = surface_json(r.surface);
}

}  // namespace

std::string summary_json(const Model& model, const ResolvedScene& resolved, const RunResults& r) {
  Json json = {{"title", resolved.scene.title}, {"quality", resolved.scene.quality}};
  add_attributes(root_attributes(resolved.scene), json);
  json["elements"] = model.elements();
  json["nodes"] = model.nodes();
  json["steps"] = r.steps;
  if (r.origin)
    json["fork"] = {{"from", r.origin->folder}, {"time_s", r.origin->time}, {"step", r.origin->steps}};
  json["dt_s"] = r.dt;
  json["dt_reason"] = r.limit.reason;
  json["threads"] = threads();
  json["device"] = device_name();
  json["mesh_s"] = r.seconds_mesh;
  json["preload_s"] = r.seconds_preload;
  json["preload_cached"] = r.preload_cached != 0;
  json["rolling_s"] = r.seconds_rolling;
  json["element_steps_per_s"] =
      r.seconds_rolling > 0 ? static_cast<double>(model.elements() * r.own_steps()) / r.seconds_rolling : 0.0;
  json["preload_residual"] = r.preload.residual;
  json["warnings"] = r.warnings;
  if (model.contact) add_static_contact(model, r, json);
  if (r.samples.empty()) return json_text(json);  // a static scene
  if (model.contact) add_rolling_contact(model, r, json);
  if (r.measured.columns() > 0) json["measured"] = measured_json(model, r);
  json["energy_error"] = r.energy_error;
  if (model.contact) json["energy_error_over_frictional_work"] = r.energy_error_of_work;
  json["energy_by_body_J"] = Json::array();
  for (std::size_t b = 0; b < r.part_energy.size(); ++b)
    json["energy_by_body_J"].push_back({{"body", model.mesh.part_name(static_cast<int>(b))},
                                        {"strain", r.part_energy[b].strain},
                                        {"hourglass", r.part_energy[b].hourglass}});
  json["state_hash"] = fmt::format("{:016x}", r.state_hash);
  return json_text(json);
}

}  // namespace tread
