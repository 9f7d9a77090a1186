#include "drivers/studies/dial/dial_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/results/depth_warnings.hpp"
#include "drivers/results/resolution.hpp"
#include "drivers/results/scene_model.hpp"
#include "drivers/run/scene_content.hpp"
#include "io/report/markup.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

double wanted_error(const std::string& text) {
  try {
    const bool percent = text.ends_with("%");
    std::string number = percent ? text.substr(0, text.size() - 1) : text;
    number.erase(number.find_last_not_of(' ') + 1);
    const double error = parse_number(number) / (percent ? 100 : 1);
    if (error > 0 && error < 1) return error;
  } catch (const InputError&) {
    // told below
  }
  throw InputError(fmt::format("--error {}: expected a share above 0 and below 100 %, such as 2%", text));
}

/// With the settings; `hidden_quality`: without the scene's element size, as the advice says.
ResolvedScene scene_with(const ResolvedScene& resolved, const std::vector<std::string>& settings,
                         bool hidden_quality) {
  std::vector<std::string> overrides = resolved.overrides;
  overrides.insert(overrides.end(), settings.begin(), settings.end());
  ResolvedScene other = resolve_scene(resolved.source, overrides);
  if (!hidden_quality) return other;
  other.scene.element_size.reset();
  std::erase_if(other.entries, [](const Entry& entry) { return entry.path == "scene.element_size"; });
  return other;
}

std::string settings_text(const DialRow& row) {
  std::string text;
  for (const std::string& one : row.settings) text += fmt::format(" --set \"{}\"", one);
  return text;
}

/// Returns true if the scene's element size overrides the row's quality.
bool hides_quality(const ResolvedScene& resolved, const DialRow& row) {
  const auto sets = [&](const char* key) {
    return std::any_of(row.settings.begin(), row.settings.end(),
                       [&](const std::string& one) { return one.starts_with(std::string(key) + "="); });
  };
  return resolved.scene.element_size && sets("scene.quality") && !sets("scene.element_size");
}

std::string percent_text(double share) {
  return readable(100 * share, 2) + " %";
}

/// Returns true if the quantity's mean is prescribed, or that of one among all.
bool is_prescribed(const std::string& quantity) {
  return std::any_of(dial_quantities().begin(), dial_quantities().end(), [&](const DialQuantity& one) {
    return one.prescribed && (quantity == one.name || quantity == kAllQuantities);
  });
}

/// "measured on "TITLE" against REFERENCE"; a passage may have no title.
std::string measured_text(const Advice& advice) {
  const std::string on = advice.measured_on.empty() ? "" : fmt::format(" on \"{}\"", advice.measured_on);
  const bool of_mean = is_prescribed(advice.quantity) && !advice.of_fluctuation;
  return fmt::format("          measured{} against {}{}\n", on, advice.reference,
                     of_mean ? "; shares of the mean, static load included" : "");
}

/// Returns true if settings of the row have no effect on the scene: it lacks their keys, and a row without
/// them makes the same of it.
bool has_idle_setting(const ResolvedScene& resolved, const DialRow& row, const DialTable& table) {
  const ResolvedScene changed = scene_with(resolved, row.settings, hides_quality(resolved, row));
  const auto idle = [&](const std::string& setting) {
    const std::string key = setting.substr(0, setting.find('='));
    return std::ranges::find(changed.entries, key, &Entry::path) == changed.entries.end();
  };
  std::vector<std::string> telling;
  std::ranges::remove_copy_if(row.settings, std::back_inserter(telling), idle);
  if (telling.size() == row.settings.size()) return false;
  return std::ranges::any_of(table.rows, [&](const DialRow& other) {
    return other.point != table.reference && std::ranges::is_permutation(other.settings, telling) &&
           scene_content(scene_with(resolved, telling, hides_quality(resolved, other))) ==
               scene_content(changed);
  });
}

/// Sentences on what the mesh does not resolve for the quantity; forces need less of the patch.
std::vector<std::string> mesh_warnings(const Model& model, const std::string& quantity) {
  std::vector<std::string> warnings = coarse_depth_warnings(model);
  const bool force = quantity != kAllQuantities && is_prescribed(quantity);
  const std::optional<double> across = too_few_elements_across_patch(model);
  if (across && (!force || *across < kElementsOfForce))
    warnings.push_back(fmt::format("the contact patch has {:.1f} elements across, too few for {}", *across,
                                   quantity == kAllQuantities ? "every quantity" : quantity));
  return warnings;
}

/// Sets warnings of the scene with the row's settings, and its cost where there are none or `takes_any`.
/// Returns true where there are none or it takes any.
bool takes(const ResolvedScene& resolved, const DialRow& row, bool takes_any, Advice& advice) {
  advice.hidden_quality = hides_quality(resolved, row);
  advice.warnings.clear();
  advice.cost.reset();
  advice.no_cost.clear();
  const ResolvedScene other = scene_with(resolved, row.settings, advice.hidden_quality);
  try {
    Model model = scene_model(other.scene, other);
    advice.warnings = mesh_warnings(model, advice.quantity);
    if (!takes_any && !advice.warnings.empty()) return false;
    advice.cost = estimate(model, file_bytes(other.source));
  } catch (const Error& error) {
    advice.no_cost = error.what();
  }
  return true;
}

/// The table that the options name. InputError for minutes of the shipped one.
DialTable stated_table(const AdviceOptions& options) {
  const DialCost cost = dial_cost(options.cost);
  if (!options.dial.empty()) return read_dial(options.dial);
  if (cost == DialCost::minutes)
    throw InputError(
        "--cost minutes: the runs of the shipped table shared their processor with other work, so that their "
        "minutes compare nothing; use element-steps, or name a dial of your own with --dial");
  return measured_dial();
}

}  // namespace

std::optional<Advice> advise(const ResolvedScene& resolved, const AdviceOptions& options) {
  if (options.error.empty()) return std::nullopt;
  require_quantity("--quantity", options.quantity);
  DialTable table = stated_table(options);
  const DialCost cost = dial_cost(options.cost);
  Advice advice{.wanted = wanted_error(options.error),
                .quantity = options.quantity,
                .measured_on = table.scene,
                .reference = table.reference,
                .of_fluctuation = has_fluctuation(table)};
  const std::vector<const DialRow*> front = pareto_front(table, advice.quantity, cost);
  if (!front.empty()) advice.nearest = *front.back();
  while (const DialRow* row = cheapest(table, advice.quantity, advice.wanted, cost)) {
    if (has_idle_setting(resolved, *row, table)) {
      table.rows.erase(table.rows.begin() + (row - table.rows.data()));
      continue;
    }
    if (takes(resolved, *row, !options.dial.empty(), advice)) {
      advice.row = *row;
      break;
    }
    // Rows on the same mesh or a coarser one do not resolve the scene either.
    std::erase_if(table.rows, [most = row->elements](const DialRow& one) { return one.elements <= most; });
  }
  return advice;
}

std::string advice_text(const Advice& advice) {
  const std::string what = advice.quantity == kAllQuantities ? "every quantity" : advice.quantity;
  std::string text = fmt::format("Error     at most {} in {}: ", percent_text(advice.wanted), what);
  if (!advice.row) {
    text += "no setting measured is as near";
    if (!advice.warnings.empty())
      text += fmt::format(" and resolves this scene ({}); measure your own with `tread dial`",
                          fmt::join(advice.warnings, "; "));
    else if (advice.nearest)
      text += fmt::format("; the nearest, {}, is {} off", advice.nearest->point,
                          percent_text(error_of(*advice.nearest, advice.quantity).value_or(0)));
    else
      text +=
          "; its runs have no error of that quantity: do they reach the stretch that is evaluated, under "
          "traction?";
    return text + "\n" + measured_text(advice);
  }
  text += fmt::format("{}, which was {} off\n", advice.row->point,
                      percent_text(error_of(*advice.row, advice.quantity).value_or(0)));
  text += measured_text(advice);
  text += fmt::format("         {}\n", settings_text(*advice.row));
  if (advice.hidden_quality)
    text += "          and scene.element_size left out of the scene, which hides the quality\n";
  for (const std::string& warning : advice.warnings) text += fmt::format("          warning: {}\n", warning);
  if (!advice.cost) return text + fmt::format("          this scene with it: {}\n", advice.no_cost);
  return text + fmt::format("          this scene with it: about {}, {} elements, {} steps\n",
                            duration_text(advice.cost->seconds()), advice.cost->elements, advice.cost->steps);
}

Json advice_json(const Advice& advice) {
  Json json = {{"wanted", advice.wanted},
               {"quantity", advice.quantity},
               {"measured_on", advice.measured_on},
               {"reference", advice.reference}};
  if (!advice.warnings.empty()) json["warnings"] = advice.warnings;
  if (advice.row) {
    json["point"] = advice.row->point;
    json["error"] = error_of(*advice.row, advice.quantity).value_or(0);
    json["settings"] = advice.row->settings;
    if (advice.hidden_quality) json["left_out"] = Json::array({"scene.element_size"});
    if (advice.cost)
      json["seconds"] = advice.cost->seconds();
    else
      json["no_cost"] = advice.no_cost;
  }
  return json;
}

}  // namespace tread
