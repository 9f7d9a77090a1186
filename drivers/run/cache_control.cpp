#include "drivers/run/cache_control.hpp"

#include <fmt/core.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <vector>

#include "drivers/process/progress.hpp"
#include "drivers/run/preload_cache.hpp"
#include "io/report/plain_text.hpp"
#include "io/text/json.hpp"

namespace tread {

namespace {

/// Since the entry was used; negative if the clock was ahead then [s].
double age(const ContentCache::Entry& entry) {
  return std::chrono::duration<double>(std::filesystem::file_time_type::clock::now() - entry.used).count();
}

void show_text(const ContentCache& cache, const std::vector<ContentCache::Entry>& entries,
               std::int64_t bytes) {
  fmt::print("{}: {} preloads, {} of at most {}\n", cache.folder().string(), entries.size(),
             bytes_text(bytes), bytes_text(cache.limit()));
  for (const ContentCache::Entry& entry : entries) {
    const double unused = age(entry);
    fmt::print(
        "  {}  {:>8}  {}\n", entry.path.filename().string(), bytes_text(entry.bytes),
        unused < 0 ? "used when the clock was ahead" : fmt::format("used {} ago", duration_text(unused)));
  }
}

void show_json(const ContentCache& cache, const std::vector<ContentCache::Entry>& entries,
               std::int64_t bytes) {
  Json preloads = Json::array();
  for (const ContentCache::Entry& entry : entries) {
    const double unused = age(entry);
    preloads.push_back({{"file", entry.path.filename().string()},
                        {"bytes", entry.bytes},
                        {"unused_s", unused < 0 ? Json() : Json(unused)}});
  }
  fmt::print("{}", json_text({{"folder", cache.folder().string()},
                              {"bytes", bytes},
                              {"limit_bytes", cache.limit()},
                              {"preloads", preloads}}));
}

}  // namespace

void tend_cache(const CacheOptions& options) {
  const std::optional<ContentCache> cache = preload_cache(options.place);
  if (!cache) {
    fmt::print("{}", options.json ? "{}\n" : "the preload cache is off\n");
    return;
  }
  if (options.action == "clear") cache->clear();
  const std::vector<ContentCache::Entry> entries = cache->entries();
  std::int64_t bytes = 0;
  for (const ContentCache::Entry& entry : entries) bytes += entry.bytes;
  (options.json ? show_json : show_text)(*cache, entries, bytes);
}

}  // namespace tread
