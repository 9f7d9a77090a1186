#pragma once
// Measured depths of a running surface, from text or HDF5.

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene.hpp"
#include "io/scene/problems.hpp"

namespace tread {

/// Largest depth of a running surface, up or down [m].
inline constexpr double kDeepestSurface = 0.01;

/// The text of a map for parse_grid(): that of the file, or, of an HDF5 file, its datasets as such a text. An
/// HDF5 file holds `x`, `y` and `depth`, the last with a row for each y; the attribute `unit` of each states
/// its unit. Throws InputError.
std::string read_map_text(const std::filesystem::path& path);

/// Takes the depths of a corrugation, of a table or a map, from a file's text. Every bad line is added to
/// `problems`.
void set_depths(const std::string& text, const std::string& name, CorrugationSpec& corrugation,
                std::vector<Problem>& problems);

/// Takes the depths of the shape, of a profile or a map, from a file's text. `wheel_radius` turns angles into
/// lengths [m]. Every bad line is added to `problems`.
void set_depths(const std::string& text, const std::string& name, double wheel_radius, SurfaceSpec& surface,
                std::vector<Problem>& problems);

}  // namespace tread
