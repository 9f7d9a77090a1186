#pragma once
// Version and commit of the program, and how it was compiled.

#include <string>

namespace tread {

/// "0.1.0": the version that CMakeLists.txt states.
const char* program_version();

/// Commit of the sources, "24b0c2e13a77", with "-dirty" where they differ from it; empty outside of a clone,
/// and until the program has stated it.
const std::string& program_commit();

/// States the commit of the sources: libraries are not compiled anew for each.
void state_program_commit(std::string commit);

struct ProgramBuild {
  const char* compiler;  ///< "GNU 12.2.0"
  const char* type;      ///< "Release"
  const char* packages;  ///< "Eigen 3.4.0, fmt 9.1.0"
};
ProgramBuild program_build();

}  // namespace tread
