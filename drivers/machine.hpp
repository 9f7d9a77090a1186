#pragma once
// What the commands ask of the machine.

#include <cstdint>
#include <filesystem>

namespace tread {

/// `wanted` threads, or as many as the machine has if it is 0.
void use_threads(int wanted);

/// Largest resident memory of this process so far [B].
std::int64_t peak_memory();

/// Creates the directory and its parents where they are missing. Throws ResourceError.
void make_directory(const std::filesystem::path& directory);

}  // namespace tread
