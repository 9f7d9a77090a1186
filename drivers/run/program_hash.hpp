#pragma once
// The program that runs, by its bytes.

#include <cstdint>

namespace tread {

/// Hash of the running program's own bytes: another build may find other bits.
std::uint64_t program_hash();

}  // namespace tread
