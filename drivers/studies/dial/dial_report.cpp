#include "drivers/studies/dial/dial_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "drivers/studies/study/study_report.hpp"
#include "io/report/markup.hpp"
#include "io/report/plain_text.hpp"

namespace tread {

namespace {

constexpr double kPercent = 100;

std::string percent_cell(const std::optional<double>& share) {
  constexpr int kDigits = 2;
  return share ? readable(kPercent * *share, kDigits) : "–";
}

std::string cost_label(DialCost cost) {
  return cost == DialCost::minutes ? "Time of a core [min]" : "Element-steps [10⁹]";
}

double shown_cost(const DialRow& row, DialCost cost) {
  return cost == DialCost::minutes ? row.minutes : 1e-9 * row.element_steps();
}

/// Point, cost and `cell(difference)` of every quantity.
template <class Cell>
Table quantity_table(const DialTable& table, const Cell& cell) {
  Table result{"",
               {{.title = "Point", .plain = true},
                {"Element-steps [10⁹]", Align::right},
                {"Core [min]", Align::right}},
               {}};
  for (const DialQuantity& quantity : dial_quantities())
    result.columns.push_back({quantity.title, Align::right});
  for (const DialRow& row : table.rows) {
    std::vector<std::string> cells = {row.point, readable(1e-9 * row.element_steps(), 3),
                                      readable(row.minutes, 3)};
    for (const DialQuantity& quantity : dial_quantities()) {
      const auto found = row.differences.find(quantity.name);
      cells.push_back(found == row.differences.end() ? "–" : cell(found->second));
    }
    result.rows.push_back(std::move(cells));
  }
  return result;
}

Table titled(std::string title, Table table) {
  table.title = std::move(title);
  return table;
}

std::string error_title(const DialTable& table) {
  return has_fluctuation(table) ? "Error / error of the fluctuation [%]" : "Error [%]";
}

std::vector<Table> error_tables(const DialTable& table) {
  const auto means = [](const CurveDifference& d) {
    return percent_cell(d.mean) + " / " + percent_cell(d.range);
  };
  return {
      titled(error_title(table), error_table(table)),
      titled("Shift along the rail, positive further along than the reference [mm]; –: no pattern in common",
             shift_table(table)),
      titled("Mean over the reference's quadratic mean / range over the reference's, difference [%]",
             quantity_table(table, means))};
}

std::vector<Table> effect_tables(const DialTable& effects) {
  return {titled(fmt::format("Difference from {} [%]", effects.reference), error_table(effects)),
          titled(fmt::format("Shift along the rail, positive further along than {} [mm]", effects.reference),
                 shift_table(effects))};
}

std::vector<std::pair<std::string, std::string>> panels() {
  std::vector<std::pair<std::string, std::string>> all;
  for (const DialQuantity& quantity : dial_quantities()) all.emplace_back(quantity.name, quantity.title);
  all.emplace_back(kAllQuantities, "the worst of these");
  return all;
}

Chapter error_chapter(const DialTable& table) {
  Chapter chapter{"Errors", {}};
  chapter.blocks.emplace_back(Text{fmt::format(
      "Against {}. Error: quadratic mean of the difference of the curves over the evaluated stretch once "
      "the shift is taken out, over that of the reference's curve. Error of the fluctuation: over the "
      "standard deviation of that curve.",
      table.reference)});
  for (Table& one : error_tables(table)) chapter.blocks.emplace_back(std::move(one));
  return chapter;
}

Chapter effect_chapter(const DialTable& effects) {
  Chapter chapter{"Single settings", {}};
  chapter.blocks.emplace_back(Text{
      fmt::format("The same measures against {}, for the runs on its mesh: what settings do by themselves.",
                  effects.reference)});
  for (Table& one : effect_tables(effects)) chapter.blocks.emplace_back(std::move(one));
  return chapter;
}

}  // namespace

Table error_table(const DialTable& table) {
  return quantity_table(table, [](const CurveDifference& d) {
    return percent_cell(d.error) + (d.fluctuation ? " / " + percent_cell(d.fluctuation) : "");
  });
}

Table shift_table(const DialTable& table) {
  constexpr double kMillimetres = 1e3;
  return quantity_table(table, [](const CurveDifference& d) {
    return d.shift ? readable(kMillimetres * *d.shift, 2) : std::string("–");
  });
}

Table advice_table(const DialTable& table, DialCost cost) {
  Table advice{"", {{"Wanted error"}}, {}};
  for (const auto& [name, title] : panels()) advice.columns.push_back({title});
  for (const double wanted : {0.2, 0.1, 0.05, 0.02, 0.01}) {
    std::vector<std::string> cells = {fmt::format("{:g} %", kPercent * wanted)};
    for (const auto& [name, title] : panels()) {
      const DialRow* row = cheapest(table, name, wanted, cost);
      cells.push_back(row ? row->point : "–");
    }
    advice.rows.push_back(std::move(cells));
  }
  return advice;
}

Scatter dial_picture(const DialTable& table, DialCost cost) {
  Scatter picture{table.scene, cost_label(cost), "Error [%]", {}, ""};
  for (const auto& [name, title] : panels()) {
    ScatterPanel panel{title, {}};
    const std::vector<const DialRow*> front = pareto_front(table, name, cost);
    const auto dot = [&, &quantity = name](const DialRow& row, bool marked) {
      return ScatterDot{shown_cost(row, cost), kPercent * *error_of(row, quantity), row.point, marked};
    };
    for (const DialRow* row : compared_rows(table, name))
      if (std::find(front.begin(), front.end(), row) == front.end()) panel.dots.push_back(dot(*row, false));
    for (const DialRow* row : front) panel.dots.push_back(dot(*row, true));
    picture.panels.push_back(std::move(panel));
  }
  picture.name = "errors";
  picture.caption = fmt::format("Error against {}. Full dots: nothing measured is both as cheap and as near.",
                                table.reference);
  return picture;
}

Report dial_report(const DialOutcome& outcome, const StudyPlan& plan, const Provenance& provenance) {
  const DialTable& table = outcome.table;
  Report report;
  report.title = plan.study.title.empty() ? plan.study.name : plan.study.title;
  report.subtitle = fmt::format("{} runs · reference {}", table.rows.size(), table.reference);
  Chapter advice{"Which setting", {titled("Cheapest for an error", advice_table(table, outcome.cost))}};
  advice.blocks.emplace_back(dial_picture(table, outcome.cost));
  report.chapters.push_back(std::move(advice));
  report.chapters.push_back(error_chapter(table));
  if (!outcome.effects.rows.empty()) report.chapters.push_back(effect_chapter(outcome.effects));
  report.chapters.push_back(curve_chapter(outcome.runs));
  report.chapters.push_back({"Points", {point_table(plan)}});
  state_provenance(report, plan.study.scene.string(), provenance);
  return report;
}

std::string dial_markdown(const DialOutcome& outcome) {
  std::vector<Table> tables = error_tables(outcome.table);
  if (!outcome.effects.rows.empty())
    for (Table& one : effect_tables(outcome.effects)) tables.push_back(std::move(one));
  tables.push_back(titled("Cheapest for an error", advice_table(outcome.table, outcome.cost)));
  std::string text;
  for (const Table& table : tables)
    text += fmt::format("{}{}:\n\n{}", text.empty() ? "" : "\n", table.title, markdown(table));
  return text;
}

}  // namespace tread
