#pragma once
// `tread compare`: a force over way or time from elsewhere beside that of a run.

#include <filesystem>
#include <string>

#include "drivers/report/provenance.hpp"

namespace tread {

struct CompareOptions {
  std::filesystem::path run;     ///< directory of the run
  std::filesystem::path file;    ///< two columns with a unit line
  std::string force = "F_N";     ///< or "F_L"
  std::string mean;              ///< "7 mm"; empty: none
  std::string offset;            ///< added to the file's first column
  std::string first, last;       ///< places of the wheel; empty: the whole way that both cover
  std::filesystem::path output;  ///< directory; empty: the run's
  bool json = false;             ///< an object instead of a table on stdout
  Provenance origin;
};

/// Prints the comparison and writes compare.html, compare.json and figures/compare.svg and .csv. Errors leave
/// as Error.
void compare_curves(const CompareOptions& options);

}  // namespace tread
