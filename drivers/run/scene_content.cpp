#include "drivers/run/scene_content.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "core/math/hash.hpp"
#include "drivers/engine/model/station_plan.hpp"
#include "drivers/process/version.hpp"
#include "io/files/output_file.hpp"
#include "io/scene/schema.hpp"
#include "io/text/json.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

constexpr const char* kChecksums = "scene.files.json";
constexpr const char* kFile = "file ";  ///< begins the key of a file's checksum

std::string checksum(const std::string& text) {
  Hash hash;
  hash.add(std::as_bytes(std::span(text)));
  return fmt::format("{:016x}", hash.value());
}

}  // namespace

SceneContent content_of(const ResolvedScene& resolved, const std::function<bool(Effects)>& counts) {
  SceneContent content;
  const std::map<std::string, std::string>& files = resolved.source.files;
  for (const Entry& entry : resolved.entries) {
    const Key key = *find_key(entry.path);
    if (!counts(key.effects)) continue;
    content[entry.path] = entry.unit.empty() ? entry.value : entry.value + " " + entry.unit;
    const auto file = key.takes_file ? files.find(entry.value) : files.end();
    if (file != files.end()) content[kFile + entry.value] = checksum(file->second);
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
  const Span run = run_span(scene);
  content["run"] = fmt::format("{} m to {} m", run.first, run.last);
}

void keep_scene(const fs::path& folder, const ResolvedScene& resolved) {
  write_text_file(folder / kKeptScene,
                  fmt::format("# Written by tread {}.\n{}", program_version(), resolved_toml(resolved)));
  if (resolved.source.files.empty()) return;
  Json json;
  for (const auto& [place, text] : resolved.source.files) json[place] = checksum(text);
  write_text_file(folder / kChecksums, json_text(json));
}

KeptScene kept_scene(const fs::path& folder) {
  KeptScene kept{resolve_scene(folder / kKeptScene), {}};
  kept.content = scene_content(kept.resolved);
  if (!fs::exists(folder / kChecksums)) return kept;
  const JsonRecord checksums = read_json(folder / kChecksums);
  for (auto& [key, value] : kept.content)
    if (key.starts_with(kFile))
      if (const std::string then = text_in(checksums, key.substr(std::string_view(kFile).size()));
          !then.empty())
        value = then;
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
      if (found != other.end() && found->second != value && key.starts_with(kFile))
        return key + " has other contents here than there";
      if (found == other.end() || found->second != value)
        return fmt::format("{} is {} here and {} there", key, shown(here, key), shown(there, key));
    }
  return "";
}

}  // namespace tread
