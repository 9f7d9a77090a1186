#pragma once
// Measured depths over a surface, from text or HDF5.

#include <filesystem>
#include <string>

namespace tread {

/// The text of a map for parse_grid(): that of the file, or, of an HDF5 file, its datasets as such a text. An
/// HDF5 file holds `x`, `y` and `depth`, the last with a row for each y; the attribute `unit` of each states
/// its unit (without it: m). Throws InputError.
std::string read_map_text(const std::filesystem::path& path);

}  // namespace tread
