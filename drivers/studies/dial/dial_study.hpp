#pragma once
// `tread dial`: cost of a passage by settings, and the error against the finest settings.

#include <filesystem>
#include <string>

#include "drivers/studies/dial/dial_design.hpp"
#include "drivers/studies/study/run_study.hpp"

namespace tread {

struct DialOptions {
  std::filesystem::path file;  ///< a scene, or a study that states the points
  DialAxes axes;
  std::string reference;               ///< a point, or the folder of a finished run; empty: the finest run
  std::string against;                 ///< a point that runs on its mesh are told against; empty: the base
  std::string cost = "element-steps";  ///< or "minutes"
  StudyOptions common;
};

/// Runs the points that are not done and leaves dial.csv, dial.jsonl, effects.csv, results.md, sweep.csv and
/// report.html; prints errors and the cheapest settings. Throws and returns what run_study()
/// does; InputError for a reference that is not of the same passage.
std::optional<Error> turn_dial(const DialOptions& options);

}  // namespace tread
