#pragma once
// Absolute paths as the file system reads them.

#include <filesystem>

namespace tread {

/// Absolute path without "." and "..". Behind a link to a folder, ".." leads to the folder above its target.
/// The path is not empty; nothing need stand there.
std::filesystem::path absolute_path(const std::filesystem::path& path);

}  // namespace tread
