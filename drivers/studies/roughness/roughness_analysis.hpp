#pragma once
// `tread roughness`: levels of a measured profile.

#include <filesystem>
#include <string>

#include "drivers/process/machine.hpp"

namespace tread {

struct RoughnessOptions {
  std::filesystem::path file;    ///< two columns: x and height
  std::string units;             ///< of both columns, "m,um"; empty: stated in the file
  std::string segment = "2 m";   ///< length of the averaged segments
  bool depth = false;            ///< the second column counts downwards
  bool raw = false;              ///< neither spikes nor pits are removed
  std::filesystem::path output;  ///< directory of CSV, SVG and report; empty: none
  ThreadOptions threads;
  bool json = false;    ///< levels as JSON on stdout instead of a table
  std::string command;  ///< the command line, for the report
};

/// Reads, processes, prints and writes. ProblemsError with every bad line of the file, InputError.
void roughness(const RoughnessOptions& options);

}  // namespace tread
