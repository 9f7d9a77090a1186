#pragma once
// Format of a profile's file, by its suffix or its content.

#include <filesystem>
#include <string>
#include <vector>

#include "io/profiles/profile_points.hpp"

namespace tread {

enum class ProfileFormat { two_columns, simpack, miniprof, columns };

ProfileFormat profile_format(const std::string& text, const std::filesystem::path& path);

/// Reads a format other than two columns. Every bad line is added to `faults`.
FilePoints read_profile_points(ProfileFormat format, const std::string& text, std::vector<LineFault>& faults);

}  // namespace tread
