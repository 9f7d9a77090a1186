#pragma once
// The values of a scene with their sources. Private to the reader of scenes.

#include <map>
#include <string>
#include <vector>

#include "core/scene.hpp"
#include "io/scene/entry.hpp"
#include "io/scene/setting.hpp"

namespace tread {

/// Every value that has an effect in the scene; `settings` by path, those that were read.
std::vector<Entry> scene_entries(Scene& scene, const std::map<std::string, Setting>& settings);

}  // namespace tread
