#pragma once
// Version of the program, and how it was compiled.

namespace tread {

/// "0.1.0": the version that CMakeLists.txt states.
const char* program_version();

struct ProgramBuild {
  const char* compiler;  ///< "GNU 12.2.0"
  const char* type;      ///< "Release"
  const char* packages;  ///< "Eigen 3.4.0, fmt 9.1.0"
};
ProgramBuild program_build();

}  // namespace tread
