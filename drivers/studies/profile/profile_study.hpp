#pragma once
// `tread profile`: what a profile's file holds, and where two profiles touch.

#include "drivers/studies/profile/profile_options.hpp"

namespace tread {

/// Reads, prints and writes. ProblemsError with every bad line of a file, InputError.
void profile(const ProfileOptions& options);

}  // namespace tread
