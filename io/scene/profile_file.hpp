#pragma once
// Profiles of wheel and rail from files of any format.

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene.hpp"
#include "io/profiles/understood_profile.hpp"
#include "io/scene/problems.hpp"

namespace tread {

/// Axes of a file of two columns: those of the documentation, others being refused, or any that the shape
/// tells.
enum class ColumnAxes { as_documented, any };

/// The profile in a file's text. Every bad line is added to `problems`; the profile is then empty. Throws
/// InputError that names the file for points that are no wheel or rail.
UnderstoodProfile profile_of(const std::string& text, const std::filesystem::path& path,
                             const ProfileWish& wish, ColumnAxes axes, std::vector<Problem>& problems);

/// Wishes that a scene states for the file of its wheel or rail.
ProfileWish wish_of(const WheelSpec& wheel);
ProfileWish wish_of(const RailSpec& rail);

}  // namespace tread
