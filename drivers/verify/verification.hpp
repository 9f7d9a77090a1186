#pragma once
// `tread verify`: the program beside theory, with bounds.

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/process/machine.hpp"

namespace tread {

struct VerifyOptions {
  std::vector<std::string> names;      ///< of cases; empty: all
  std::vector<std::string> overrides;  ///< "mu=0.25", for every chosen case that has the input
  std::filesystem::path output;        ///< directory for a page a case and the figures; empty: none
  ThreadOptions threads;
  std::string device;  ///< takes the steps; empty: the processor [choose_device]
  bool json = false;   ///< one object a line on stdout instead of a table; with `list` one list of objects
  bool list = false;   ///< cases and their inputs instead of running them; without names those of all
  bool quiet = false;
};

/// Runs the cases and prints a table, that of the finished cases also where one throws. Returns true if every
/// bound holds. InputError for unknown names, inputs and values.
bool verify(const VerifyOptions& options);

}  // namespace tread
