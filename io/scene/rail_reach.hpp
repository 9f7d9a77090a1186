#pragma once
// Places on a rail, and how far a rail has to reach, for messages.

#include <optional>
#include <string>
#include <vector>

#include "core/scene.hpp"
#include "io/scene/require.hpp"

namespace tread {

/// Largest fastenings.count whose pads all lie on a rail of this length [m]; 1 at least.
int most_fastenings(const FasteningSpec& fastenings, double rail_length);

/// Keys with which the wheel may roll to x [m]: `rail.length = "22.9 m" and fastenings.count = 35`. Of a
/// scene with [rail]. nullopt beyond the longest rail.
std::optional<std::string> keys_to_reach(const Scene& scene, double x);

/// Requires a part at least of what goes from `first` to `last` [m] to be on the rail; `subject`: a
/// sentence's begin, with its verb.
void check_on_rail(const RailSpec& rail, double first, double last, std::vector<std::string> keys,
                   const std::string& subject, Require require);
/// The same of a point at x [m]; `point`: its name.
void check_on_rail(const RailSpec& rail, double x, std::vector<std::string> keys, const char* point,
                   Require require);

}  // namespace tread
