#include "io/scene/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "io/scene/body_file.hpp"
#include "io/scene/idle_materials.hpp"
#include "io/scene/nameless_table.hpp"
#include "io/scene/problems.hpp"
#include "io/scene/profile_file.hpp"
#include "io/scene/scene_checks.hpp"
#include "io/scene/scene_entries.hpp"
#include "io/scene/scene_library.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/setting.hpp"
#include "io/scene/support_file.hpp"
#include "io/scene/surface_file.hpp"
#include "io/scene/table_reader.hpp"
#include "io/scene/toml_text.hpp"
#include "io/scene/toml_value.hpp"
#include "io/scene/unknown_key.hpp"
#include "io/text/text.hpp"
#include "io/text/text_file.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLargestScene = 1 << 20;  // [bytes]
constexpr std::size_t kLongestMessage = 500;    // [characters]
constexpr std::size_t kSuggestions = 50;        // problems after which none is searched for

class SceneBuilder {
 public:
  explicit SceneBuilder(const SceneSource& source) : source_(source) {}

  ResolvedScene build(const std::vector<std::string>& overrides) {
    read_file();
    for (const std::string& text : overrides) read_override(text);
    read_library();
    choose_tables();
    assign_values();
    drop_idle_materials();
    read_named_files();
    check_required();
    add_check_results();
    if (!problems_.empty()) throw ProblemsError(std::move(problems_));
    ResolvedScene resolved{scene_, source_.name, source_, overrides, scene_entries(scene_, settings_)};
    resolved.source.files = std::move(files_);
    return resolved;
  }

 private:
  void report(const Place& place, const std::string& key, const std::string& message) {
    const auto shortened = [](const std::string& text) {
      return text.size() > kLongestMessage ? text.substr(0, kLongestMessage) + "..." : text;
    };
    problems_.push_back({place.file, place.line, place.column, shortened(key), shortened(message)});
    bad_.insert(key);
  }

  void read_file() {
    const Origin origin{Level::file, whole_file(), source_.name};
    add_children(parse_toml(source_.text, source_.name), "", origin);
  }

  void read_override(const std::string& text) {
    const Place place{"--set", 0, 0};
    const auto equals = text.find('=');
    const std::string path(trimmed(std::string_view(text).substr(0, equals)));
    if (const std::string fault = override_fault(text); !fault.empty())
      return report(place, equals == std::string::npos ? "" : one_line(path), fault);
    const Origin origin{Level::command_line, place, "--set"};
    set_plain(path, std::string(trimmed(std::string_view(text).substr(equals + 1))), origin);
  }

  void read_library() {
    const auto found = settings_.find("scene.based_on");
    if (found == settings_.end()) return;
    const auto* name = found->second.node->as_string();
    const LibraryEntry* entry = name ? find_library_entry(name->get()) : nullptr;
    if (!entry) {
      tables_unclear_ = true;
      report(found->second.origin.place, "scene.based_on",
             fmt::format("expected the name of a library entry ({}), got {}", library_names(),
                         describe_node(*found->second.node)));
      return;
    }
    add_library_entry(*entry);
  }

  /// Values of the entry after those of its base: the later of two stays.
  void add_library_entry(const LibraryEntry& entry) {
    if (const LibraryEntry* base = find_library_entry(entry.base)) add_library_entry(*base);
    for (const LibraryValue& value : entry.values) {
      const Origin origin{Level::library, whole_file(), fmt::format("{}: {}", entry.name, value.source)};
      set_plain(std::string(value.path), std::string(value.value), origin);
    }
  }

  void set_plain(const std::string& path, const std::string& text, const Origin& origin) {
    const std::optional<Key> key = find_key(path);
    add(path, *parse_plain_value(text, key && (key->kind == Kind::text || key->kind == Kind::quantity)),
        origin);
  }

  void add_children(const toml::table& table, const std::string& prefix, const Origin& origin) {
    const bool nameless = lacks_names(table, prefix);
    if (nameless) {
      tables_unclear_ = true;
      report(origin.place, prefix.substr(0, prefix.size() - 1), needs_name(prefix));
    }
    for (const auto& [name, node] : table) {
      if (nameless && !has_header(node)) continue;
      Origin own = origin;
      if (origin.level == Level::file) {
        const toml::source_position at = name.source().begin;
        own.place = {source_.name, static_cast<int>(at.line), static_cast<int>(at.column)};
        own.source = fmt::format("{}:{}", source_.name, at.line);
      }
      add(prefix + std::string(name.str()), node, own);
    }
  }

  void add(const std::string& path, const toml::node& node, const Origin& origin) {
    if (node.is_table() && is_table(path)) {
      mention(path, origin);
      add_children(*node.as_table(), path + ".", origin);
    } else if (is_table(path)) {
      tables_unclear_ = true;
      report(origin.place, path, not_a_table(path, describe_node(node)));
    } else if (!find_key(path)) {
      report(origin.place, path, unknown_key(path, node.is_table(), problems_.size() < kSuggestions));
      if (!table_of(path)) tables_unclear_ = true;
    } else {
      mention(path, origin);
      keep_highest(path, node, origin);
    }
  }

  void mention(const std::string& path, const Origin& origin) {
    const std::optional<SceneTable> table = table_of(path);
    if (!table) return;
    const auto [known, is_new] = mentioned_.try_emplace(table->name, origin);
    if (!is_new && origin.level > known->second.level) known->second = origin;
  }

  void keep_highest(const std::string& path, const toml::node& node, const Origin& origin) {
    const auto found = settings_.find(path);
    if (found != settings_.end() && found->second.origin.level > origin.level) return;
    settings_[path] = {clone(node), origin};
  }

  /// Creates the components that the highest level to mention them wants.
  void choose_tables() {
    for (const SceneTable& table : scene_tables(mentioned_names())) {
      const auto found = mentioned_.find(table.name);
      if (found == mentioned_.end() || !table.removable()) continue;
      if (wants(table, found->second.level)) {
        table.create(scene_);
      } else {
        report_unused_keys(table, found->second.level);
      }
    }
  }

  TableNames mentioned_names() const {
    TableNames names;
    for (const auto& [table, origin] : mentioned_) names.add(table);
    return names;
  }

  /// Drops the materials that no part is of.
  void drop_idle_materials() {
    for (const MaterialUse& use : material_uses(scene_))
      if (bad_.count(use.key)) return;
    for (const std::string& name : idle_materials(scene_)) {
      scene_.materials.erase(name);
      const std::string table = std::string(kMaterialTables) + name;
      const Origin& origin = mentioned_.at(table);
      if (origin.level > Level::library && !tables_unclear_)
        report(origin.place, table, why_idle(scene_, name));
    }
  }

  bool wants(const SceneTable& table, Level mentioned_at) {
    const auto present = settings_.find(table.name + ".present");
    if (present == settings_.end() || present->second.origin.level < mentioned_at) return true;
    try {
      return to_boolean(*present->second.node, present->second.origin.notation());
    } catch (const InputError& error) {
      report(present->second.origin.place, present->first, error.what());
      return true;
    }
  }

  void report_unused_keys(const SceneTable& table, Level level) {
    if (level == Level::library) return;
    const std::string prefix = table.name + ".";
    for (auto at = settings_.lower_bound(prefix); at != settings_.end(); ++at) {
      const auto& [path, setting] = *at;
      if (!path.starts_with(prefix)) break;
      if (setting.origin.level != level || path == prefix + "present") continue;
      report(setting.origin.place, path,
             fmt::format("has no effect, because {}.present = false", table.name));
    }
  }

  void assign_values() {
    const std::vector<Key> keys = scene_keys(scene_);
    for (const Key& key : keys) {
      const auto found = settings_.find(key.excludes);
      const auto own = settings_.find(key.path);
      if (found == settings_.end() || own == settings_.end()) continue;
      if (own->second.origin.level > found->second.origin.level) settings_.erase(found);
    }
    for (const bool conditional : {false, true}) {
      for (const Key& key : keys) {
        if (key.locate && key.only_with.key.empty() != conditional) assign(key);
      }
    }
  }

  void assign(const Key& key) {
    const auto found = settings_.find(key.path);
    const Field field = key.locate(scene_);
    if (found == settings_.end() || std::holds_alternative<std::monostate>(field)) return;
    const Setting& setting = found->second;
    if (!applies(key, scene_)) {
      const bool unclear = bad_.count(key.only_with.key) || (tables_unclear_ && key.only_with.needs_table());
      if (setting.origin.level == Level::library || unclear || is_idle_value(key, *setting.node, scene_))
        return;
      report(setting.origin.place, key.path, key.only_with.why_idle());
      return;
    }
    try {
      read_value(key, *setting.node, source_.folder, field, setting.origin.notation());
    } catch (const InputError& error) {
      report(setting.origin.place, key.path, error.what());
    }
  }

  void read_named_files() {
    if (scene_.contact && scene_.contact->friction_law == "table")
      read_columns("contact.friction_file", kFrictionTable, scene_.contact->friction_x,
                   scene_.contact->friction_at_x);
    if (scene_.fastenings)
      read_file_of("fastenings.supports", [&](const std::string& text, const std::string& name) {
        scene_.fastenings->listed = parse_supports(text, name, problems_);
      });
    if (scene_.corrugation) {
      const auto read = [&](const std::string& text, const std::string& name) {
        set_depths(text, name, *scene_.corrugation, problems_);
      };
      read_file_of("corrugation.file", read,
                   scene_.corrugation->kind == "map" ? read_map_text : read_table_text);
    }
    const double wheel_radius = scene_.wheel ? 0.5 * scene_.wheel->diameter : 0;
    for (auto& [table, surface] : scene_.surfaces) {
      const auto read = [&, &of = surface](const std::string& text, const std::string& name) {
        set_depths(text, name, wheel_radius, of, problems_);
      };
      read_file_of(std::string(kSurfaceTables) + table + ".file", read,
                   surface.kind == "map" ? read_map_text : read_table_text);
    }
    for (auto& [name, body] : scene_.bodies) {
      const std::string table = std::string(kBodyTables) + name;
      const auto read = [&, &of = body](const std::string& text, const std::string& file) {
        set_mesh(text, file, table, of, problems_);
      };
      if (settings_.count(table + ".unit") && !bad_.count(table + ".unit"))
        read_file_of(table + ".file", read, read_mesh_text);
    }
    if (scene_.wheel) read_profile("wheel.profile", *scene_.wheel);
    if (scene_.wheel) read_columns("wheel.web", kWebOutline, scene_.wheel->web_y, scene_.wheel->web_r);
    if (scene_.rail) read_profile("rail.profile", *scene_.rail);
  }

  /// The profile that the key names, if it names a file.
  template <class Part>
  void read_profile(const std::string& path, Part& part) {
    read_file_of(path, [&](const std::string& text, const std::string& name) {
      UnderstoodProfile profile = profile_of(text, name, wish_of(part), ColumnAxes::as_documented, problems_);
      part.profile_reading = reading_of(profile);
      part.profile_y = std::move(profile.y);
      part.profile_z = std::move(profile.z);
    });
  }

  /// Reads the columns of the file that the key names, if it names one.
  void read_columns(const std::string& path, const TableRules& rules, std::vector<double>& first,
                    std::vector<double>& second) {
    read_file_of(path, [&](const std::string& text, const std::string& name) {
      TwoColumns columns = parse_two_columns(text, name, rules, problems_);
      first = std::move(columns.first);
      second = std::move(columns.second);
    });
  }

  /// Calls `read` with text and name of the file that the key names; what it reports is a problem of the key.
  void read_file_of(const std::string& path,
                    const std::function<void(const std::string&, const std::string&)>& read,
                    std::string (*load)(const fs::path&) = read_table_text) {
    const std::optional<Key> key = find_key(path);
    const std::string& name = *std::get<std::string*>(key->locate(scene_));
    const bool is_name = std::find(key->allowed.begin(), key->allowed.end(), name) != key->allowed.end();
    if (name.empty() || is_name || bad_.count(path)) return;
    try {
      const std::size_t known_problems = problems_.size();
      const auto given = source_.files.find(name);
      const auto& text = files_[name] =
          given != source_.files.end() ? given->second : std::make_shared<const std::string>(load(name));
      read(*text, name);
      if (problems_.size() > known_problems) bad_.insert(path);
    } catch (const InputError& error) {
      report(place_of(path), path, error.what());
    }
  }

  void check_required() {
    for (const Key& key : scene_keys(scene_)) {
      if (!key.required || settings_.count(key.path) || !applies(key, scene_)) continue;
      if (std::holds_alternative<std::monostate>(key.locate(scene_))) continue;
      bad_.insert(key.path);
      const bool unclear = !key.only_with.key.empty() && bad_.count(key.only_with.key);
      if (tables_unclear_ || unclear) continue;
      const std::optional<SceneTable> table = table_of(key.path);
      const std::string kind = key.quantity ? fmt::format("a {}", key.quantity->name) : "a value";
      report(mentioned_.at(table->name).place, key.path,
             fmt::format("is missing; [{}] needs {}: {}", table->name, kind, key.description));
    }
  }

  Place whole_file() const { return {source_.name, 0, 0}; }
  Place place_of(const std::string& path) const {
    const auto setting = settings_.find(path);
    if (setting != settings_.end()) return setting->second.origin.place;
    const auto table = mentioned_.find(path);
    return table != mentioned_.end() ? table->second.place : whole_file();
  }

  /// The key that the user can change: the first one that stands in the file or an override.
  std::string blamed(const std::vector<std::string>& keys) const {
    for (const std::string& key : keys) {
      const auto setting = settings_.find(key);
      if (setting != settings_.end() && setting->second.origin.level > Level::library) return key;
    }
    return keys.front();
  }

  void add_check_results() {
    for (const SceneProblem& problem : validate(scene_)) {
      const auto is_bad = [&](const std::string& key) { return bad_.count(key) > 0; };
      if (std::any_of(problem.keys.begin(), problem.keys.end(), is_bad)) continue;
      const auto is_value = [](const auto& path) { return find_key(path) && find_key(path)->locate; };
      if (tables_unclear_ && !std::all_of(problem.keys.begin(), problem.keys.end(), is_value)) continue;
      const std::string key = blamed(problem.keys);
      const Place place = place_of(key);
      problems_.push_back({place.file, place.line, place.column, key, problem.message});
    }
  }

  const SceneSource& source_;
  Scene scene_;
  std::map<std::string, Setting> settings_;  ///< the highest level's value of each key
  std::map<std::string, Origin> mentioned_;  ///< the highest level that names each table
  std::set<std::string> bad_;                ///< keys with a problem already
  bool tables_unclear_ = false;              ///< a table's name is wrong: what is missing cannot be told
  std::vector<Problem> problems_;
  decltype(SceneSource::files) files_;  ///< texts of those that the scene names
};

}  // namespace

SceneSource load_scene_source(const fs::path& path) {
  return {path.string(), read_text_file(path, kLargestScene),
          fs::weakly_canonical(fs::absolute(path).parent_path())};
}

ResolvedScene resolve_scene(const SceneSource& source, const std::vector<std::string>& overrides) {
  return SceneBuilder(source).build(overrides);
}

ResolvedScene resolve_scene(const fs::path& path, const std::vector<std::string>& overrides) {
  return resolve_scene(load_scene_source(path), overrides);
}

}  // namespace tread
