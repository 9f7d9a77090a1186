#pragma once
// Threads and memory of the machine, as the commands need them.

#include <cstdint>
#include <string>
#include <vector>

namespace tread {

struct ThreadOptions {
  int number = 0;       ///< number of threads; 0: as many as the machine has
  std::string backend;  ///< library that runs the threads; empty: the default
  bool bind = false;    ///< they stay on cores of their own [bind_threads]
};

/// Numbers of the cores that this process may use; empty where the machine does not say.
std::vector<int> allowed_cores();
/// Number of cores that this process may use: allowed_cores(), or fewer by group_limits().
int machine_cores();
/// Memory of the machine, or of the container that this process runs in [B].
std::int64_t machine_memory();

/// Sets the number, the backend and the cores of the threads; by default this rank's share of the cores.
/// Warns of more threads than cores. Throws InputError for an unknown backend.
void use_threads(const ThreadOptions& options);

/// Time that this process has used on all cores [s].
double processor_seconds();

/// Makes freed arrays of 1 MiB and more return their memory to the machine at once, so that the memory of one
/// phase is free for all programs in the next. Up to 64 MiB of small ones are kept.
void give_back_large_arrays();

/// Largest resident memory of this process so far [B].
std::int64_t peak_memory();

}  // namespace tread
