#pragma once
// The values of a scene on which the results of a run depend.

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "io/scene/effects.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// Values by key; that of a key that names a file is the file's checksum.
using SceneContent = std::map<std::string, std::string>;

/// Texts of files that a scene names, by absolute path.
using SceneFiles = decltype(SceneSource::files);

/// Content of the keys whose effects `counts`.
SceneContent content_of(const ResolvedScene& resolved, const std::function<bool(Effects)>& counts);

/// Everything that the results depend on (Effects::on_results).
SceneContent scene_content(const ResolvedScene& resolved);

/// Everything that the preload depends on (Effects::on_preload), add_run() included.
SceneContent preload_content(const ResolvedScene& resolved);

/// Adds the stretch of track that the wheel can touch, and the finely divided one, which is another where it
/// stands: by them many keys together act on the mesh.
void add_run(SceneContent& content, const Scene& scene);

inline constexpr const char* kKeptScene = "scene.resolved.toml";  ///< of a run's or a study's folder

/// A scene as a folder keeps it.
struct KeptScene {
  ResolvedScene resolved;
  SceneContent content;  ///< of the files that it names as they were when it was kept
};

/// Leaves the scene in the folder: kKeptScene and, where it names files, their checksums.
void keep_scene(const std::filesystem::path& folder, const ResolvedScene& resolved);
/// Files as the kept checksums tell them: texts of `known`, files at their place, files that have moved
/// together with the folder, or else other contents at their place. Throws InputError, which names files that
/// are nowhere.
KeptScene kept_scene(const std::filesystem::path& folder, const SceneFiles& known = {});

/// The first thing that differs, "motion.speed is 83.3333 m/s here and 27.7778 m/s there"; empty where
/// nothing does.
std::string difference(const SceneContent& here, const SceneContent& there);

}  // namespace tread
