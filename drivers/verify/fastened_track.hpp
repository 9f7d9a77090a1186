#pragma once
// The paper's rail on its fastenings alone, as the verification cases of the track share it.

#include <string>
#include <vector>

#include "drivers/verify/verify_case.hpp"

namespace tread {

/// element_size, spacing, stiffness and damping of the fastenings.
std::vector<VerifyInput> track_inputs();

/// Scene text: wheelset, vehicle and rail of the paper, as many fastenings as the rail takes, no slab. Tables
/// may follow.
std::string track_text(const VerifyInputs& inputs, double element_size);

}  // namespace tread
