#pragma once
// Options of `tread import`.

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/process/machine.hpp"

namespace tread {

struct ImportOptions {
  std::filesystem::path file;
  std::string unit;                ///< of the file's lengths: "mm"
  std::vector<std::string> parts;  ///< by name or number; empty: all
  int pieces = 1;                  ///< bodies without a common face
  std::string youngs_modulus = "205.9 GPa";
  std::string density = "7790 kg/m3";
  double poissons_ratio = 0.3;
  ThreadOptions threads;
  bool json = false;
};

}  // namespace tread
