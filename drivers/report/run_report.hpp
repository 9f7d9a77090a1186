#pragma once
// report.html of a run.

#include <filesystem>
#include <string>

#include "drivers/engine/model.hpp"
#include "drivers/results/run_results.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// Writes the report from evaluated results; `command` is what the user typed. Chapters that the scene gives
/// no matter for are left out. Throws ResourceError; an older file stays until the new one is complete.
void write_run_report(const std::filesystem::path& path, const Model& model, const ResolvedScene& resolved,
                      const RunResults& results, const std::string& command);

}  // namespace tread
