#pragma once
// The ranks that a launcher (mpirun, srun) has started together.

#include <memory>
#include <string>

#include "core/parallel/ranks.hpp"

namespace tread {

/// The ranks of this process's launcher; null where the process is alone, and the library of messages then
/// stays untouched. Throws InputError where the others cannot be joined: by a build without such a library,
/// or with another one than the launcher's.
std::shared_ptr<Ranks> launched_ranks();

/// Name and version of the library of messages; empty where the program was built without.
std::string rank_library();

}  // namespace tread
