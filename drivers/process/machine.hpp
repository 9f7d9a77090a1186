#pragma once
// Threads, memory and directories of the machine, as the commands need them.

#include <cstdint>
#include <filesystem>
#include <string>

namespace tread {

struct ThreadOptions {
  int number = 0;       ///< number of threads; 0: as many as the machine has
  std::string backend;  ///< library that runs the threads; empty: the default
};

/// Sets the number and the backend of the threads. Throws InputError for an unknown backend.
void use_threads(const ThreadOptions& options);

/// Makes freed large arrays return their memory to the machine at once. The memory of one phase is then free
/// for all programs in the next.
void give_back_large_arrays();

/// Largest resident memory of this process so far [B].
std::int64_t peak_memory();

/// Creates the directory and its missing parents. Throws ResourceError.
void make_directory(const std::filesystem::path& directory);

}  // namespace tread
