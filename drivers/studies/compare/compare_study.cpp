#include "drivers/studies/compare/compare_study.hpp"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "core/error.hpp"
#include "drivers/engine/model/sections.hpp"
#include "drivers/report/figure_parts.hpp"
#include "drivers/results/statistics_json.hpp"
#include "drivers/run/scene_content.hpp"
#include "drivers/studies/compare/curve_comparison.hpp"
#include "io/files/output_file.hpp"
#include "io/report/figure_files.hpp"
#include "io/report/markup.hpp"
#include "io/report/plain_text.hpp"
#include "io/text/json.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

std::optional<double> length_of(const char* option, const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(parse_option(option, text, kLength));
}

ComparisonOptions comparison_options(const CompareOptions& options) {
  ComparisonOptions comparison;
  comparison.mean = length_of("--mean", options.mean).value_or(0);
  if (comparison.mean < 0)
    throw InputError(fmt::format("--mean \"{}\" is negative; state a way such as \"7 mm\"", options.mean));
  comparison.first = length_of("--from", options.first);
  comparison.last = length_of("--to", options.last);
  if (comparison.first && comparison.last && *comparison.first >= *comparison.last)
    throw InputError(fmt::format("--from \"{}\" is not before --to \"{}\"; state them in this order",
                                 options.first, options.last));
  return comparison;
}

/// Everything that a call has read and found.
struct Outcome {
  TransientRun run;
  ForceCurve curve;
  ComparisonOptions choice;
  CurveComparison found;
};

Table comparison_of(const Outcome& o, const std::string& force) {
  const CurveComparison& c = o.found;
  Table table{"",
              {{"Quantity"},
               {"Run", Align::right},
               {"Curve", Align::right},
               {"Curve less run", Align::right},
               {"Unit"}},
              {}};
  const auto row = [&](const std::string& name, double run, double curve, double apart, const char* unit) {
    table.rows.push_back({name, readable(run, 5), readable(curve, 5), readable(apart, 4), unit});
  };
  const auto forces = [&](const std::string& name, double run, double curve) {
    row(name, 1e-3 * run, 1e-3 * curve, 1e-3 * (curve - run), "kN");
  };
  forces("Largest " + force, c.of_run.max, c.of_curve.max);
  forces("Smallest " + force, c.of_run.min, c.of_curve.min);
  forces("Mean " + force, c.of_run.mean, c.of_curve.mean);
  forces("Range", c.of_run.range(), c.of_curve.range());
  if (c.run_shift && c.curve_shift) {
    const double run = *c.run_shift / std::numbers::pi;
    const double curve = *c.curve_shift / std::numbers::pi;
    row("Peaks before the crests", run, curve, std::remainder(curve - run, 2), "pi");
  }
  table.rows.push_back({"Root mean square of the difference", "", "", readable(1e-3 * c.misfit, 4), "kN"});
  if (c.correlation)
    table.rows.push_back({"Correlation", "", "", fmt::format("{:.4f}", *c.correlation), "-"});
  return table;
}

std::string stretch_of(const Outcome& o) {
  const std::string means =
      o.choice.mean > 0 ? fmt::format(", both averaged over {} mm", readable(1e3 * o.choice.mean)) : "";
  return fmt::format("x = {:.4f} to {:.4f} m, {} samples of {}{}", o.found.x.front(), o.found.x.back(),
                     o.found.x.size(), o.run.unfinished.empty() ? "the run" : "a run that is not done",
                     means);
}

Json comparison_json(const Outcome& o, const std::string& force) {
  const CurveComparison& c = o.found;
  Json json = {{"run", o.run.directory.string()},
               {"run_done", o.run.unfinished.empty()},
               {"curve", o.curve.name},
               {"force", force},
               {"stretch_x_m", {c.x.front(), c.x.back()}},
               {"samples", c.x.size()},
               {"mean_over_m", o.choice.mean},
               {"run_N", statistics_json(c.of_run)},
               {"curve_N", statistics_json(c.of_curve)},
               {"rms_difference_N", c.misfit},
               {"correlation", number_or_null(c.correlation)},
               {"run_mean_shift_before_crests_rad", number_or_null(c.run_shift)},
               {"curve_mean_shift_before_crests_rad", number_or_null(c.curve_shift)}};
  return json;
}

Series kilonewtons(std::string label, const std::vector<double>& x, const std::vector<double>& force,
                   Stroke stroke) {
  Series series{std::move(label), x, {}, stroke};
  for (const double value : force) series.y.push_back(1e-3 * value);
  return series;
}

Figure comparison_figure(const Outcome& o, const std::string& force) {
  const CurveComparison& c = o.found;
  const std::optional<CorrugationSpec>& spec = o.run.scene.corrugation;
  Figure figure = over_the_rail("compare", force + ": run and curve", o.run.scene,
                                spec ? corrugation_of(*spec, spec->centre.value_or(0)) : Corrugation(),
                                {c.x.front(), c.x.back()});
  figure.panels.push_back(panel(
      force + " [kN]",
      {kilonewtons("run", c.x, c.run, Stroke::solid), kilonewtons("curve", c.x, c.curve, Stroke::dashed)}, {},
      300));
  std::vector<double> difference = c.curve;
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= c.run[i];
  figure.panels.push_back(
      panel("Curve less run [kN]", {kilonewtons("difference", c.x, difference, Stroke::solid)}, {}, 140));
  return figure;
}

Report comparison_report(const Outcome& o, const CompareOptions& options) {
  Report report;
  report.title = o.run.scene.title;
  report.subtitle =
      fmt::format("{} beside {}", o.run.directory.filename().string(), options.file.filename().string());
  Chapter chapter{"Comparison", {}};
  chapter.blocks.emplace_back(Text{stretch_of(o) + "."});
  chapter.blocks.emplace_back(comparison_of(o, options.force));
  chapter.blocks.emplace_back(comparison_figure(o, options.force));
  report.chapters.push_back(std::move(chapter));
  state_provenance(report, (o.run.directory / kKeptScene).string(), options.origin);
  return report;
}

}  // namespace

void compare_curves(const CompareOptions& options) {
  const ComparisonOptions choice = comparison_options(options);
  Outcome o{read_transient_run(options.run, options.force == "F_L" ? "longitudinal_force" : "vertical_force"),
            read_force_curve(options.file, options.force, options.offset),
            choice,
            {}};
  o.found = compare(o.run, o.curve, choice);
  const std::string json = json_text(comparison_json(o, options.force));
  const std::filesystem::path folder = options.output.empty() ? options.run : options.output;
  make_directory(folder);
  write_text_file(folder / "compare.json", json);
  write_report(folder / "compare.html", comparison_report(o, options));
  if (options.json)
    fmt::print("{}", json);
  else
    fmt::print("{}\n\n{}\nReport  {}\n", stretch_of(o), plain_text(comparison_of(o, options.force)),
               (folder / "compare.html").string());
}

}  // namespace tread
