#pragma once
// The values of a scene on which the results of a run depend.

#include <filesystem>
#include <map>
#include <string>

#include "io/scene/scene_reader.hpp"

namespace tread {

/// Values by key, and checksums of files by their place, of everything that the results depend on: titles,
/// and what concerns the process that runs the scene alone ([stop], intervals of progress and checkpoints),
/// or the runs that begin with its state ([forks], the room for their corrugations), are left out.
using SceneContent = std::map<std::string, std::string>;

SceneContent scene_content(const ResolvedScene& resolved);

inline constexpr const char* kKeptScene = "scene.resolved.toml";  ///< of a run's or a study's folder

/// The key of a file's checksum.
std::string file_key(const std::string& place);

/// A scene as a folder keeps it.
struct KeptScene {
  ResolvedScene resolved;
  SceneContent content;  ///< of the files that it names as they were when it was kept
};

/// Leaves the scene in the folder: kKeptScene and, where it names files, their checksums.
void keep_scene(const std::filesystem::path& folder, const ResolvedScene& resolved);
/// Throws InputError.
KeptScene kept_scene(const std::filesystem::path& folder);

/// The first thing that differs, "motion.speed is 83.3333 m/s here and 27.7778 m/s there"; empty where
/// nothing does.
std::string difference(const SceneContent& here, const SceneContent& there);

}  // namespace tread
