#pragma once
// A study file: one scene with some of its keys varied.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "io/scene/scene_reader.hpp"

namespace tread {

/// A value of a scene's key, and where the study states it.
struct StudySetting {
  std::string key;           ///< "motion.speed"
  std::string value;         ///< as after --set, "300 km/h"
  int line = 0, column = 0;  ///< 0: not in the study's file

  std::string as_override() const { return key + "=" + value; }
};

/// One scene of the study.
struct StudyPoint {
  std::string name;                  ///< of its folder, "speed=300km_h,mu=0.3"
  std::vector<StudySetting> varied;  ///< what tells it from the other points
  std::vector<StudySetting> own;     ///< what follows from that; Study::common goes before it
};

struct Study {
  std::string name;   ///< as messages call it: the path that the user gave
  std::string title;  ///< for reports
  std::filesystem::path scene;
  std::string scene_text = {};       ///< of a scene that no file holds yet
  std::vector<StudySetting> common;  ///< overrides of all points
  std::vector<StudyPoint> points;    ///< one at least, names that differ
  int jobs = 0;                      ///< runs at once; 0: not stated
  int threads = 0;                   ///< of one run; 0: not stated
  bool share = true;                 ///< points that are one run up to the corrugation roll there once
};

/// The most points of a study's grid.
inline constexpr std::size_t kMostPoints = 1000;
/// The longest name of a point [characters].
inline constexpr std::size_t kLongestPointName = 120;
/// The most runs at once, and the most threads of a run.
inline constexpr int kMostJobs = 4096;

/// Reads a study; `scene` becomes a path from the working directory, or that of a shipped scene. Throws
/// ProblemsError with every problem of the file itself, or its base InputError. What the scene says of the
/// values is checked by resolve_scene().
Study read_study(const std::filesystem::path& path);

/// Returns true if the text is that of a study rather than of a scene: it has a table [study]. Throws
/// ProblemsError where it is not TOML; messages call it `name`.
bool is_study(const std::string& text, const std::string& name);

/// "speed=300km_h,mu=0.3": the last parts of the keys, or as much of the keys as tells them apart, with their
/// values. A hash of the whole ends a name that would be too long.
std::string point_name(const std::vector<StudySetting>& varied);

}  // namespace tread
