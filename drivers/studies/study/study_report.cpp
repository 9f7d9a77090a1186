#include "drivers/studies/study/study_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "drivers/engine/model/station_plan.hpp"
#include "drivers/studies/study/study_figures.hpp"
#include "io/report/markup.hpp"
#include "io/scene/schema.hpp"
#include "io/text/json.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

/// Value in the key's unit; nullopt if it is not a number.
std::optional<double> number_of(const PlannedPoint& point, const std::string& path) {
  const std::optional<Key> key = find_key(path);
  if (!key || !key->locate) return std::nullopt;
  Scene scene = point.resolved.scene;
  const std::optional<double> si = number_at(key->locate(scene));
  if (!si || key->unit.empty()) return si;
  return *si / parse_quantity("1 " + key->unit, *key->quantity);
}

std::string unit_of(const std::string& path) {
  const std::optional<Key> key = find_key(path);
  return key && !key->unit.empty() ? key->unit : "-";
}

/// Value, rounded as in the CSV file, and unit of the key in a point's scene; a text, or "absent", has no
/// unit.
Json value_json(const PlannedPoint& point, const std::string& path) {
  const std::string text = value_text(point, path);
  const bool number = number_of(point, path).has_value();
  Json json;
  json["value"] = number ? Json(parse_number(text)) : Json(text);
  if (number) json["unit"] = unit_of(path);
  return json;
}

/// End of a name in JSON: "_N", "_per_m", none for pure numbers.
std::string unit_suffix(const std::string& unit) {
  if (unit == "-") return "";
  return unit.starts_with("1/") ? "_per_" + unit.substr(2) : "_" + unit;
}

/// First key whose values are numbers and differ.
std::string abscissa_key(const StudyPlan& plan) {
  for (const std::string& key : varied_keys(plan)) {
    std::set<double> values;
    for (const PlannedPoint& point : plan.points)
      if (const auto value = number_of(point, key)) values.insert(*value);
    if (values.size() > 1) return key;
  }
  return "";
}

/// The values that tell the point from others at the same abscissa.
std::string group_of(const StudyPlan& plan, const PlannedPoint& point, const std::string& abscissa) {
  std::string group;
  for (const std::string& key : varied_keys(plan))
    if (key != abscissa)
      group += fmt::format("{}{} = {}{}", group.empty() ? "" : ", ", key, value_text(point, key),
                           number_of(point, key) && unit_of(key) != "-" ? " " + unit_of(key) : "");
  return group;
}

std::optional<Chapter> trend_chapter(const StudyPlan& plan, const std::vector<FinishedRun>& runs) {
  const std::string key = abscissa_key(plan);
  std::vector<TrendRun> places;
  std::set<std::string> groups;
  std::set<double> abscissae;
  for (const PlannedPoint& point : plan.points) {
    const FinishedRun* run = find_run(runs, point.name);
    const std::optional<double> x = key.empty() ? std::nullopt : number_of(point, key);
    if (!run || !x) continue;
    places.push_back({run, *x, group_of(plan, point, key)});
    groups.insert(places.back().group);
    abscissae.insert(*x);
  }
  constexpr std::size_t kMostGroups = 4;
  if (abscissae.size() < 2 || groups.size() > kMostGroups) return std::nullopt;
  Figure figure = trend_figure("Mean and fluctuation over the evaluated stretch",
                               fmt::format("{} [{}]", key, unit_of(key)), fluctuation_panels(), places);
  if (figure.panels.empty()) return std::nullopt;
  figure.name = "trends";
  figure.caption =
      "Von Mises stress and frictional work of a cell of 1.1 mm x 1.1 mm: on the patch's longitudinal axis.";
  return Chapter{"Trends", {std::move(figure)}};
}

/// Overlaid curves, as many in a figure as there are colours.
void add_curves(const CurvesSpec& spec, const std::vector<FinishedRun>& runs, Chapter& chapter) {
  for (std::size_t first = 0; first < runs.size(); first += kMostCurves) {
    const std::size_t last = std::min(runs.size(), first + kMostCurves);
    const auto at = [&](std::size_t i) { return runs.begin() + static_cast<std::ptrdiff_t>(i); };
    Figure figure = curves_figure(spec, {at(first), at(last)});
    if (first > 0) figure.name += fmt::format("-{}", first / kMostCurves + 1);
    chapter.blocks.emplace_back(std::move(figure));
  }
}

}  // namespace

std::vector<FinishedRun> finished_runs(const StudyPlan& plan) {
  std::vector<FinishedRun> runs;
  for (const PlannedPoint& point : plan.points)
    if (point.status.state == PointState::done) {
      runs.push_back(read_finished_run(point.folder, point.resolved.scene, point.name));
      require_sound_results(runs.back());
    }
  return runs;
}

std::string value_text(const PlannedPoint& point, const std::string& path) {
  if (const auto number = number_of(point, path)) return fmt::format("{:.12g}", *number);
  for (const Entry& entry : point.resolved.entries)
    if (entry.path == path) return entry.shown;
  return "absent";
}

std::vector<std::string> varied_keys(const StudyPlan& plan) {
  std::vector<std::string> keys;
  for (const PlannedPoint& point : plan.points)
    for (const StudySetting& setting : point.varied)
      if (std::find(keys.begin(), keys.end(), setting.key) == keys.end()) keys.push_back(setting.key);
  return keys;
}

std::string sweep_csv(const StudyPlan& plan, const std::vector<FinishedRun>& runs) {
  const std::vector<std::string> keys = varied_keys(plan);
  std::string text = "point,state";
  for (const std::string& key : keys) text += fmt::format(",{} [{}]", key, unit_of(key));
  for (const ResultColumn& column : result_columns())
    text += fmt::format(",{} [{}]", column.name, column.unit);
  text += ",warnings [-],state_hash\n";
  for (const PlannedPoint& point : plan.points) {
    text += fmt::format("{},{}", csv_cell(point.name), name_of(point.status.state));
    for (const std::string& key : keys) text += fmt::format(",{}", csv_cell(value_text(point, key)));
    const FinishedRun* run = find_run(runs, point.name);
    for (const ResultColumn& column : result_columns()) {
      const std::optional<double> value = run ? result_of(*run, column) : std::nullopt;
      text += value ? fmt::format(",{:.9g}", *value) : ",";
    }
    text +=
        run ? fmt::format(",{},{}\n", warnings_in(run->summary).size(), text_in(run->summary, "state_hash"))
            : ",,\n";
  }
  return text;
}

std::string sweep_json(const StudyPlan& plan, const std::vector<FinishedRun>& runs) {
  const std::vector<std::string> keys = varied_keys(plan);
  Json points = Json::array();
  for (const PlannedPoint& point : plan.points) {
    Json one = {{"name", point.name}, {"state", name_of(point.status.state)}};
    if (!point.status.why.empty()) one["why"] = point.status.why;
    for (const std::string& key : keys) one["varied"][key] = value_json(point, key);
    const FinishedRun* run = find_run(runs, point.name);
    for (const ResultColumn& column : result_columns())
      if (const auto value = run ? result_of(*run, column) : std::nullopt)
        one[column.name + unit_suffix(column.unit)] = column.truth ? Json(*value != 0) : Json(*value);
    if (run) one["warnings"] = warnings_in(run->summary).size();
    if (run) one["state_hash"] = text_in(run->summary, "state_hash");
    points.push_back(one);
  }
  return json_text({{"points", points}});
}

Table result_table(const std::vector<FinishedRun>& runs) {
  Table table{"", {{.title = "Point", .plain = true}}, {}};
  std::vector<const ResultColumn*> shown;
  const bool some_roll =
      std::any_of(runs.begin(), runs.end(), [](const FinishedRun& run) { return run.number("steps") > 0; });
  for (const ResultColumn& column : result_columns()) {
    if (column.at_rest && some_roll) continue;
    const bool some = std::any_of(runs.begin(), runs.end(),
                                  [&](const FinishedRun& run) { return result_of(run, column).has_value(); });
    if (column.title.empty() || !some) continue;
    shown.push_back(&column);
    table.columns.push_back({column.title, Align::right});
  }
  for (const FinishedRun& run : runs) {
    std::vector<std::string> row = {run.label};
    for (const ResultColumn* column : shown) {
      const auto value = result_of(run, *column);
      row.push_back(!value          ? "–"
                    : column->truth ? (*value != 0 ? "yes" : "no")
                                    : readable(column->scale * *value));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Chapter curve_chapter(std::vector<FinishedRun> rolled) {
  const auto at_rest = [](const FinishedRun& run) { return stands(run.scene); };
  const bool all_stand = std::ranges::all_of(rolled, at_rest);
  if (!all_stand) std::erase_if(rolled, at_rest);
  const auto add_histories = [&](CurvesSpec spec, Chapter& to) {
    if (all_stand) {
      spec.x_label = "Time [ms]";
      for (CurvePanel& panel : spec.panels) panel = over_time(panel);
    }
    add_curves(spec, rolled, to);
  };
  Chapter chapter{"Curves", {}};
  CurvesSpec forces{.title = "Contact forces", .panels = {}, .name = "forces"};
  forces.panels.push_back({"F_N [kN]", {.y = {"vertical_force", "N"}, .y_scale = 1e-3}, "F_N, "});
  forces.panels.push_back({"F_L [kN]", {.y = {"longitudinal_force", "N"}, .y_scale = 1e-3}, "F_L, "});
  add_histories(forces, chapter);
  CurvesSpec creepage{.title = "Longitudinal creepage, mean", .panels = {}, .name = "creepage"};
  creepage.panels.push_back({"Creepage [%]", {.y = {"creepage_mean", "-"}, .y_scale = 100}, "", 200});
  add_histories(creepage, chapter);
  CurvesSpec surface{.title = "What the passage leaves on the patch's longitudinal axis",
                     .x_label = "Position on the rail [m]",
                     .panels = {},
                     .name = "surface"};
  const auto along = [](const char* name, const char* unit, double scale) {
    return RunCurve{.file = "surface_axis.csv", .x = {"x", "m"}, .y = {name, unit}, .y_scale = scale};
  };
  surface.panels.push_back(
      {"Von Mises [MPa]", along("max_von_mises", "Pa", 1e-6), "Von Mises stress, ", 180});
  surface.panels.push_back(
      {"Work [mJ]", along("frictional_work_in_1.1_mm_cell", "J", 1e3), "frictional work, ", 180});
  add_curves(surface, rolled, chapter);
  return chapter;
}

Table point_table(const StudyPlan& plan) {
  Table table{"", {{.title = "Point", .plain = true}, {"State"}}, {}};
  const std::vector<std::string> keys = varied_keys(plan);
  for (const std::string& key : keys)
    table.columns.push_back({fmt::format("{} [{}]", key, unit_of(key)), Align::right});
  table.columns.push_back({"Remark"});
  for (const PlannedPoint& point : plan.points) {
    std::vector<std::string> row = {point.name, name_of(point.status.state)};
    for (const std::string& key : keys) row.push_back(value_text(point, key));
    row.push_back(point.status.why);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table warning_table(const std::vector<FinishedRun>& runs) {
  Table table{"Warnings", {{.title = "Point", .plain = true}, {"Warning"}}, {}};
  for (const SharedWarning& warning : shared_warnings(runs))
    table.rows.push_back({fmt::format("{}", fmt::join(warning.labels, "; ")), warning.text});
  return table;
}

Report sweep_report(const StudyPlan& plan, const std::vector<FinishedRun>& runs,
                    const Provenance& provenance) {
  Report report;
  report.title = plan.study.title.empty() ? plan.study.name : plan.study.title;
  report.subtitle = fmt::format("{} of {} points done · {}", runs.size(), plan.points.size(),
                                plan.study.scene.filename().string());
  Chapter results{"Results", {result_table(runs)}};
  results.blocks.emplace_back(Text{
      "Forces, creepage and stresses: largest and smallest over the evaluated stretch, a corrugation less "
      "half a wave at each end or the solution zone of a smooth rail. Work: in a cell of 1.1 mm x 1.1 mm "
      "on the patch's longitudinal axis there. Passed: the wheel has come to the end of that stretch. "
      "Creepage: mean before it; Steady: F_L / F_N does not drift there. Where the wheel has not "
      "reached the corrugation, all but the steady creepage are empty. Every column and more, in SI: "
      "sweep.csv."});
  report.chapters.push_back(std::move(results));
  if (auto trends = trend_chapter(plan, runs)) report.chapters.push_back(std::move(*trends));
  std::vector<FinishedRun> rolled;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(rolled),
               [](const FinishedRun& run) { return run.rolled(); });
  if (!rolled.empty()) report.chapters.push_back(curve_chapter(rolled));
  Chapter points{"Points", {point_table(plan)}};
  if (Table warnings = warning_table(runs); !warnings.rows.empty())
    points.blocks.emplace_back(std::move(warnings));
  report.chapters.push_back(std::move(points));
  state_provenance(report, plan.study.scene.string(), provenance);
  return report;
}

}  // namespace tread
