#pragma once
// report.html of a run.

#include <filesystem>
#include <string>

#include "drivers/engine/model/model.hpp"
#include "drivers/report/provenance.hpp"
#include "drivers/results/run_results.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// Writes the report from evaluated results; date and machine are those of this process. Chapters that the
/// scene gives no matter for are left out. Throws ResourceError; an older file stays until the new one is
/// complete.
void write_run_report(const std::filesystem::path& path, const Model& model, const ResolvedScene& resolved,
                      const RunResults& results, const Provenance& provenance);

}  // namespace tread
