#pragma once
// Lengths of a rail and numbers of its fastenings that let the wheel roll on, for messages.

#include <optional>
#include <string>

#include "core/scene.hpp"

namespace tread {

/// Largest fastenings.count whose pads all lie on a rail of this length [m]; 1 at least.
int most_fastenings(const FasteningSpec& fastenings, double rail_length);

/// Keys with which the wheel may roll to x [m]: `rail.length = "22.9 m" and fastenings.count = 35`. Of a
/// scene with [rail]. nullopt beyond the longest rail.
std::optional<std::string> keys_to_reach(const Scene& scene, double x);

}  // namespace tread
