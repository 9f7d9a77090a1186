#pragma once
// Cache of results that are expensive to compute, by key, for later processes.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/files/file_lock.hpp"
#include "io/files/sealed_file.hpp"

namespace tread {

/// Folder with one file per key. Several processes may use it at once.
class ContentCache {
 public:
  /// `limit`: bound on the size of all files together [B].
  ContentCache(std::filesystem::path folder, std::int64_t limit)
      : folder_(std::move(folder)), limit_(limit) {}

  /// Content stored under the key, which then counts as used; nullopt if there is none. If the file of the
  /// key is unusable, the reason goes to `refused`.
  std::optional<SealedContent> find(const std::string& key, std::string& refused) const;

  /// Stores the content, then removes the least recently used other files until the limit is kept. Throws
  /// ResourceError, also where the content alone is beyond the limit; the older files then stay.
  void store(const std::string& key, SealedContent content) const;

  /// Lock of the process that computes the content of the key; nullopt while another process holds it. It
  /// needs no entry and hinders neither find() nor store(). Throws ResourceError if the folder cannot be
  /// written.
  std::optional<FileLock> claim(const std::string& key) const;

  struct Entry {
    std::filesystem::path path;
    std::int64_t bytes;                    ///< size [B]
    std::filesystem::file_time_type used;  ///< to come: the clock was ahead
  };
  /// All files, the last used first, those of times to come at the end; empty if there is no folder.
  std::vector<Entry> entries() const;

  /// Removes all entries. Throws ResourceError.
  void clear() const;

  const std::filesystem::path& folder() const { return folder_; }
  std::int64_t limit() const { return limit_; }

 private:
  /// ResourceError where the file alone is beyond the limit.
  void require_room_for(const std::filesystem::path& part) const;
  /// Removes files beyond the limit, `stored` last.
  void trim(const std::filesystem::path& stored) const;

  std::filesystem::path folder_;
  std::int64_t limit_;
};

}  // namespace tread
