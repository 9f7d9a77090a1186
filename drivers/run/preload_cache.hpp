#pragma once
// Preloads that earlier runs have found. [robustness.md, Preload cache]

#include <functional>
#include <optional>
#include <string>

#include "drivers/engine/start/preload.hpp"
#include "io/files/content_cache.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// The cache at `place`: a folder, "off", or "", which leaves it to TREAD_CACHE (likewise a folder or "off")
/// or else is tread/ in XDG_CACHE_HOME or ~/.cache. TREAD_CACHE_LIMIT, "4 GB", bounds it. Nothing where it is
/// off. Throws InputError.
std::optional<ContentCache> preload_cache(const std::string& place);

struct FoundPreload {
  Preload preload;
  bool cached;         ///< found by an earlier run
  double seconds = 0;  ///< time of its solving, here or then [s]
};

/// The preload of a model made of `resolved`, and the model as solve_preload() leaves it: from the cache,
/// where that has it or another process is about to put it there (then `wait` is called now and then and may
/// throw); else what `solve` returns, which is kept.
FoundPreload find_preload(const std::optional<ContentCache>& cache, const ResolvedScene& resolved,
                          Model& model, const std::function<Preload()>& solve, const ProgressText& say,
                          const std::function<void()>& wait);

/// The model's preload, from the default cache or solved, and the model with its corrugation, as a run has it
/// before its first step.
Preload preload_and_corrugate(const ResolvedScene& resolved, Model& model, const ProgressText& say);

}  // namespace tread
