#pragma once
// Version of the program.

namespace tread {

/// "0.1.0": the version that CMakeLists.txt states.
const char* program_version();

}  // namespace tread
