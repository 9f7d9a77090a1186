#include "io/files/content_cache.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <span>
#include <thread>

#include "core/error.hpp"
#include "core/math/hash.hpp"
#include "io/files/output_file.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

constexpr const char* kCachedKind = "cached";
/// Version of the files' form. Raise it whenever the form changes; the version of their content is part of
/// the key.
constexpr int kVersion = 1;
constexpr const char* kKey = "key";
constexpr const char* kEntrySuffix = ".h5";
constexpr const char* kClaims = "claims.lock";  ///< name of the lock file, which stays empty in the folder
constexpr std::size_t kDigits = 16;

std::uint64_t hash_of(const std::string& key) {
  Hash hash;
  hash.add(std::as_bytes(std::span(key)));
  return hash.value();
}

fs::path path_of(const fs::path& folder, const std::string& key) {
  return folder / fmt::format("{:016x}{}", hash_of(key), kEntrySuffix);
}

/// Returns true if path_of() gives such names. No other file in the folder is touched.
bool is_entry(const fs::path& path) {
  const std::string stem = path.stem().string();
  return path.extension() == kEntrySuffix && stem.size() == kDigits &&
         stem.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// Lock for processes that change the folder. Readers see whole files without it.
FileLock take(const fs::path& folder) {
  constexpr int kTries = 100;
  for (int i = 0; i < kTries; ++i) {
    if (std::optional<FileLock> lock = FileLock::try_folder(folder)) return std::move(*lock);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  throw ResourceError(fmt::format("another process has held {} for 10 s", folder.string()));
}

/// Removes unfinished files of processes that were killed while they wrote. Call it under the lock.
void remove_entry_parts(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".part" && is_entry(entry.path().stem()))
      fs::remove(entry.path(), ignored);
}

}  // namespace

std::optional<SealedContent> ContentCache::find(const std::string& key, std::string& refused) const {
  const fs::path path = path_of(folder_, key);
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(path, ignored))) return std::nullopt;
  try {
    SealedContent content = read_sealed(path, kCachedKind, kVersion);
    if (sealed_entry<std::string>(content, kKey) != key) return std::nullopt;  // another key, same hash
    content.erase(kKey);
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
    return content;
  } catch (const InputError& error) {
    refused = error.what();
    return std::nullopt;
  }
}

void ContentCache::store(const std::string& key, SealedContent content) const {
  create_folder(folder_);
  content[kKey] = key;
  const FileLock lock = take(folder_);
  remove_entry_parts(folder_);
  const fs::path path = path_of(folder_, key);
  replace_file(path, [&](const fs::path& part) {
    write_sealed(part, kCachedKind, kVersion, content);
    require_room_for(part);
  });
  trim(path);
}

std::optional<FileLock> ContentCache::claim(const std::string& key) const {
  create_folder(folder_);
  return FileLock::try_number(folder_ / kClaims, hash_of(key));
}

std::vector<ContentCache::Entry> ContentCache::entries() const {
  std::vector<Entry> list;
  std::error_code error;
  for (const fs::directory_entry& file : fs::directory_iterator(folder_, error)) {
    if (!is_entry(file.path()) || file.is_symlink(error) || !file.is_regular_file(error)) continue;
    const auto bytes = static_cast<std::int64_t>(file.file_size(error));
    const fs::file_time_type used = error ? fs::file_time_type{} : file.last_write_time(error);
    if (!error) list.push_back({file.path(), bytes, used});  // error: another process removed it
  }
  // Times to come are those of a clock that was ahead.
  const fs::file_time_type now = fs::file_time_type::clock::now();
  const auto known = [now](const Entry& entry) {
    return entry.used > now ? fs::file_time_type::min() : entry.used;
  };
  std::sort(list.begin(), list.end(), [&](const Entry& a, const Entry& b) { return known(a) > known(b); });
  return list;
}

void ContentCache::require_room_for(const fs::path& part) const {
  std::error_code ignored;
  const auto bytes = static_cast<std::int64_t>(fs::file_size(part, ignored));
  if (bytes > limit_)
    throw ResourceError(fmt::format("it has {:.1f} MB, and TREAD_CACHE_LIMIT leaves {} {:.1f} MB",
                                    1e-6 * static_cast<double>(bytes), folder_.string(),
                                    1e-6 * static_cast<double>(limit_)));
}

void ContentCache::trim(const fs::path& stored) const {
  std::vector<Entry> list = entries();
  std::stable_partition(list.begin(), list.end(), [&](const Entry& entry) { return entry.path == stored; });
  std::int64_t sum = 0;
  std::error_code ignored;
  for (const Entry& entry : list) {
    sum += entry.bytes;
    if (sum > limit_) fs::remove(entry.path, ignored);
  }
}

void ContentCache::clear() const {
  if (!fs::exists(folder_)) return;
  const FileLock lock = take(folder_);
  remove_entry_parts(folder_);
  for (const Entry& entry : entries()) {
    std::error_code error;
    fs::remove(entry.path, error);
    if (error) throw ResourceError(fmt::format("cannot remove {}: {}", entry.path.string(), error.message()));
  }
}

}  // namespace tread
