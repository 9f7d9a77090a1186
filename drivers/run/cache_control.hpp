#pragma once
// `tread cache`: preloads that earlier runs have left for later ones.

#include <string>

namespace tread {

struct CacheOptions {
  std::string action;  ///< "show" or "clear"
  std::string place;   ///< as in preload_cache()
  bool json = false;
};

/// Prints what the preload cache holds, or empties it. ResourceError where it cannot be emptied.
void tend_cache(const CacheOptions& options);

}  // namespace tread
