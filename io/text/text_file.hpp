#pragma once
// Whole text files into memory, with a reason where that fails.

#include <cstddef>
#include <filesystem>
#include <string>

namespace tread {

/// All bytes of a file of at most `limit`. Throws InputError when it is missing, unreadable, not a regular
/// file, or larger.
std::string read_bytes(const std::filesystem::path& path, std::size_t limit);

/// Reads a text file of at most `limit` bytes. Throws InputError when the file is missing, unreadable, not a
/// regular file, larger than the limit, or binary (contains NUL bytes).
std::string read_text_file(const std::filesystem::path& path, std::size_t limit);

/// The text without the byte-order mark with which Windows begins a file in UTF-8.
std::string without_mark(std::string text);

}  // namespace tread
