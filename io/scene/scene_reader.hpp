#pragma once
// From a scene file to a Scene, and back to a file that states every value.

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/scene.hpp"
#include "io/scene/entry.hpp"

namespace tread {

/// The text of a scene and where it stands.
struct SceneSource {
  std::string name;              ///< as messages call it: the path that the user gave
  std::string text;              ///< TOML
  std::filesystem::path folder;  ///< files that the scene names are relative to it
  /// Texts of files that the scene names, by absolute path; they hold in place of what stands on the disk.
  /// Copies share them. None is null.
  std::map<std::string, std::shared_ptr<const std::string>> files = {};
};

/// Reads the file's text. Links to its folder are resolved: files that the scene names keep their paths when
/// the links change. Throws InputError when the file is missing, unreadable, not text, or larger than 1 MB.
SceneSource load_scene_source(const std::filesystem::path& path);

struct ResolvedScene {
  Scene scene;
  std::string name;    ///< of the source
  SceneSource source;  ///< with all files that the scene names
  std::vector<std::string> overrides;
  std::vector<Entry> entries;  ///< every value that has an effect, in the order of the schema
};

/// Reads, completes and checks a scene. Values come from, in rising order: the defaults, the library entry
/// that scene.based_on names, the source, and the overrides ("motion.speed=250 km/h"). A table that is named
/// at one level brings in the whole table with the values of the levels below it; `present = false` leaves it
/// out. Throws ProblemsError with every problem found, or its base InputError.
ResolvedScene resolve_scene(const SceneSource& source, const std::vector<std::string>& overrides = {});
ResolvedScene resolve_scene(const std::filesystem::path& path,
                            const std::vector<std::string>& overrides = {});

inline Scene read_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides = {}) {
  return resolve_scene(path, overrides).scene;
}

/// The scene as a file that stands alone: every value in SI with its source. Reading it gives the same Scene.
std::string resolved_toml(const ResolvedScene& resolved);

}  // namespace tread
