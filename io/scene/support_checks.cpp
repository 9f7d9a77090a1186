#include "io/scene/support_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>

#include "core/geometry/built_in_profiles.hpp"
#include "io/scene/key.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

void check_fastenings(const Scene& scene, const FasteningSpec& fastenings, Require require) {
  const RailSpec& rail = *scene.rail;
  const double half = fastenings.pad_length / 2;
  const double last = fastenings.first + (fastenings.count - 1) * fastenings.spacing;
  require(fastenings.first - half >= -kLengthTolerance, {"fastenings.first", "fastenings.pad_length"},
          fmt::format("the first fastening's pad begins {:.6g} m before the rail's left end; state a larger "
                      "fastenings.first or a shorter fastenings.pad_length",
                      half - fastenings.first));
  require(
      last + half <= rail.length + kLengthTolerance,
      {"fastenings.count", "fastenings.spacing", "fastenings.first", "fastenings.pad_length", "rail.length"},
      fmt::format("the last fastening's pad ends at {:.6g} m, beyond the rail of {:.6g} m; state a smaller "
                  "fastenings.count or a larger rail.length",
                  last + half, rail.length));
  require(
      fastenings.count == 1 || fastenings.pad_length <= fastenings.spacing,
      {"fastenings.pad_length", "fastenings.spacing"},
      fmt::format("the pads of neighbouring fastenings overlap: they are {} long, {} apart; state a shorter "
                  "fastenings.pad_length or a larger fastenings.spacing",
                  format_quantity(fastenings.pad_length, "mm"), format_quantity(fastenings.spacing, "mm")));
  require(fastenings.across.kind != "free" || scene.plane_strain, {"fastenings.across"},
          "nothing would hold the rail sideways; state \"held\", or \"elastic\" with "
          "fastenings.across_stiffness");
  require(rail.profile != "box" || fastenings.pad_width <= rail.width + kLengthTolerance,
          {"fastenings.pad_width", "rail.width"},
          fmt::format("the pad, {}, is wider than the rail, {}; state a smaller fastenings.pad_width",
                      format_quantity(fastenings.pad_width, "mm"), format_quantity(rail.width, "mm")));
}

/// Half the width of the foot of a rail's section [m].
double half_foot(const RailProfile& section) {
  double half = 0;
  for (const double s : section.lower.joints(0, section.lower.length()))
    half = std::max(half, section.lower.at(s).position.x);
  return half;
}

/// The foot of a rail whose section is built in.
struct RailFoot {
  std::string section;
  double middle, half;  ///< of its width: y of the middle, where the rail leans about its crown [m]
};

/// None where a body or a box is the rail.
std::optional<RailFoot> rail_foot(const Scene& scene) {
  const RailSpec& rail = *scene.rail;
  const std::string& name = rail.profile_y.empty() ? rail.profile : rail.section;
  if (scene.body_replacing("rail") || rail.profile == "box" ||
      std::ranges::find(kBuiltInRails, name) == kBuiltInRails.end())
    return {};
  const RailProfile section = built_in_rail(name);
  const double angle = std::atan(rail.inclination);
  return RailFoot{name, section.height * std::sin(angle), half_foot(section) * std::cos(angle)};
}

/// The outer spring-dampers act on the foot and on the slab.
void check_widths(const Scene& scene, const FasteningSpec& fastenings, Require require) {
  const RailSpec& rail = *scene.rail;
  if (scene.body_replacing("rail")) return;
  const double outermost = fastenings.row_offset(fastenings.rows - 1);
  const std::optional<RailFoot> foot = rail_foot(scene);
  if (!foot && rail.profile != "box") return;
  const double middle = foot ? foot->middle : 0;
  if (foot)
    require(
        outermost <= foot->half + kLengthTolerance,
        {"fastenings.pad_width", "fastenings.rows", rail.profile_y.empty() ? "rail.profile" : "rail.section"},
        fmt::format("the outer spring-dampers lie {:.4g} mm from the middle of the foot, half of which is "
                    "{:.4g} mm wide ({}); state a smaller fastenings.pad_width",
                    1e3 * outermost, 1e3 * foot->half, foot->section));
  if (!scene.slab_track) return;
  const SlabSpec& slab = *scene.slab_track;
  const double left = slab.offset - 0.5 * slab.width, right = slab.offset + 0.5 * slab.width;
  require(
      middle - outermost >= left - kLengthTolerance && middle + outermost <= right + kLengthTolerance,
      {"slab.width", "slab.offset", "fastenings.pad_width", "fastenings.rows"},
      fmt::format("the slab lies from y = {:.4g} m to {:.4g} m, the fastenings' spring-dampers from {:.4g} m "
                  "to {:.4g} m; state a larger slab.width, another slab.offset or a smaller "
                  "fastenings.pad_width",
                  left, right, middle - outermost, middle + outermost));
}

void check_sleepers(const Scene& scene, const FasteningSpec& fastenings, Require require) {
  const SleeperSpec& sleepers = *scene.sleepers;
  require(fastenings.count == 1 || sleepers.width < fastenings.spacing,
          {"sleepers.width", "fastenings.spacing"},
          fmt::format("neighbouring sleepers overlap: they are {} wide, {} apart; state a smaller "
                      "sleepers.width or a larger fastenings.spacing",
                      format_quantity(sleepers.width, "mm"), format_quantity(fastenings.spacing, "mm")));
  require(fastenings.pad_length <= sleepers.width + kLengthTolerance,
          {"sleepers.width", "fastenings.pad_length"},
          fmt::format("the pad, {} long, is longer than the sleeper is wide, {}; state a shorter "
                      "fastenings.pad_length or a larger sleepers.width",
                      format_quantity(fastenings.pad_length, "mm"), format_quantity(sleepers.width, "mm")));
  const double inner = sleepers.offset - 0.5 * sleepers.length;
  const double outer = sleepers.offset + 0.5 * sleepers.length;
  const std::optional<RailFoot> foot = rail_foot(scene);
  const double outermost = fastenings.row_offset(fastenings.rows - 1), middle = foot ? foot->middle : 0;
  require(middle - outermost >= inner - kLengthTolerance && middle + outermost <= outer + kLengthTolerance,
          {"sleepers.offset", "sleepers.length", "fastenings.pad_width", "fastenings.rows"},
          fmt::format("the pad does not lie on the sleeper, y = {:.4g} m to {:.4g} m: the fastenings' "
                      "spring-dampers lie from {:.4g} m to {:.4g} m; state a larger sleepers.length, another "
                      "sleepers.offset or a smaller fastenings.pad_width",
                      inner, outer, middle - outermost, middle + outermost));
}

/// A support that differs, and where the scene says so.
struct AlteredSupport {
  SupportSpec support;
  std::string table;  ///< "support.NAME"; empty: a row of the file

  /// The keys of these members; "" stands for the table itself.
  std::vector<std::string> keys(std::initializer_list<const char*> members) const {
    if (table.empty()) return {"fastenings.supports"};
    std::vector<std::string> list;
    for (const char* member : members) list.push_back(*member == 0 ? table : table + "." + member);
    return list;
  }
  std::string place() const { return table.empty() ? "the file of fastenings.supports" : "[" + table + "]"; }
  /// Begins a message: the keys of a file do not say which row it is.
  std::string subject() const {
    return table.empty() ? fmt::format("fastening {}: ", support.fastening) : "";
  }
};

std::vector<AlteredSupport> altered_supports(const Scene& scene) {
  std::vector<AlteredSupport> list;
  for (const auto& [name, support] : scene.supports)
    list.push_back({support, std::string(kSupportTables) + name});
  for (const SupportSpec& support : scene.fastenings->listed) list.push_back({support, ""});
  return list;
}

/// The place of a shifted support between its neighbours and on the rail.
void check_shift(const Scene& scene, const AlteredSupport& altered, Require require) {
  const FasteningSpec& f = *scene.fastenings;
  const int fastening = altered.support.fastening - 1;
  const double length = scene.sleepers ? std::max(f.pad_length, scene.sleepers->width) : f.pad_length;
  const double at = scene.fastening_x(fastening);
  const double left = -scene.rail->origin;
  const std::vector<std::string> keys = altered.keys({"shift", ""});
  const auto apart = [&](int before, int after) {
    return before < 0 || after >= f.count ||
           scene.fastening_x(after) - scene.fastening_x(before) >= length - kLengthTolerance;
  };
  require(apart(fastening - 1, fastening) && apart(fastening, fastening + 1), keys,
          fmt::format("{}at x = {:.6g} m it overlaps its neighbour; state a smaller shift", altered.subject(),
                      at));
  require(at - 0.5 * f.pad_length >= left - kLengthTolerance &&
              at + 0.5 * f.pad_length <= left + scene.rail->length + kLengthTolerance,
          keys,
          fmt::format("{}at x = {:.6g} m its pad reaches beyond the rail; state a smaller shift",
                      altered.subject(), at));
}

void check_altered(const Scene& scene, Require require) {
  const FasteningSpec& f = *scene.fastenings;
  const std::vector<AlteredSupport> all = altered_supports(scene);
  std::map<int, std::string> known;
  for (const AlteredSupport& altered : all) {
    const SupportSpec& support = altered.support;
    std::vector<std::string> counted = altered.keys({"fastening"});
    counted.emplace_back("fastenings.count");
    require(support.fastening <= f.count, counted,
            fmt::format("there is no fastening {}: they count {}; state one of these, or a larger "
                        "fastenings.count",
                        support.fastening, f.count));
    const auto [first, fresh] = known.emplace(support.fastening, altered.place());
    require(
        fresh, altered.keys({"fastening"}),
        fmt::format("{} alters fastening {} too; state both in one place", first->second, support.fastening));
    if (support.fastening > f.count || !fresh) continue;
    if (support.shift != 0) check_shift(scene, altered, require);
    require(scene.sleepers || !altered.table.empty() || support.bed == 1, altered.keys({}),
            fmt::format("{}there is no bed without [sleepers]; leave out the column", altered.subject()));
    require(!scene.sleepers || support.stiffness > 0 || support.bed > 0, altered.keys({"stiffness", "bed"}),
            altered.subject() +
                "nothing carries its sleeper; state a share above 0 for the fastening or for the bed");
  }
  const auto left = [&](auto property) {
    return f.count > std::ranges::count_if(
                         all, [&](const AlteredSupport& altered) { return !property(altered.support); });
  };
  const std::vector<std::string> keys = {"support", "fastenings.supports", "fastenings.count"};
  require(left([](const SupportSpec& s) { return s.stiffness > 0 && s.bed > 0; }), keys,
          "nothing carries the rail: every support is broken or hangs; leave one of them whole");
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
  check_widths(scene, *scene.fastenings, require);
  if (scene.sleepers) check_sleepers(scene, *scene.fastenings, require);
  check_altered(scene, require);
}

}  // namespace tread
