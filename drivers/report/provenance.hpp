#pragma once
// Origin of the results in a report.

#include <string>

#include "io/report/report.hpp"

namespace tread {

/// Origin of the results of a run or a study that neither scene nor results state.
struct Provenance {
  std::string program;  ///< name, version and commit
  std::string command;  ///< command as typed
};

/// Ends the report with the command as its footer and a chapter of program, command, scene, date and machine;
/// the last two are those of this process. `scene`: name of the scene's file.
void state_provenance(Report& report, const std::string& scene, const Provenance& provenance);

}  // namespace tread
