#pragma once
// `tread multibody`: the traditional model of the same scene in a second.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drivers/process/machine.hpp"
#include "drivers/report/provenance.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

struct MultibodyOptions {
  std::string beam = "euler";               ///< "timoshenko", "spread" or "solid"
  std::string wheel = "rigid";              ///< "modal"
  std::string contact = "hertz";            ///< "half-space"
  std::optional<int> modes;                 ///< absent: those of modal_track()
  std::string step;                         ///< "5 us"; empty: chosen
  bool filter = false;                      ///< the corrugation as deep as the contact filter leaves it
  std::filesystem::path calibrate;          ///< directory of a transient run; empty: none
  std::vector<std::string> map;             ///< axes; empty: no map
  std::vector<std::filesystem::path> dots;  ///< directories of transient runs on the map
  std::filesystem::path output;             ///< directory of CSV, JSON and report; empty: none
  ThreadOptions threads;
  bool json = false;  ///< the summary on stdout instead of a table
  bool quiet = false;
  Provenance origin;
};

/// Rolls, fits and maps as asked, prints a table or JSON, writes the files. InputError, NumericalError.
void run_multibody_study(const ResolvedScene& resolved, const MultibodyOptions& options);

}  // namespace tread
