#pragma once
// Room of the passages of a development for waves that grow, and way of their wheel before the corrugation.

#include <string>

#include "io/scene/scene_reader.hpp"

namespace tread {

/// Room that passage 0 leaves for growing waves [m]: for those of so many passages where its wheel has way
/// enough before the solution zone, otherwise for waves twice as deep. Throws InputError where the wheel
/// stands too near the zone for a state before it, or where the patch may meet the corrugation before a
/// stated forks.at.
double room_of_passage0(const ResolvedScene& resolved, int passages);

/// Sentence, with the way out, on waves of so many passages that may outgrow the `room` that passage 0 leaves
/// [m], as room_of_passage0() has it; empty where they cannot.
std::string short_room(const Scene& scene, double room, int passages);

/// Sentence on waves of so many passages that may outgrow the room of the run `from`, as in fork_from();
/// empty where they cannot. Throws InputError where that run has no room for the scene's corrugation.
std::string outgrown_room(const Scene& scene, const std::string& from, int passages);

}  // namespace tread
