#pragma once
// Preloads that earlier runs have found. [long-runs.md, Preload cache]

#include <functional>
#include <optional>
#include <string>

#include "drivers/engine/preload.hpp"
#include "io/files/content_cache.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// The cache at `place`: a folder, "off", or "", which leaves it to TREAD_CACHE (likewise a folder or "off")
/// or else is tread/ in XDG_CACHE_HOME or ~/.cache. TREAD_CACHE_LIMIT, "4 GB", bounds it. Nothing where it is
/// off. Throws InputError.
std::optional<ContentCache> preload_cache(const std::string& place);

/// Everything that the preload's bits depend on: the program, the instruction set, and preload_content().
std::string preload_key(const ResolvedScene& resolved, const Model& model);

/// The preload that the cache has under the key, and the model as solve_preload() leaves it; nothing where it
/// has none. Why an entry is of no use goes to `say`.
std::optional<Preload> recall_preload(const ContentCache& cache, const std::string& key, Model& model,
                                      const ProgressText& say);

/// Waits while another process solves the preload of that key, at most half an hour; `wait` is called now and
/// then and may throw. After that the cache may have it; what is returned keeps other processes waiting.
/// Nothing where there are no locks.
std::optional<FileLock> claim_preload(const ContentCache& cache, const std::string& key,
                                      const ProgressText& say, const std::function<void()>& wait);

/// Keeps the preload; why it cannot goes to `say`.
void keep_preload(const ContentCache& cache, const std::string& key, Preload& preload,
                  const ProgressText& say);

}  // namespace tread
