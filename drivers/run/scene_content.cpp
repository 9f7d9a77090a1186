#include "drivers/run/scene_content.hpp"

#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/math/hash.hpp"
#include "drivers/engine/model/station_plan.hpp"
#include "drivers/process/version.hpp"
#include "io/files/output_file.hpp"
#include "io/scene/body_file.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/surface_file.hpp"
#include "io/text/json.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

constexpr const char* kChecksums = "scene.files.json";

std::string checksum(const std::string& text) {
  Hash hash;
  hash.add(std::as_bytes(std::span(text)));
  return fmt::format("{:016x}", hash.value());
}

/// Value of a key that names a file: the place counts for nothing, the suffix may tell the format.
std::string file_value(const fs::path& place, const std::string& sum) {
  const std::string suffix = place.extension().string();
  return fmt::format("a{}{} file of checksum {}", suffix.empty() ? "" : " ", suffix, sum);
}

/// The place, and the places where the file lies if it and the folder have moved together: each end of the
/// path, from the folder and from all folders above it.
std::vector<fs::path> places_of_file(const fs::path& place, const fs::path& folder) {
  std::vector<fs::path> places = {place};
  for (fs::path above = fs::weakly_canonical(fs::absolute(folder));; above = above.parent_path()) {
    for (auto first = place.begin(); first != place.end(); ++first) {
      fs::path end;
      for (auto part = first; part != place.end(); ++part) end /= *part;
      if (end.is_relative()) places.push_back(above / end);
    }
    if (above == above.parent_path()) return places;
  }
}

/// Text of a file as a scene reads it; empty if it does not read.
std::string file_text_at(const fs::path& place) {
  for (const auto read : {read_map_text, read_mesh_text}) {
    try {
      return read(place);
    } catch (const InputError&) {
    }
  }
  return "";
}

/// Text with that checksum: one of `known`, or that of a file in places_of_file(); null if there is none.
std::shared_ptr<const std::string> text_of_checksum(const std::string& sum, const fs::path& place,
                                                    const fs::path& folder, const SceneFiles& known) {
  for (const auto& [name, text] : known)
    if (checksum(*text) == sum) return text;
  for (const fs::path& one : places_of_file(place, folder)) {
    std::error_code ignored;
    if (!fs::is_regular_file(one, ignored)) continue;
    if (std::string text = file_text_at(one); checksum(text) == sum)
      return std::make_shared<const std::string>(std::move(text));
  }
  return nullptr;
}

}  // namespace

SceneContent content_of(const ResolvedScene& resolved, const std::function<bool(Effects)>& counts) {
  SceneContent content;
  const SceneFiles& files = resolved.source.files;
  for (const Entry& entry : resolved.entries) {
    const Key key = *find_key(entry.path);
    if (!counts(key.effects)) continue;
    const auto file = key.takes_file ? files.find(entry.value) : files.end();
    content[entry.path] = file != files.end()  ? file_value(entry.value, checksum(*file->second))
                          : entry.unit.empty() ? entry.value
                                               : entry.value + " " + entry.unit;
  }
  return content;
}

SceneContent scene_content(const ResolvedScene& resolved) {
  return content_of(resolved, [](Effects effects) { return effects.on_results(); });
}

SceneContent preload_content(const ResolvedScene& resolved) {
  // Without a ramp the static state bears the traction.
  const bool traction = resolved.scene.motion && resolved.scene.motion->ramp == 0;
  SceneContent content = content_of(resolved, [&](Effects effects) {
    return traction ? effects.on_smooth_motion() : effects.on_preload();
  });
  add_run(content, resolved.scene);
  return content;
}

void add_run(SceneContent& content, const Scene& scene) {
  for (const auto& [name, span] : {std::pair("run", run_span(scene)), std::pair("zone", zone_span(scene))})
    content[name] = fmt::format("{} m to {} m", span.first, span.last);
}

void keep_scene(const fs::path& folder, const ResolvedScene& resolved) {
  write_text_file(folder / kKeptScene,
                  fmt::format("# Written by tread {}.\n{}", program_version(), resolved_toml(resolved)));
  if (resolved.source.files.empty()) {
    std::error_code ignored;
    fs::remove(folder / kChecksums, ignored);  // of an earlier scene
    return;
  }
  Json json;
  for (const auto& [place, text] : resolved.source.files) json[place] = checksum(*text);
  write_text_file(folder / kChecksums, json_text(json));
}

KeptScene kept_scene(const fs::path& folder, const SceneFiles& known) {
  SceneSource source = load_scene_source(folder / kKeptScene);
  const JsonRecord sums = fs::exists(folder / kChecksums) ? read_json(folder / kChecksums) : JsonRecord();
  std::string missing;
  for (const auto& [place, value] : sums) {
    const std::string sum = text_in(sums, place);
    if (auto text = text_of_checksum(sum, place, folder, known))
      source.files[place] = std::move(text);
    else if (std::error_code unknown; !fs::exists(place, unknown))
      missing += fmt::format("\n{} of checksum {}", place, sum);
  }
  KeptScene kept;
  try {
    kept.resolved = resolve_scene(source);
  } catch (const InputError&) {
    if (missing.empty()) throw;
    throw InputError(fmt::format("{} names files that are not there; put them back, or into {}:{}",
                                 source.name, folder.string(), missing));
  }
  kept.content = scene_content(kept.resolved);
  for (const Entry& entry : kept.resolved.entries)
    if (const auto found = kept.content.find(entry.path);
        found != kept.content.end() && sums.contains(entry.value))
      found->second = file_value(entry.value, text_in(sums, entry.value));
  return kept;
}

std::string difference(const SceneContent& here, const SceneContent& there) {
  const auto shown = [](const SceneContent& content, const std::string& key) {
    constexpr std::size_t kLongest = 60;
    const auto found = content.find(key);
    return found == content.end() ? "absent" : found->second.substr(0, kLongest);
  };
  for (const SceneContent* one : {&here, &there})
    for (const auto& [key, value] : *one) {
      const SceneContent& other = one == &here ? there : here;
      const auto found = other.find(key);
      if (found == other.end() || found->second != value)
        return fmt::format("{} is {} here and {} there", key, shown(here, key), shown(there, key));
    }
  return "";
}

}  // namespace tread
