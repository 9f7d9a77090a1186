#pragma once
// The paper's rail on its fastenings alone, shared by the verification cases of the track.

#include <string>
#include <vector>

#include "drivers/verify/verify_case.hpp"

namespace tread {

/// Inputs element_size, spacing, stiffness and damping of the fastenings, sleepers and their bed, and where
/// the fastenings hold the foot.
std::vector<VerifyInput> track_inputs();

/// Scene text: wheelset, vehicle and rail of the paper, as many fastenings as the rail takes, no slab, with
/// or without sleepers. Tables may follow.
std::string track_text(const VerifyInputs& inputs, double element_size);

}  // namespace tread
