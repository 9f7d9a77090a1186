#pragma once
// Origin of the results in a report.

#include <string>

#include "io/report/report.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// Origin of a run's results that neither scene nor results state.
struct Provenance {
  std::string program;  ///< name, version and commit
  std::string command;  ///< command as typed
};

/// Chapter of program, command, scene, date and machine; the last two are those of this process.
Chapter provenance_chapter(const ResolvedScene& resolved, const Provenance& provenance);

}  // namespace tread
