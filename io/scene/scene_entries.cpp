#include "io/scene/scene_entries.hpp"

#include <optional>

#include "io/scene/field_text.hpp"
#include "io/scene/schema.hpp"

namespace tread {

std::vector<Entry> scene_entries(Scene& scene, const std::map<std::string, Setting>& settings) {
  std::vector<Entry> list;
  for (const Key& key : scene_keys(scene)) {
    if (!key.locate || !applies(key, scene)) continue;
    const std::optional<FieldText> text = field_text(key, key.locate(scene));
    if (!text) continue;
    const auto setting = settings.find(key.path);
    const std::string source = setting == settings.end() ? "default" : setting->second.origin.source;
    list.push_back({key.path, text->value, text->unit, source, key.description, text->shown});
  }
  return list;
}

}  // namespace tread
