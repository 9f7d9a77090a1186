#pragma once
// Which runs a dial consists of.

#include <filesystem>
#include <string>
#include <vector>

#include "io/scene/study_reader.hpp"

namespace tread {

/// The user's choice of points of a scene's dial.
struct DialAxes {
  std::vector<std::string> base;  ///< "key=value"; empty: elements of 5 mm
  std::vector<std::string> axes;  ///< "key=value,value"; empty: default_axes()
};

struct DialDesign {
  Study study;
  std::string base;  ///< point that the axes start from; empty where a study states the points
};

/// A file with a table [study] is a study, whose points are the dial's; any other is a scene, which is varied
/// one key at a time from the base. Throws InputError for axes beside a study, axes that do not read, and
/// keys that make another passage; what the scene says of values is left to plan_study().
DialDesign design_dial(const std::filesystem::path& file, const DialAxes& axes);

/// Element sizes and qualities, precisions, penalty, step, surface, start, ground, as far as they suit the
/// scene; in the form of DialAxes::axes.
std::vector<std::string> default_axes(const Scene& scene);

}  // namespace tread
