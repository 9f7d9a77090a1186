#pragma once
// `tread sweep`: a scene with some keys varied, a run for each point, one comparison.

#include <filesystem>

#include "drivers/studies/study/run_study.hpp"

namespace tread {

struct SweepOptions {
  std::filesystem::path study;
  StudyOptions common;
};

/// Runs the study's points that are not done and leaves sweep.csv and report.html; prints the results. Throws
/// and returns what run_study() does.
std::optional<Error> sweep(const SweepOptions& options);

}  // namespace tread
