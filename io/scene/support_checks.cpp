#include "io/scene/support_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "io/scene/key.hpp"

namespace tread {

namespace {

void check_fastenings(const Scene& scene, const FasteningSpec& fastenings, Require require) {
  const RailSpec& rail = *scene.rail;
  const double half = fastenings.pad_length / 2;
  const double last = fastenings.first + (fastenings.count - 1) * fastenings.spacing;
  require(fastenings.first - half >= -kLengthTolerance, {"fastenings.first", "fastenings.pad_length"},
          "the first fastening's pad begins before the rail's left end");
  require(
      last + half <= rail.length + kLengthTolerance,
      {"fastenings.count", "fastenings.spacing", "fastenings.first", "fastenings.pad_length", "rail.length"},
      fmt::format("the last fastening's pad ends at {:.6g} m, beyond the rail of {:.6g} m", last + half,
                  rail.length));
  require(fastenings.count == 1 || fastenings.pad_length <= fastenings.spacing,
          {"fastenings.pad_length", "fastenings.spacing"}, "the pads of neighbouring fastenings overlap");
  require(fastenings.across.kind != "free" || scene.plane_strain, {"fastenings.across"},
          "nothing would hold the rail sideways; state \"held\", or \"elastic\" with "
          "fastenings.across_stiffness");
  require(rail.profile != "box" || fastenings.pad_width <= rail.width + kLengthTolerance,
          {"fastenings.pad_width", "rail.width"}, "the pad is wider than the rail");
}

void check_sleepers(const SleeperSpec& sleepers, const FasteningSpec& fastenings, Require require) {
  require(fastenings.count == 1 || sleepers.width < fastenings.spacing,
          {"sleepers.width", "fastenings.spacing"}, "neighbouring sleepers overlap");
  require(fastenings.pad_length <= sleepers.width + kLengthTolerance,
          {"sleepers.width", "fastenings.pad_length"}, "the pad is longer than the sleeper is wide");
  const double inner = sleepers.offset - 0.5 * sleepers.length;
  const double outer = sleepers.offset + 0.5 * sleepers.length;
  require(inner <= -0.5 * fastenings.pad_width && outer >= 0.5 * fastenings.pad_width,
          {"sleepers.offset", "sleepers.length"},
          fmt::format("the pad does not lie on the sleeper, y = {:.4g} m to {:.4g} m", inner, outer));
}

/// The place of a shifted support between its neighbours and on the rail.
void check_shift(const Scene& scene, const std::string& table, int fastening, Require require) {
  const FasteningSpec& f = *scene.fastenings;
  const double length = scene.sleepers ? std::max(f.pad_length, scene.sleepers->width) : f.pad_length;
  const double at = scene.fastening_x(fastening);
  const double left = -scene.rail->origin;
  const std::vector<std::string> keys = {table + ".shift", table};
  const auto apart = [&](int before, int after) {
    return before < 0 || after >= f.count ||
           scene.fastening_x(after) - scene.fastening_x(before) >= length - kLengthTolerance;
  };
  require(apart(fastening - 1, fastening) && apart(fastening, fastening + 1), keys,
          fmt::format("at x = {:.6g} m it overlaps its neighbour; state a smaller shift", at));
  require(at - 0.5 * f.pad_length >= left - kLengthTolerance &&
              at + 0.5 * f.pad_length <= left + scene.rail->length + kLengthTolerance,
          keys, fmt::format("at x = {:.6g} m its pad reaches beyond the rail; state a smaller shift", at));
}

void check_altered(const Scene& scene, Require require) {
  const FasteningSpec& f = *scene.fastenings;
  std::map<int, std::string> altered;
  for (const auto& [name, support] : scene.supports) {
    const std::string table = std::string(kSupportTables) + name;
    const int fastening = support.fastening - 1;
    require(fastening < f.count, {table + ".fastening", "fastenings.count"},
            fmt::format("there is no fastening {}: they count {}", support.fastening, f.count));
    const auto [known, fresh] = altered.emplace(fastening, name);
    require(fresh, {table + ".fastening"},
            fmt::format("[{}{}] alters fastening {} too; state both in one table", kSupportTables,
                        known->second, support.fastening));
    if (fastening >= f.count || !fresh) continue;
    if (support.shift != 0) check_shift(scene, table, fastening, require);
    require(!scene.sleepers || support.stiffness > 0 || support.bed > 0,
            {table + ".stiffness", table + ".bed"},
            "nothing carries its sleeper; state a share above 0 for the fastening or for the bed");
  }
  const auto left = [&](auto property) {
    return f.count > std::count_if(scene.supports.begin(), scene.supports.end(),
                                   [&](const auto& named) { return !property(named.second); });
  };
  const std::vector<std::string> keys = {"support", "fastenings.count"};
  require(left([](const SupportSpec& s) { return s.stiffness > 0 && s.bed > 0; }), keys,
          "nothing carries the rail: every support is broken or hangs");
  require(left([](const SupportSpec& s) { return s.holds; }), keys,
          "nothing holds the rail's foot; state holds = true for one of them");
}

}  // namespace

void check_supports(const Scene& scene, Require require) {
  for (const auto& [name, support] : scene.supports)
    require(scene.fastenings.has_value(), {std::string(kSupportTables) + name},
            "a support is one of the fastenings; add [fastenings]");
  if (!scene.rail || !scene.fastenings) return;
  check_fastenings(scene, *scene.fastenings, require);
  if (scene.sleepers) check_sleepers(*scene.sleepers, *scene.fastenings, require);
  check_altered(scene, require);
}

}  // namespace tread
