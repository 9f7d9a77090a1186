#include "drivers/studies/dial/dial_design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "drivers/run/scene_content.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/scene/schema.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

constexpr const char* kSize = "scene.element_size";
constexpr const char* kQuality = "scene.quality";
/// Choices of method beside the keys of Effect::fineness: the passage stays the same.
constexpr std::array<std::string_view, 9> kMethods = {
    "contact.penetration_ratio", "contact.points", "contact.surface",
    "corrugation.apply",         "motion.run_up",  "motion.start",
    "motion.step_safety",        "slab.present",   "solution_zone.margin"};

/// "key=value" with all behind the sign as the value.
StudySetting setting(const std::string& option, const std::string& text) {
  const auto equals = text.find('=');
  StudySetting s{std::string(trimmed(std::string_view(text).substr(0, equals))), ""};
  if (equals != std::string::npos) s.value = trimmed(std::string_view(text).substr(equals + 1));
  if (s.key.empty() || s.value.empty())
    throw InputError(fmt::format("{} {}: expected key=value, such as \"{}=5 mm\"", option, text, kSize));
  return s;
}

std::vector<StudySetting> values_of(const std::string& axis) {
  const StudySetting all = setting("--axis", axis);
  std::vector<StudySetting> values;
  for (std::size_t at = 0; at <= all.value.size();) {
    const std::size_t end = std::min(all.value.find(',', at), all.value.size());
    values.push_back({all.key, std::string(trimmed(std::string_view(all.value).substr(at, end - at)))});
    if (values.back().value.empty())
      throw InputError(fmt::format("--axis {}: a value is missing beside a comma", axis));
    at = end + 1;
  }
  return values;
}

/// An element size hides the quality: a point of one is not told the other by the base.
bool replaces(const StudySetting& varied, const StudySetting& base) {
  return varied.key == base.key || (varied.key == kQuality && base.key == kSize);
}

/// Adds points that are no other's scene again.
class PointList {
 public:
  PointList(SceneSource source, std::vector<StudySetting> base)
      : source_(std::move(source)), base_(std::move(base)) {}

  void add(const std::string& name, const std::vector<StudySetting>& varied) {
    StudyPoint point{name, varied, {}};
    for (const StudySetting& s : base_) {
      const bool hidden = std::any_of(varied.begin(), varied.end(),
                                      [&](const StudySetting& one) { return replaces(one, s); });
      if (!hidden) point.own.push_back(s);
    }
    if (is_new(point)) points.push_back(std::move(point));
  }

  std::vector<StudyPoint> points;

 private:
  bool is_new(const StudyPoint& point) {
    std::vector<std::string> overrides;
    for (const auto* settings : {&point.own, &point.varied})
      for (const StudySetting& s : *settings) overrides.push_back(s.as_override());
    try {
      return known_.insert(scene_content(resolve_scene(source_, overrides))).second;
    } catch (const InputError&) {
      return true;  // plan_study() says what is wrong with it
    }
  }

  SceneSource source_;
  std::vector<StudySetting> base_;
  std::set<SceneContent> known_;
};

/// Returns true if runs that differ in the key are of one passage. Keys that the schema lacks are left to
/// plan_study().
bool keeps_passage(const std::string& key) {
  const std::optional<Key> known = find_key(key);
  return !known || known->effects.any_of({Effect::fineness, Effect::output, Effect::process}) ||
         std::find(kMethods.begin(), kMethods.end(), key) != kMethods.end();
}

/// InputError where points differ in a key that makes another passage.
void require_one_passage(const Study& study) {
  std::map<std::string, std::multiset<std::string>> values;
  for (const StudyPoint& point : study.points)
    for (const auto* settings : {&point.own, &point.varied})
      for (const StudySetting& s : *settings) values[s.key].insert(s.value);
  for (const auto& [key, of_points] : values)
    if (!keeps_passage(key) && of_points.count(*of_points.begin()) < study.points.size())
      throw InputError(
          fmt::format("{}: {} = {} makes another passage, whose difference is no error; a dial varies keys "
                      "with the effect fineness and {}; run `tread sweep`, or state one value for all points "
                      "with --set",
                      study.name, key, *of_points.begin(), fmt::join(kMethods, ", ")));
}

}  // namespace

std::vector<std::string> default_axes(const Scene& scene) {
  std::vector<std::string> axes = {fmt::format("{}=8 mm,6 mm,5 mm,4 mm,3 mm", kSize)};
  // Where the scene itself states a size no quality shows in its contact.
  if (scene.element_size)
    axes.push_back(fmt::format("{}=2.2 mm,1.6 mm,1.1 mm", kSize));
  else
    axes.push_back(fmt::format("{}=draft,standard,paper", kQuality));
  for (const char* axis : {"scene.precision=double,mixed,single", "contact.penetration_ratio=0.005,0.05",
                           "motion.step_safety=0.5", "contact.surface=facets", "motion.start=moving,rigid"})
    axes.emplace_back(axis);
  if (scene.slab_track) axes.emplace_back("slab.present=false");
  return axes;
}

DialDesign design_dial(const std::filesystem::path& file, const DialAxes& wanted) {
  const SceneSource source = load_scene_source(file);
  DialDesign design;
  if (is_study(source.text, source.name)) {
    if (!wanted.base.empty() || !wanted.axes.empty())
      throw InputError(
          fmt::format("{}: a study states its points; --base and --axis belong to a scene", file.string()));
    design.study = read_study(file);
    require_one_passage(design.study);
    return design;
  }
  std::vector<StudySetting> base;
  for (const std::string& text : wanted.base) base.push_back(setting("--base", text));
  if (base.empty()) base.push_back({kSize, "5 mm"});
  const Scene scene = resolve_scene(source).scene;
  design.study.name = file.string();
  design.study.title = fmt::format("{}: what settings cost and how far they lead", scene.title);
  design.study.scene = file;
  design.base = point_name(base);
  PointList list(source, base);
  list.add(design.base, base);
  for (const std::string& axis : wanted.axes.empty() ? default_axes(scene) : wanted.axes)
    for (const StudySetting& value : values_of(axis)) list.add(point_name({value}), {value});
  design.study.points = std::move(list.points);
  require_one_passage(design.study);
  return design;
}

}  // namespace tread
