#include "drivers/results/rail_ends.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/travel.hpp"
#include "drivers/engine/model/sections.hpp"
#include "io/scene/rail_reach.hpp"

namespace tread {

namespace {

/// Way out for a wheel that rolls too far to a side.
std::string shorter_way(const Model& model, double last, bool ahead) {
  const std::string longer = ahead ? keys_for_way(model, last).value_or("") : "a larger rail.origin";
  return fmt::format("a shorter motion.duration{}{}", longer.empty() ? "" : ", or ", longer);
}

}  // namespace

double searched_reach(const Model& model) {
  return model.contact->reach_over(corrugation_depth(model.scene));
}

Span searched_way(const Model& model) {
  const std::vector<double>& stations = model.contact->surfaces().rail().stations;
  const double reach = searched_reach(model);
  return {stations.front() + reach, stations.back() - reach};
}

std::optional<std::string> keys_for_way(const Model& model, double x) {
  const double end = model.scene.rail->length - model.scene.rail->origin;
  if (x <= std::min(searched_way(model).last, end - kRailEndMargin)) return "";
  const double more = std::max(searched_reach(model) - kRailEndMargin, 0.0);  // than keys_to_reach() allows
  return keys_to_reach(model.scene, x + more);
}

void require_way_on_rail(const Model& model) {
  if (!model.contact) return;
  const Span allowed = searched_way(model);
  const Travel travel = travel_of(model.scene);
  const double start = model.scene.start_x();
  const auto refuse = [&](const char* comes, double x, const std::string& way_out) {
    throw InputError(fmt::format(
        "the wheel {} x = {:.6g} m, but its axis has to stay within x = {:.6g} to {:.6g} m, as the patch is "
        "searched for within {:.3g} mm of it on the rail, x = {:.6g} to {:.6g} m; state {}",
        comes, x, allowed.first, allowed.last, 1e3 * searched_reach(model), -model.scene.rail->origin,
        model.scene.rail->length - model.scene.rail->origin, way_out));
  };
  if (start < allowed.first || start > allowed.last)
    refuse("stands at", start, "a lower load, a longer rail.length, or another rail.origin");
  if (travel.last > allowed.last) refuse("rolls to", travel.last, shorter_way(model, travel.last, true));
  if (travel.first < allowed.first) refuse("rolls to", travel.first, shorter_way(model, travel.first, false));
}

}  // namespace tread
