#include "drivers/studies/dial/dial_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/results/scene_model.hpp"
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

/// "measured on "TITLE" against REFERENCE"; a passage may have no title.
std::string measured_text(const Advice& advice) {
  const std::string on = advice.measured_on.empty() ? "" : fmt::format(" on \"{}\"", advice.measured_on);
  return fmt::format("          measured{} against {}\n", on, advice.reference);
}

}  // namespace

std::optional<Advice> advise(const ResolvedScene& resolved, const AdviceOptions& options) {
  if (options.error.empty()) return std::nullopt;
  require_quantity("--quantity", options.quantity);
  const DialTable table = options.dial.empty() ? measured_dial() : read_dial(options.dial);
  Advice advice{wanted_error(options.error), options.quantity, table.scene, table.reference, {}, {}, {}};
  const std::vector<const DialRow*> front = pareto_front(table, advice.quantity, dial_cost(options.cost));
  if (!front.empty()) advice.nearest = *front.back();
  if (const DialRow* row = cheapest(table, advice.quantity, advice.wanted, dial_cost(options.cost))) {
    advice.row = *row;
    advice.hidden_quality = hides_quality(resolved, *row);
    const ResolvedScene other = scene_with(resolved, row->settings, advice.hidden_quality);
    try {
      Model model = scene_model(other.scene, other);
      advice.cost = estimate(model, file_bytes(other.source));
    } catch (const Error& error) {
      advice.no_cost = error.what();
    }
  }
  return advice;
}

std::string advice_text(const Advice& advice) {
  const std::string what = advice.quantity == kAllQuantities ? "every quantity" : advice.quantity;
  std::string text = fmt::format("Error     at most {} in {}: ", percent_text(advice.wanted), what);
  if (!advice.row) {
    text += "no setting measured is as near";
    if (advice.nearest)
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
  if (!advice.cost) return text + fmt::format("          this scene with it: {}\n", advice.no_cost);
  return text + fmt::format("          this scene with it: about {}, {} elements, {} steps\n",
                            duration_text(advice.cost->seconds()), advice.cost->elements, advice.cost->steps);
}

Json advice_json(const Advice& advice) {
  Json json = {{"wanted", advice.wanted},
               {"quantity", advice.quantity},
               {"measured_on", advice.measured_on},
               {"reference", advice.reference}};
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
