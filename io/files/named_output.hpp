#pragma once
// Files that the user names, which may be pipes, devices and links.

#include <filesystem>
#include <functional>
#include <string_view>

namespace tread {

/// Returns true if other files can lie beside the named one: it is no pipe or device, nor what stdout or
/// stderr lead to.
bool has_neighbours(const std::filesystem::path& path);

/// Throws InputError if the output would replace the file that the command reads.
void require_other_file(const std::filesystem::path& output, const std::filesystem::path& input);

/// Replaces the file as replace_file() does; files beside it stay as they are. A link stays, and the file
/// that it leads to is replaced; a pipe or device is written to directly, and a file that stdout or stderr
/// leads to gets the data at its place there. Throws ResourceError.
void write_named_file(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& part)>& write);

/// Does so with `text`.
void write_named_text(const std::filesystem::path& path, std::string_view text);

}  // namespace tread
