#include "drivers/studies/roughness/roughness_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/studies/roughness/level_figure.hpp"
#include "drivers/studies/roughness/roughness_levels.hpp"
#include "io/files/named_output.hpp"
#include "io/files/output_file.hpp"
#include "io/report/figure_files.hpp"
#include "io/report/markup.hpp"
#include "io/report/plain_text.hpp"
#include "io/report/report.hpp"
#include "io/text/json.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

constexpr double kStandardRecord = 1;      ///< least length of a record [EN 15610] [m]
constexpr double kStandardSpacing = 1e-3;  ///< largest distance of samples [m]

/// A profile and what was done to it.
struct Outcome {
  RoughnessProfile profile;
  int spikes = 0;
  double pits = 0;  ///< largest change by the disc [m]
  RoughnessLevels levels;
};

std::string decibels(double value) {
  return fmt::format("{}{:.1f}", value < -0.05 ? "−" : "", std::abs(value));
}

Table level_table(const Outcome& o) {
  Table table{"",
              {{"Wavelength [mm]", Align::right},
               {"Level [dB re 1 µm]", Align::right},
               {"Limit of ISO 3095", Align::right},
               {"Above it [dB]", Align::right}},
              {}};
  const std::vector<RoughnessBand>& bands = roughness_bands();
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const std::optional<double>& level = o.levels.level[i];
    table.rows.push_back({readable(1e3 * bands[i].nominal), level ? decibels(*level) : "–",
                          decibels(bands[i].limit), level ? decibels(*level - bands[i].limit) : "–"});
  }
  return table;
}

/// Processing of the levels, and where the record falls short of the standard.
std::string account(const Outcome& o, const RoughnessOptions& options) {
  const RoughnessProfile& p = o.profile;
  std::string text = fmt::format("{} samples every {} mm, {} m; {} segments of {} m. ", p.height.size(),
                                 readable(1e3 * p.spacing, 3), readable(p.length()), o.levels.segments,
                                 readable(o.levels.segment_length, 3));
  text += options.raw ? "Neither spikes nor pits removed."
                      : fmt::format(
                            "{} spikes cut off; the disc of 0.375 m changed the profile by {} µm at "
                            "the most.",
                            o.spikes, readable(1e6 * o.pits, 3));
  if (p.resampled) text += " The distances were uneven: interpolated.";
  if (p.length() < kStandardRecord - 0.5 * p.spacing)
    text += fmt::format(" EN 15610 asks for a record of {} m.", kStandardRecord);
  if (p.spacing > 1.001 * kStandardSpacing)
    text += fmt::format(" EN 15610 asks for a sample every {} mm.", 1e3 * kStandardSpacing);
  for (const std::optional<double>& level : o.levels.level)
    if (!level) return text + " –: less than four waves in a segment or 2.5 samples in a wave.";
  return text;
}

std::string levels_csv(const Outcome& o) {
  std::string text = "wavelength [m],level [dB re 1 um],limit_iso_3095 [dB re 1 um]\n";
  const std::vector<RoughnessBand>& bands = roughness_bands();
  for (std::size_t i = 0; i < bands.size(); ++i)
    text += fmt::format("{:g},{},{:g}\n", bands[i].nominal,
                        o.levels.level[i] ? fmt::format("{:.3f}", *o.levels.level[i]) : "", bands[i].limit);
  return text;
}

std::string levels_json(const Outcome& o, const RoughnessOptions& options) {
  Json json = {{"file", options.file.string()},     {"samples", o.profile.height.size()},
               {"spacing_m", o.profile.spacing},    {"interpolated", o.profile.resampled},
               {"segments", o.levels.segments},     {"segment_length_m", o.levels.segment_length},
               {"processed", !options.raw},         {"spikes", o.spikes},
               {"largest_change_by_disc_m", o.pits}};
  const std::vector<RoughnessBand>& bands = roughness_bands();
  json["bands"] = Json::array();
  for (std::size_t i = 0; i < bands.size(); ++i)
    json["bands"].push_back({{"wavelength_m", bands[i].nominal},
                             {"level_dB_re_1_um", number_or_null(o.levels.level[i])},
                             {"limit_iso_3095_dB_re_1_um", bands[i].limit}});
  return json_text(json);
}

Figure profile_figure(const Outcome& o) {
  Series line{"profile, processed", {}, {}, Stroke::solid};
  for (std::size_t i = 0; i < o.profile.height.size(); ++i) {
    line.x.push_back(static_cast<double>(i) * o.profile.spacing);
    line.y.push_back(1e6 * o.profile.height[i]);
  }
  Figure figure;
  figure.title = "Profile";
  figure.x_label = "Along the rail [m]";
  figure.panels = {{"Height [µm]", {std::move(line)}, {}, 180, std::nullopt}};
  return figure;
}

Report report_of(const Outcome& o, const RoughnessOptions& options) {
  Report report;
  report.title = "Roughness of " + options.file.filename().string();
  report.subtitle = "Processing after EN 15610";
  report.footer = options.command;
  report.chapters.push_back(
      {"Levels", {level_figure({{"rail", o.levels}}), Text{account(o, options)}, level_table(o)}});
  report.chapters.push_back({"Profile", {profile_figure(o)}});
  return report;
}

TableRules rules_of(const RoughnessOptions& options) {
  TableRules rules{.needs_units = true, .increasing = true, .names = kDepthNames};
  rules.example = options.depth ? "x [m]  depth [um]" : "x [m]  height [um]";
  rules.units_option = "--units m,um";
  if (options.units.empty()) return rules;
  const auto comma = options.units.find(',');
  if (comma == std::string::npos)
    throw InputError(
        fmt::format("--units {}: expected the units of both columns, for example m,um", options.units));
  rules.units = {options.units.substr(0, comma), options.units.substr(comma + 1)};
  for (const std::string& unit : *rules.units) {
    try {
      parse_quantity("1 " + unit, kLength);
    } catch (const InputError& error) {
      throw InputError(fmt::format("--units {}: {}", options.units, error.what()));
    }
  }
  return rules;
}

bool is_flat(const std::vector<double>& heights) {
  return std::adjacent_find(heights.begin(), heights.end(), std::not_equal_to<>()) == heights.end();
}

Outcome processed(const RoughnessOptions& options) {
  Outcome o;
  TwoColumns rows = read_two_columns(options.file, rules_of(options));
  if (!rows.second.empty() && is_flat(rows.second))
    throw InputError(fmt::format(
        "{}: the record is flat, all heights are {:.6g} um, so it has no levels; is it the column "
        "of the height, and has the file its digits?",
        options.file.string(), 1e6 * rows.second.front()));
  if (options.depth)
    for (double& value : rows.second) value = -value;
  o.profile = even_profile(rows, options.file.string());
  if (!options.raw) {
    o.spikes = remove_spikes(o.profile);
    if (is_flat(o.profile.height))
      throw InputError(fmt::format(
          "{}: the profile is flat once its spikes ({}) are cut off, so it has no levels; state --raw "
          "to keep them, or measure again",
          options.file.string(), o.spikes));
    o.pits = close_pits(o.profile);
  }
  const double segment = parse_option("--segment", options.segment, kLength);
  if (segment <= 0) throw InputError(fmt::format("--segment {}: it must be above 0", options.segment));
  o.levels = roughness_levels(o.profile, segment);
  return o;
}

}  // namespace

void roughness(const RoughnessOptions& options) {
  if (!options.output.empty()) {
    require_folder_of(options.output, "roughness");
    for (const char* name : {"levels.csv", "levels.svg", "report.html"})
      require_other_file(options.output / name, options.file);
  }
  use_threads(options.threads);
  const Outcome outcome = processed(options);
  if (!options.output.empty()) {
    make_directory(options.output);
    write_text_file(options.output / "levels.csv", levels_csv(outcome));
    write_text_file(options.output / "levels.svg", figure_svg(level_figure({{"rail", outcome.levels}})));
    write_report(options.output / "report.html", report_of(outcome, options));
  }
  if (options.json) {
    fmt::print("{}", levels_json(outcome, options));
    return;
  }
  fmt::print("{}{}\n", plain_text(level_table(outcome)), account(outcome, options));
}

}  // namespace tread
