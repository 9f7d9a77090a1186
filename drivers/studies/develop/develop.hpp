#pragma once
// `tread develop`: passages over a rail that each wears for the next.

#include <filesystem>
#include <string>

#include "drivers/report/provenance.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

struct DevelopOptions {
  std::filesystem::path output;  ///< directory
  int passages = 10;             ///< simulated in all, those of earlier calls included
  std::string from;              ///< a run whose state all passages begin with, as in fork_from(); or empty
  int threads = 0;               ///< of a passage; 0: all
  std::string device;            ///< takes the steps of all passages; empty: the processor
  std::string launcher;          ///< words that start a passage elsewhere, "srun -N1"; empty: here
  bool json = false;             ///< instead of a table
  bool quiet = false;
  Provenance origin;
};

/// Runs the passages that the folder lacks and leaves profiles/, work/, profiles.csv, spectra.csv,
/// growth.csv, development.json, figures and report.html there. InputError, NumericalError, ResourceError;
/// Interrupted where the same command goes on.
void develop(const ResolvedScene& resolved, const DevelopOptions& options);

}  // namespace tread
