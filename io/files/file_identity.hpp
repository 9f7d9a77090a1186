#pragma once
// The file or folder that a path leads to, known again by device and number.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

namespace tread {

/// A file or folder under the path that led to it when this was made.
class FileIdentity {
 public:
  explicit FileIdentity(std::filesystem::path path);

  /// Returns true while the path leads to the same one: it was neither moved, removed nor replaced.
  bool in_place() const;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> known_;  ///< device, number; nothing: was missing
};

/// Returns true if the path, from an open folder or AT_FDCWD, leads to the open file and not to a link.
bool leads_to(int folder, const char* path, int descriptor);

}  // namespace tread
