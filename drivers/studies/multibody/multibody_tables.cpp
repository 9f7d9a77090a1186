// Tables, JSON and CSV of `tread multibody`.

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

#include "drivers/results/statistics_json.hpp"
#include "drivers/studies/multibody/multibody_report.hpp"
#include "io/report/markup.hpp"
#include "io/text/json.hpp"

namespace tread {

namespace {

Json fit_json(const CurveFit& fit) {
  return {{"vertical_force_N", statistics_json(fit.force)},
          {"vertical_force_range_N", fit.force.range()},
          {"mean_shift_before_crests_rad", fit.shift},
          {"misfit_rms_N", fit.misfit}};
}

Json calibration_json(const MultibodyOutcome& o) {
  const Calibration& c = *o.calibration;
  return {{"contact_C_N_per_m1.5", c.contact},
          {"contact_C_over_hertz", c.contact / o.model.vehicle.contact},
          {"best_at_bound_of_search", c.at_bound},
          {"stretch_x_m", {c.first, c.last}},
          {"run", fit_json(c.run)},
          {"hertz", fit_json(c.before)},
          {"fitted", fit_json(c.after)}};
}

Json map_json(const MultibodyOutcome& o) {
  const ResponseMap& map = *o.map;
  std::size_t largest = 0;
  for (std::size_t i = 0; i < map.points.size(); ++i)
    if (map.points[i].max > map.points[largest].max) largest = i;
  const std::size_t waves = map.axes.wavelength.values.size();
  Json json = {{"points", map.points.size()},
               {"dt_s_at_lowest_speed", map.dt_first},
               {"dt_s_at_highest_speed", map.dt_last},
               {"largest",
                {{"speed_m_per_s", map.axes.speed.values[largest / waves]},
                 {"wavelength_m", map.axes.wavelength.values[largest % waves]},
                 {"max_over_static", map.points[largest].max}}},
               {"dots", Json::array()}};
  for (const MapDot& dot : o.dots)
    json["dots"].push_back({{"run", dot.label},
                            {"speed_m_per_s", dot.speed},
                            {"wavelength_m", dot.wavelength},
                            {"max_over_static", dot.max},
                            {"min_over_static", dot.min},
                            {"remark", dot.remark}});
  return json;
}

std::string in_pi(double radians) {
  return fmt::format("{:.3f}", radians / std::numbers::pi);
}

}  // namespace

Table multibody_table(const MultibodyOutcome& o) {
  const MultibodyModel& m = o.model;
  const MultibodyResult& r = o.result;
  Table table{"", {{"Quantity"}, {"Value", Align::right}, {"Unit"}, {"Remark"}}, {}};
  const auto add = [&](std::string name, std::string value, std::string unit, std::string remark = "") {
    table.rows.push_back({std::move(name), std::move(value), std::move(unit), std::move(remark)});
  };
  add("Largest F_N", readable(1e-3 * r.force.max), "kN",
      fmt::format("x = {:.3f} ... {:.3f} m", r.evaluated_first, r.evaluated_last));
  add("Smallest F_N", readable(1e-3 * r.force.min), "kN");
  add("Static F_N", readable(1e-3 * m.vehicle.load()), "kN");
  add("Way without contact", readable(100 * r.loss_of_contact, 3), "%", "of the same stretch");
  if (r.passing)
    add("Half range of F_N over a fastening span / static", readable(100 * *r.passing / m.vehicle.load(), 3),
        "%", m.corrugation.smooth() ? "last span" : "last span before the corrugation");
  if (!r.peaks.empty()) {
    add("F_N's peak before the first crest", in_pi(r.peaks.front().shift), "pi",
        "a wavelength is 2 pi; the crest a wave behind the corrugation's start");
    add("Mean over the crests", in_pi(mean_shift(r.peaks)), "pi");
  }
  add("Rail deflection at rest", readable(1e3 * r.static_rail), "mm",
      fmt::format("{} rail, under the wheel at x = {:g}", name_of(m.theory), m.scene.start_x()));
  add("Contact stiffness at rest", readable(1e-9 * m.contact_stiffness()), "GN/m",
      fmt::format("C = {} N/m^1.5", readable(m.vehicle.contact)));
  if (o.filter_gain) add("Gain of the contact filter", readable(*o.filter_gain), "");
  return table;
}

std::vector<std::string> warnings_of(const MultibodyOutcome& o) {
  std::vector<std::string> warnings = o.result.warnings;
  if (o.map) warnings.insert(warnings.end(), o.map->warnings.begin(), o.map->warnings.end());
  return warnings;
}

Table calibration_table(const Calibration& c, const MultibodyModel& model) {
  Table table{"",
              {{"F_N over the stretch"},
               {"Unit"},
               {"Transient run", Align::right},
               {"Hertz spring", Align::right},
               {"Fitted spring", Align::right}},
              {}};
  const auto add = [&](const char* name, const char* unit, const auto& value) {
    table.rows.push_back({name, unit, value(c.run), value(c.before), value(c.after)});
  };
  const auto kn = [](double newtons) { return readable(1e-3 * newtons); };
  add("largest", "kN", [&](const CurveFit& f) { return kn(f.force.max); });
  add("smallest", "kN", [&](const CurveFit& f) { return kn(f.force.min); });
  add("range", "kN", [&](const CurveFit& f) { return kn(f.force.range()); });
  add("range / that of the run", "-",
      [&](const CurveFit& f) { return readable(f.force.range() / c.run.force.range(), 3); });
  add("mean shift of the peaks before the crests", "pi", [&](const CurveFit& f) { return in_pi(f.shift); });
  add("difference from the run, root mean square", "kN", [&](const CurveFit& f) { return kn(f.misfit); });
  table.rows.push_back({"C / Hertz", "-", "–", "1", readable(c.contact / model.vehicle.contact, 3)});
  return table;
}

std::string multibody_json(const MultibodyOutcome& o) {
  const MultibodyModel& m = o.model;
  const MultibodyResult& r = o.result;
  Json json = {{"title", m.scene.title},
               {"beam", name_of(m.theory)},
               {"modes", r.modes},
               {"wheel_modes", m.wheel.modes.size()},
               {"contact", m.sine.empty() ? "hertz" : "half-space"},
               {"dt_s", r.dt},
               {"steps", r.steps},
               {"seconds", o.seconds},
               {"speed_m_per_s", m.speed},
               {"static_wheel_load_N", m.vehicle.load()},
               {"static_rail_deflection_m", r.static_rail},
               {"contact_C_N_per_m1.5", m.vehicle.contact},
               {"contact_stiffness_N_per_m", m.contact_stiffness()},
               {"contact_y_m", m.contact_y},
               {"bending_stiffness_N_m2", m.rail.bending_stiffness},
               {"shear_stiffness_N", m.rail.shear_stiffness},
               {"rail_mass_kg_per_m", m.rail.mass},
               {"unsprung_mass_kg", m.vehicle.unsprung_mass}};
  if (o.filter_gain) json["contact_filter_gain"] = *o.filter_gain;
  json["evaluated_x_m"] = {r.evaluated_first, r.evaluated_last};
  json["vertical_force_N"] = statistics_json(r.force);
  json["loss_of_contact_share"] = r.loss_of_contact;
  if (r.passing) json["passing_half_range_N"] = *r.passing;
  json["crests"] = Json::array();
  for (const CrestPeak& p : r.peaks)
    json["crests"].push_back({{"crest_x_m", p.crest},
                              {"peak_x_m", p.peak},
                              {"peak_N", p.force},
                              {"shift_before_crest_rad", p.shift}});
  json["warnings"] = warnings_of(o);
  if (o.calibration) json["calibration"] = calibration_json(o);
  if (o.map) json["map"] = map_json(o);
  return json_text(json);
}

std::string passage_csv(const MultibodyModel& model, const MultibodyResult& result) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text),
                 "time [s],wheel_x [m],vertical_force [N],wheel_deflection [m],rail_deflection [m],"
                 "sprung_deflection [m],followed_depth [m]\n");
  const double interval = model.scene.output.history_interval;
  const auto every = static_cast<std::size_t>(std::max(1.0, std::round(interval / result.dt)));
  for (std::size_t i = 0; i < result.samples.size(); i += every) {
    const MultibodySample& s = result.samples[i];
    fmt::format_to(std::back_inserter(text), "{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", s.time,
                   s.x, s.force, s.wheel, s.rail, s.sprung, s.roughness);
  }
  return fmt::to_string(text);
}

std::string calibration_csv(const Calibration& c) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text),
                 "wheel_x [m],vertical_force_run [N],vertical_force_hertz [N],vertical_force_fitted [N]\n");
  for (std::size_t i = 0; i < c.x.size(); ++i)
    fmt::format_to(std::back_inserter(text), "{:.9g},{:.9g},{:.9g},{:.9g}\n", c.x[i], c.run.values[i],
                   c.before.values[i], c.after.values[i]);
  return fmt::to_string(text);
}

std::string map_csv(const ResponseMap& map) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text),
                 "speed [m/s],wavelength [m],passing_frequency [Hz],max_over_static [-],min_over_static [-],"
                 "loss_of_contact [-]\n");
  const std::vector<double>& speeds = map.axes.speed.values;
  const std::vector<double>& waves = map.axes.wavelength.values;
  for (std::size_t i = 0; i < speeds.size(); ++i)
    for (std::size_t j = 0; j < waves.size(); ++j) {
      const MapPoint& p = map.at(i, j);
      fmt::format_to(std::back_inserter(text), "{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.4g}\n", speeds[i],
                     waves[j], speeds[i] / waves[j], p.max, p.min, p.loss_of_contact);
    }
  return fmt::to_string(text);
}

}  // namespace tread
