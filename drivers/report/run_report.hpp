#pragma once
// report.html of a run.

#include <filesystem>
#include <string>

#include "drivers/engine/model.hpp"
#include "drivers/results/run_results.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// Origin of a run's results that neither scene nor results state.
struct Provenance {
  std::string program;  ///< name, version and commit
  std::string command;  ///< command as typed
};

/// Writes the report from evaluated results; date and machine are those of this process. Chapters that the
/// scene gives no matter for are left out. Throws ResourceError; an older file stays until the new one is
/// complete.
void write_run_report(const std::filesystem::path& path, const Model& model, const ResolvedScene& resolved,
                      const RunResults& results, const Provenance& provenance);

}  // namespace tread
