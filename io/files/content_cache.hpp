#pragma once
// Results that are dear to find and the same for the same question, kept for later processes.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/files/file_lock.hpp"
#include "io/files/sealed_file.hpp"

namespace tread {

/// One file per question in a folder that several processes may use at once.
class ContentCache {
 public:
  /// `limit`: what all files together may take [B].
  ContentCache(std::filesystem::path folder, std::int64_t limit)
      : folder_(std::move(folder)), limit_(limit) {}

  /// What was stored under the key, which then counts as used; nothing where there is none. Why a file that
  /// is there is of no use goes to `refused`.
  std::optional<SealedContent> find(const std::string& key, std::string& refused) const;

  /// Keeps the content, then removes what has not been used for longest until the limit is kept. Throws
  /// ResourceError; what was there then stays.
  void store(const std::string& key, SealedContent content) const;

  /// Of who is finding out what belongs under the key; nothing where another process is. Needs no entry, and
  /// hinders nobody to find or store. ResourceError where the folder cannot be written.
  std::optional<FileLock> claim(const std::string& key) const;

  struct Entry {
    std::filesystem::path path;
    std::int64_t bytes;  ///< [B]
    std::filesystem::file_time_type used;
  };
  /// The last used first; none where there is no folder.
  std::vector<Entry> entries() const;

  /// Removes all of them. Throws ResourceError.
  void clear() const;

  const std::filesystem::path& folder() const { return folder_; }
  std::int64_t limit() const { return limit_; }

 private:
  void trim() const;

  std::filesystem::path folder_;
  std::int64_t limit_;
};

}  // namespace tread
