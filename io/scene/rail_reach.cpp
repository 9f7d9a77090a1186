#include "io/scene/rail_reach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/travel.hpp"
#include "io/scene/schema.hpp"

namespace tread {

int most_fastenings(const FasteningSpec& fastenings, double rail_length) {
  const double most = find_key("fastenings.count")->range.high;
  const double room = rail_length - 0.5 * fastenings.pad_length - fastenings.first + kLengthTolerance;
  const double spans = room / fastenings.spacing;
  return spans >= 0 ? static_cast<int>(std::min(spans, most - 1)) + 1 : 1;
}

std::optional<std::string> keys_to_reach(const Scene& scene, double x) {
  constexpr double kSpare = 0.1;   // the stated duration is rounded up [m]
  constexpr double kDigits = 0.1;  // of the stated length [m]
  const double length = kDigits * std::ceil((x + kSpare + kRailEndMargin + scene.rail->origin) / kDigits);
  if (length > find_key("rail.length")->range.high) return std::nullopt;
  const std::string keys = fmt::format("rail.length = \"{:.6g} m\"", length);
  if (!scene.fastenings) return keys;
  return fmt::format("{} and fastenings.count = {}", keys, most_fastenings(*scene.fastenings, length));
}

void check_on_rail(const RailSpec& rail, double first, double last, std::vector<std::string> keys,
                   const std::string& subject, Require require) {
  const double left = -rail.origin;
  const double right = rail.length - rail.origin;
  require(last >= left - kLengthTolerance && first <= right + kLengthTolerance, std::move(keys),
          fmt::format("{} not on the rail, {:.6g} m to {:.6g} m; move it, or lengthen the rail", subject,
                      left, right));
}

void check_on_rail(const RailSpec& rail, double x, std::vector<std::string> keys, const char* point,
                   Require require) {
  check_on_rail(rail, x, x, std::move(keys), fmt::format("{}, x = {:.6g} m, is", point, x), require);
}

}  // namespace tread
