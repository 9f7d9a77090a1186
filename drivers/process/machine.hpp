#pragma once
// What the commands ask of the machine.

#include <cstdint>
#include <filesystem>
#include <string>

namespace tread {

struct ThreadOptions {
  int number = 0;       ///< 0: as many as the machine has
  std::string backend;  ///< library that runs them; empty: the default
};

/// InputError for an unknown backend.
void use_threads(const ThreadOptions& options);

/// From now on the memory of large arrays goes back to the machine with them, so that what one phase has
/// needed is there for all programs in the next.
void give_back_large_arrays();

/// Largest resident memory of this process so far [B].
std::int64_t peak_memory();

/// Creates the directory and its parents where they are missing. Throws ResourceError.
void make_directory(const std::filesystem::path& directory);

}  // namespace tread
