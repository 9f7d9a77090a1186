#pragma once
// Name, version and commit of the program.

#include <string>

namespace tread {

/// States the commit of the sources, program_commit().
void state_commit();

/// "tread 0.1.0, commit 24b0c2e13a77"; without commit outside of a clone.
std::string program_name();

}  // namespace tread
