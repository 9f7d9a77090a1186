#include "drivers/results/run_results.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/parallel/parallel.hpp"
#include "drivers/engine/evaluated_stretch.hpp"
#include "drivers/results/root_attributes.hpp"
#include "io/text/json.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

struct HistoryColumn {
  Channel channel;
  double (*value)(const Sample&);
};

double traction(const Sample& s) {
  return s.vertical_force > 0 ? s.longitudinal_force / s.vertical_force : 0.0;
}

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
      {{"traction_coefficient", "-", "F_L / F_N"}, traction},
      {{"patch_area", "m2", "area in contact"}, [](const Sample& s) { return s.patch_area; }},
      {{"slip_area", "m2", "part of the patch that slips"}, [](const Sample& s) { return s.slip_area; }},
      {{"max_pressure", "Pa", "largest contact pressure at a rail node"},
       [](const Sample& s) { return s.max_pressure; }},
      {{"max_shear", "Pa", "largest surface shear stress at a rail node"},
       [](const Sample& s) { return s.max_shear; }},
      {{"max_penetration", "m", "largest penetration at an integration point"},
       [](const Sample& s) { return s.max_penetration; }},
      {{"creepage_node", "-", "eq. (3) at the point of the tread that starts in the patch"},
       [](const Sample& s) { return s.creepage_node; }},
      {{"creepage_mean", "-", "eq. (3), mean of 28 points around the tread"},
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
      {{"penalty_energy", "J", "stored in the contact penalties"},
       [](const Sample& s) { return s.energy.penalty; }},
      {{"frictional_work", "J", "dissipated by friction since the start"},
       [](const Sample& s) { return s.energy.frictional_work; }},
      {{"torque_work", "J", "done by the torque"}, [](const Sample& s) { return s.energy.torque_work; }},
      {{"guide_work", "J", "done by the guide of the bore"},
       [](const Sample& s) { return s.energy.guide_work; }},
  };
  return columns;
}

const std::vector<HistoryColumn>& body_columns() {
  static const std::vector<HistoryColumn> columns = {
      {{"kinetic_energy", "J", "of all bodies"}, [](const Sample& s) { return s.energy.kinetic; }},
      {{"strain_energy", "J", "elastic, hourglass part included"},
       [](const Sample& s) { return s.energy.strain; }},
      {{"connector_energy", "J", "in springs"}, [](const Sample& s) { return s.energy.connectors; }},
      {{"gravity_energy", "J", "potential"}, [](const Sample& s) { return s.energy.gravity; }},
      {{"connector_loss", "J", "dissipated in dampers"},
       [](const Sample& s) { return s.energy.connector_loss; }},
      {{"damping_loss", "J", "lost because contact forces lead the motion by half a step"},
       [](const Sample& s) { return s.energy.damping_loss; }},
      {{"energy_residual", "J", "what the balance misses"},
       [](const Sample& s) { return s.energy.residual; }},
  };
  return columns;
}

const std::vector<HistoryColumn>& hammer_columns() {
  static const std::vector<HistoryColumn> columns = {
      {{"hammer_force", "N", "on the rail head, downwards"}, [](const Sample& s) { return s.hammer_force; }},
      {{"hammer_displacement", "m", "of the struck point since the start, downwards"},
       [](const Sample& s) { return s.hammer_displacement; }},
      {{"hammer_work", "J", "done by the hammer"}, [](const Sample& s) { return s.energy.hammer_work; }},
  };
  return columns;
}

std::vector<HistoryColumn> columns_of(const Model& model) {
  std::vector<HistoryColumn> columns;
  if (model.contact) columns = wheel_columns();
  if (model.hammer) columns.insert(columns.end(), hammer_columns().begin(), hammer_columns().end());
  columns.insert(columns.end(), body_columns().begin(), body_columns().end());
  if (model.has_branches())
    columns.push_back({{"material_loss", "J", "dissipated in the material's Maxwell branches"},
                       [](const Sample& s) { return s.energy.material_loss; }});
  if (has_laws(model.mesh))
    columns.push_back({{"plastic_work", "J", "dissipated by material laws"},
                       [](const Sample& s) { return s.energy.plastic_work; }});
  return columns;
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
  return static_cast<std::int64_t>(std::ceil(scene.motion->duration / dt));
}

std::int64_t sampling_interval(const Scene& scene, double dt) {
  return std::max<std::int64_t>(1, std::llround(scene.output.history_interval / dt));
}

namespace {

/// Returns a test for samples with the wheel between two places [m]. The first sample lies at the start but
/// for rounding.
auto between(double first, double last) {
  constexpr double kRounding = 1e-9;  // [m]
  return [first, last](const Sample& s) {
    return s.wheel_x >= first - kRounding && s.wheel_x <= last + kRounding;
  };
}

/// Fills forces, creepage and sliding over the evaluated stretch.
void evaluate_stretch(const Model& model, double reached, RunResults& r) {
  const Corrugation& corrugation = model.contact->corrugation();
  const Span stretch = evaluated_stretch(model.scene, corrugation);
  r.evaluated_first = stretch.first;
  r.evaluated_last = std::min(reached, stretch.last);
  if (r.evaluated_first > reached) r.evaluated_first = model.scene.start_x();
  const auto evaluated = between(r.evaluated_first, r.evaluated_last);
  r.evaluated_samples = std::count_if(r.samples.begin(), r.samples.end(), evaluated);
  r.vertical_force = statistics(r.samples, evaluated, [](const Sample& s) { return s.vertical_force; });
  r.spectrum = force_spectrum(r.samples, r.evaluated_first, r.evaluated_last);
  r.longitudinal_force =
      statistics(r.samples, evaluated, [](const Sample& s) { return s.longitudinal_force; });
  const Statistics creepage =
      statistics(r.samples, evaluated, [](const Sample& s) { return s.creepage_mean; });
  r.creepage_max = -creepage.min > creepage.max ? creepage.min : creepage.max;
  constexpr double kWhole = 0.98;  // of the patch: the rest may be the rim of an integration point
  r.full_slip_share = statistics(
                          r.samples, [&](const Sample& s) { return evaluated(s) && s.patch_area > 0; },
                          [](const Sample& s) { return s.slip_area > kWhole * s.patch_area ? 1.0 : 0.0; })
                          .mean;
}

/// Change of F_L / F_N along the steady stretch over its mean, and its size that is always accepted: smaller
/// F_L / F_N is free rolling.
constexpr double kSteady = 0.05;
constexpr double kSmallTraction = 0.005;

/// Mean F_L over mean F_N between two places of the wheel [m]; 0 without load.
double traction_between(const std::vector<Sample>& samples, double first, double last) {
  const auto mean = [&](auto value) { return statistics(samples, between(first, last), value).mean; };
  const double vertical = mean([](const Sample& s) { return s.vertical_force; });
  return vertical > 0 ? mean([](const Sample& s) { return s.longitudinal_force; }) / vertical : 0.0;
}

/// Fills the means over the last whole fastening span in the solution zone, or before the patch meets the
/// corrugation.
void evaluate_steady(const Model& model, double reached, RunResults& r) {
  const Scene& scene = model.scene;
  const Corrugation& corrugation = model.contact->corrugation();
  const double span = scene.fastenings ? scene.fastenings->spacing : 0.1;
  const double end = std::min(
      reached, corrugation.smooth() ? scene.zone_start + scene.zone_length : corrugation.first() - 0.02);
  r.steady_last = end;
  r.steady_first = std::max(scene.start_x(), end - span);
  const auto mean = [&](auto value) {
    return statistics(r.samples, between(r.steady_first, r.steady_last), value).mean;
  };
  r.vertical_force_steady = mean([](const Sample& s) { return s.vertical_force; });
  r.traction_coefficient = traction_between(r.samples, r.steady_first, r.steady_last);
  const double middle = 0.5 * (r.steady_first + r.steady_last);
  r.traction_drift = traction_between(r.samples, middle, r.steady_last) -
                     traction_between(r.samples, r.steady_first, middle);
  r.creepage = mean([](const Sample& s) { return s.creepage_mean; });
  r.creepage_of_work = creepage_of_work(r.samples, r.steady_first, r.steady_last);
  r.max_pressure = mean([](const Sample& s) { return s.max_pressure; });
  r.max_shear = mean([](const Sample& s) { return s.max_shear; });
  r.patch_area = mean([](const Sample& s) { return s.patch_area; });
  // The patch has passed what lies behind its search window.
  const double reach = model.contact->reach();
  if (r.surface_fields)
    r.surface = surface_results(*r.surface_fields, std::max(r.evaluated_first, model.scene.start_x() + reach),
                                std::min(r.evaluated_last, reached - reach));
}

/// Fills the errors of energy and momentum.
void evaluate_balance(RunResults& r) {
  double worst = 0;
  double strain_low = r.samples.front().energy.strain;
  double strain_high = strain_low;
  for (std::size_t i = 0; i < r.samples.size(); ++i) {
    const EnergyLedger& e = r.samples[i].energy;
    worst = std::max(worst, std::abs(e.residual));
    strain_low = std::min(strain_low, e.strain);
    strain_high = std::max(strain_high, e.strain);
    if (i > 0)
      r.frictional_work_decrease =
          std::max(r.frictional_work_decrease, r.samples[i - 1].energy.frictional_work - e.frictional_work);
  }
  const EnergyLedger& last = r.samples.back().energy;
  const double scale = last.frictional_work + last.connector_loss + last.material_loss + last.plastic_work +
                       strain_high - strain_low;
  r.energy_error = scale > 0 ? worst / scale : 0;
  r.energy_error_of_work = last.frictional_work > 0 ? worst / last.frictional_work : 0;
  const Vec3 miss = r.momentum.impulse - r.momentum.change;
  if (r.momentum.contact_impulse.z > 0)
    r.momentum_error = std::hypot(miss.x, miss.z) / r.momentum.contact_impulse.z;
}

}  // namespace

bool traction_is_steady(const RunResults& r) {
  return std::abs(r.traction_drift) <= std::max(kSteady * std::abs(r.traction_coefficient), kSmallTraction);
}

void evaluate(const Model& model, RunResults& r) {
  if (r.samples.empty()) return;
  if (model.contact) {
    const double reached = r.samples.back().wheel_x;
    evaluate_stretch(model, reached, r);
    evaluate_steady(model, reached, r);
  }
  evaluate_balance(r);
}

namespace {

Json statistics_json(const Statistics& s) {
  return {{"mean", s.mean}, {"min", s.min}, {"max", s.max}};
}

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
}

/// Root mean squares of F_N in one-third octaves over the evaluated stretch.
Json octaves_json(const RunResults& r) {
  const ForceSpectrum& spectrum = r.spectrum;
  Json list = Json::array();
  for (std::size_t i = 0; i < spectrum.bands.size(); ++i)
    list.push_back({{"frequency_Hz", spectrum.bands[i].nominal}, {"rms_N", spectrum.rms[i]}});
  return list;
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

void add_rolling_contact(const RunResults& r, Json& json) {
  json["vertical_force_N"] = statistics_json(r.vertical_force);
  json["dynamic_factor"] = r.dynamic_factor();
  json["vertical_force_third_octaves"] = octaves_json(r);
  json["longitudinal_force_N"] = statistics_json(r.longitudinal_force);
  json["evaluated_x_m"] = {r.evaluated_first, r.evaluated_last};
  json["steady_x_m"] = {r.steady_first, r.steady_last};
  json["vertical_force_steady_N"] = r.vertical_force_steady;
  json["traction_coefficient"] = r.traction_coefficient;
  json["traction_drift"] = r.traction_drift;
  json["traction_steady"] = traction_is_steady(r);
  json["creepage_percent"] = 100 * r.creepage;
  json["creepage_of_frictional_work_percent"] = percent_or_null(r.creepage_of_work);
  json["creepage_max_percent"] = 100 * r.creepage_max;
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

Statistics measured_statistics(const Model& model, const RunResults& r, std::size_t column) {
  const auto evaluated = between(r.evaluated_first, r.evaluated_last);
  std::vector<double> values;
  for (std::size_t i = 0; i < r.samples.size(); ++i)
    if ((!model.contact || evaluated(r.samples[i])) && std::isfinite(r.measured.row(i)[column]))
      values.push_back(r.measured.row(i)[column]);
  return statistics(values);
}

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
  if (model.contact) add_rolling_contact(r, json);
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

std::optional<double> creepage_of_work(const std::vector<Sample>& samples, double first, double last) {
  const auto inside = between(first, last);
  const auto begin = std::find_if(samples.begin(), samples.end(), inside);
  const auto end = std::find_if(samples.rbegin(), samples.rend(), inside);
  if (begin == samples.end()) return std::nullopt;
  const double way = end->wheel_x - begin->wheel_x;
  const double force = statistics(samples, inside, [](const Sample& s) { return s.longitudinal_force; }).mean;
  if (way <= 0 || std::abs(traction_between(samples, first, last)) < kSmallTraction) return std::nullopt;
  return (end->energy.frictional_work - begin->energy.frictional_work) / (way * force);
}

}  // namespace tread
