#include "drivers/study/scene_content.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace tread {

namespace {

bool matters(std::string_view path) {
  constexpr std::array<std::string_view, 5> kIdle = {"scene.title", "output.progress_interval",
                                                     "output.checkpoint_interval", "output.disk_limit",
                                                     "contact.depth_room"};
  return !path.starts_with("stop.") && !path.starts_with("forks") &&
         std::find(kIdle.begin(), kIdle.end(), path) == kIdle.end();
}

}  // namespace

SceneContent scene_content(const ResolvedScene& resolved) {
  SceneContent content;
  for (const Entry& entry : resolved.entries)
    if (matters(entry.path))
      content[entry.path] = entry.unit.empty() ? entry.value : entry.value + " " + entry.unit;
  for (const auto& [place, text] : resolved.source.files) content["file " + place] = text;
  return content;
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
