#include "io/scene/study_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/math/hash.hpp"
#include "io/files/share_folder.hpp"
#include "io/scene/problems.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/toml_text.hpp"
#include "io/scene/toml_value.hpp"
#include "io/text/text_file.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLargestStudy = 1 << 20;  // [bytes]

/// Names that no point can have: files of a study, and files by which a folder shows whose results it holds.
constexpr std::array kReservedNames = {"report.html",   "figures",    "status.json",  "request",
                                       "request.taken", "sweep.csv",  "dial.csv",     "dial.jsonl",
                                       "effects.csv",   "results.md", "numbers.csv",  "smooth.toml",
                                       "multibody.csv", "levels.csv", "run.h5",       "histories.csv",
                                       "patch.h5",      "checkpoint", "summary.json", "compare.json"};

/// All values that a key takes in a grid.
struct Axis {
  int line;
  std::vector<StudySetting> values;
};

std::string nested_value(const toml::node& node);

/// The text that --set takes for the value.
std::string plain_value(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  const auto* table = node.as_table();
  if (!table) return describe_node(node);  // no key takes it
  std::string members;
  for (const auto& [name, member] : *table)
    members += fmt::format("{} {} = {}", members.empty() ? "" : ",", name.str(), nested_value(member));
  return fmt::format("{{{} }}", members);
}

std::string nested_value(const toml::node& node) {
  return node.is_string() ? fmt::format("\"{}\"", plain_value(node)) : plain_value(node);
}

/// The scene at a path from the study's folder; where there is none, the shipped one of that name.
fs::path scene_at(const fs::path& folder, const fs::path& stated) {
  fs::path beside = folder / stated;
  std::error_code ignored;
  if (fs::exists(beside, ignored)) return beside;
  fs::path shipped = find_scene(stated);
  return shipped == stated ? beside : shipped;
}

class StudyReader {
 public:
  explicit StudyReader(const fs::path& path) : path_(path) {}

  Study read() {
    study_.name = path_.string();
    const toml::table file = parse_toml(read_text_file(path_, kLargestStudy), study_.name);
    for (const auto& [name, node] : file) read_part(std::string(name.str()), name.source(), node);
    if (study_.scene.empty() && problems_.empty())
      report({}, "study.scene", "missing: the path of the scene that is varied");
    in_order(study_.common);
    make_points();
    if (!problems_.empty()) throw ProblemsError(std::move(problems_));
    return std::move(study_);
  }

 private:
  void report(const toml::source_region& at, const std::string& key, const std::string& message) {
    report(static_cast<int>(at.begin.line), static_cast<int>(at.begin.column), key, message);
  }
  void report(int line, int column, const std::string& key, const std::string& message) {
    problems_.push_back({study_.name, line, column, key, message});
  }

  void read_part(const std::string& name, const toml::source_region& at, const toml::node& node) {
    static const std::vector<std::string> kParts = {"study", "set", "grid", "point"};
    if (std::find(kParts.begin(), kParts.end(), name) == kParts.end()) {
      const std::string near = similar_text(name, kParts);
      report(at, name,
             fmt::format("unknown table ({})", near.empty() ? "known: study, set, grid, point"
                                                            : fmt::format("did you mean {}?", near)));
    } else if (name == "point") {
      read_list(at, node);
    } else if (!node.is_table()) {
      report(at, name, fmt::format("expected the table [{}], got {}", name, describe_node(node)));
    } else if (name == "study") {
      read_head(*node.as_table());
    } else if (name == "set") {
      add_settings(*node.as_table(), "", study_.common);
    } else {
      grid_at_ = at;
      add_axes(*node.as_table(), "");
    }
  }

  void read_head(const toml::table& head) {
    static const std::vector<std::string> kKeys = {"title", "scene", "jobs", "threads", "share"};
    for (const auto& [name, node] : head) {
      const std::string key = std::string(name.str());
      const std::string path = "study." + key;
      const std::optional<std::int64_t> number = node.value_exact<std::int64_t>();
      if (key == "title" || key == "scene") {
        read_text(key == "scene", path, name.source(), node);
      } else if (key == "jobs" || key == "threads") {
        if (!number || *number < 1 || *number > kMostJobs)
          report(name.source(), path,
                 fmt::format("expected a whole number from 1 to {}, got {}", kMostJobs, describe_node(node)));
        else
          (key == "jobs" ? study_.jobs : study_.threads) = static_cast<int>(*number);
      } else if (key == "share") {
        const std::optional<bool> share = node.value_exact<bool>();
        if (!share)
          report(name.source(), path, fmt::format("expected true or false, got {}", describe_node(node)));
        else
          study_.share = *share;
      } else {
        const std::string near = similar_text(key, kKeys);
        report(name.source(), path,
               fmt::format("unknown key ({})", near.empty() ? "known: title, scene, jobs, threads, share"
                                                            : fmt::format("did you mean study.{}?", near)));
      }
    }
  }

  /// Title of the study, or its scene.
  void read_text(bool scene, const std::string& path, const toml::source_region& at, const toml::node& node) {
    const std::optional<std::string> text = node.value_exact<std::string>();
    if (!text || text->empty())
      return report(at, path, fmt::format("expected a text, got {}", describe_node(node)));
    try {
      require_text(*text, scene);
    } catch (const InputError& error) {
      return report(at, path, error.what());
    }
    if (scene)
      study_.scene = scene_at(path_.parent_path(), *text);
    else
      study_.title = *text;
  }

  /// As they stand in the file; its tables come sorted by name.
  static void in_order(std::vector<StudySetting>& settings) {
    std::stable_sort(settings.begin(), settings.end(), [](const StudySetting& a, const StudySetting& b) {
      return std::tie(a.line, a.column) < std::tie(b.line, b.column);
    });
  }

  static StudySetting setting(const std::string& key, const toml::source_region& at, const toml::node& node) {
    return {key, plain_value(node), static_cast<int>(at.begin.line), static_cast<int>(at.begin.column)};
  }

  /// A table is one value only where the scene has a key of that path.
  void add_settings(const toml::table& table, const std::string& prefix, std::vector<StudySetting>& list) {
    for (const auto& [name, node] : table) {
      const std::string key = prefix + std::string(name.str());
      if (node.is_table() && !find_key(key))
        add_settings(*node.as_table(), key + ".", list);
      else if (node.is_array())
        report(name.source(), key, "expected one value, got an array; arrays belong into [grid]");
      else
        list.push_back(setting(key, name.source(), node));
    }
  }

  void add_axes(const toml::table& table, const std::string& prefix) {
    for (const auto& [name, node] : table) {
      const std::string key = prefix + std::string(name.str());
      const toml::array* values = node.as_array();
      if (node.is_table() && !find_key(key)) {
        add_axes(*node.as_table(), key + ".");
      } else if (!values || values->empty()) {
        report(name.source(), key,
               fmt::format("expected an array of values, such as [\"100 km/h\", \"300 km/h\"], got {}",
                           values ? "an empty one" : describe_node(node)));
      } else {
        Axis axis{static_cast<int>(name.source().begin.line), {}};
        for (const toml::node& value : *values) axis.values.push_back(setting(key, value.source(), value));
        axes_.push_back(std::move(axis));
      }
    }
  }

  void read_list(const toml::source_region& at, const toml::node& node) {
    const toml::array* list = node.as_array();
    if (!list || list->empty()) {
      report(at, "point", fmt::format("expected tables [[point]], got {}", describe_node(node)));
      return;
    }
    for (const toml::node& item : *list) {
      if (!item.is_table()) {
        report(item.source(), "point", fmt::format("expected a table, got {}", describe_node(item)));
        continue;
      }
      toml::table values = *item.as_table();
      StudyPoint point;
      if (const toml::node* name = item.as_table()->get("name")) {  // copies do not know their place
        point.name = name->value_exact<std::string>().value_or("");
        check_name(name->source(), point.name);
        values.erase("name");
      }
      add_settings(values, "", point.varied);
      in_order(point.varied);
      if (point.varied.empty())
        report(item.source(), "point", "it varies nothing: state a key and its value");
      study_.points.push_back(std::move(point));
      lines_.push_back(static_cast<int>(item.source().begin.line));
    }
  }

  void check_name(const toml::source_region& at, const std::string& name) {
    const auto plain = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
             std::string_view("._+-=,").find(c) != std::string_view::npos;
    };
    if (std::find(kReservedNames.begin(), kReservedNames.end(), name) != kReservedNames.end()) {
      report(
          at, "point.name",
          fmt::format("\"{}\" is a name that tread itself uses in such a folder: choose another name", name));
      return;
    }
    if (!name.empty() && name.size() <= kLongestPointName && name.front() != '.' && name.front() != '-' &&
        std::all_of(name.begin(), name.end(), plain))
      return;
    report(at, "point.name",
           fmt::format("\"{}\" cannot name a folder: use letters, digits and . _ + - = , (at most {}), "
                       "neither . nor - first",
                       name, kLongestPointName));
  }

  void make_points() {
    if (!axes_.empty() && !study_.points.empty()) {
      report(grid_at_, "grid", "a study has a [grid] or a list of [[point]], not both");
      return;
    }
    if (study_.points.empty()) combine_axes();
    if (study_.points.empty() && problems_.empty())
      report({}, "", "it varies nothing: add [grid] with arrays of values, or tables [[point]]");
    refuse_doubled_keys();
    name_points();
  }

  /// Every combination, the last key running fastest.
  void combine_axes() {
    std::stable_sort(axes_.begin(), axes_.end(),
                     [](const Axis& a, const Axis& b) { return a.line < b.line; });
    std::size_t count = axes_.empty() ? 0 : 1;
    for (const Axis& axis : axes_) count = std::min(count * axis.values.size(), kMostPoints + 1);
    if (count > kMostPoints) {
      report(grid_at_, "grid", fmt::format("that is more than {} points", kMostPoints));
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      StudyPoint point;
      std::size_t rest = i;
      std::size_t block = count;
      for (const Axis& axis : axes_) {
        block /= axis.values.size();
        point.varied.push_back(axis.values[rest / block]);
        rest %= block;
      }
      study_.points.push_back(std::move(point));
      lines_.push_back(static_cast<int>(grid_at_.begin.line));
    }
  }

  void refuse_doubled_keys() {
    std::set<std::string> reported;
    for (const StudySetting& common : study_.common)
      for (const StudyPoint& point : study_.points)
        for (const StudySetting& varied : point.varied)
          if (varied.key == common.key && reported.insert(common.key).second)
            report(common.line, common.column, common.key,
                   fmt::format("it stands in [set] and is varied on line {}: leave one of them out",
                               varied.line));
  }

  void name_points() {
    std::map<std::string, int> lines;
    for (std::size_t i = 0; i < study_.points.size(); ++i) {
      StudyPoint& point = study_.points[i];
      if (point.name.empty()) point.name = point_name(point.varied);
      const auto [known, is_new] = lines.try_emplace(point.name, lines_[i]);
      if (!is_new)
        report(lines_[i], 0, "point",
               fmt::format("two points are called \"{}\", the first on line {}: give this one a value or a "
                           "name of its own",
                           point.name, known->second));
    }
  }

  fs::path path_;
  Study study_;
  std::vector<Axis> axes_;
  std::vector<int> lines_;  ///< of each point
  toml::source_region grid_at_;
  std::vector<Problem> problems_;
};

/// The text as part of a folder's name: "300 km/h" as "300km_h".
std::string folder_text(const std::string& value) {
  std::string text;
  for (const char c : value) {
    if (c == ' ' || c == '"') continue;
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '+' || c == '-';
    text += plain ? c : '_';
  }
  return text;
}

/// The end of `key` from the dot number `parts` from its end on.
std::string key_end(const std::string& key, int parts) {
  std::size_t at = key.size();
  for (int i = 0; i < parts && at != std::string::npos; ++i)
    at = at == 0 ? std::string::npos : key.rfind('.', at - 1);
  return at == std::string::npos ? key : key.substr(at + 1);
}

}  // namespace

std::string point_name(const std::vector<StudySetting>& varied) {
  std::string name;
  for (const StudySetting& setting : varied) {
    int parts = 1;
    const auto ambiguous = [&] {
      const std::string end = key_end(setting.key, parts);
      return end != setting.key &&
             std::count_if(varied.begin(), varied.end(),
                           [&](const StudySetting& other) { return key_end(other.key, parts) == end; }) > 1;
    };
    while (ambiguous()) ++parts;
    name += fmt::format("{}{}={}", name.empty() ? "" : ",", key_end(setting.key, parts),
                        folder_text(setting.value));
  }
  if (name.size() <= kLongestPointName) return name;
  Hash hash;
  hash.add(std::as_bytes(std::span(name)));
  constexpr std::size_t kDigits = 16;
  return fmt::format("{}{:016x}", name.substr(0, kLongestPointName - kDigits), hash.value());
}

bool is_study(const std::string& text, const std::string& name) {
  return parse_toml(text, name).contains("study");
}

Study read_study(const fs::path& path) {
  return StudyReader(path).read();
}

}  // namespace tread
