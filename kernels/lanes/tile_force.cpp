#include "kernels/lanes/tile_force.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "core/error.hpp"

namespace tread {

extern const TileForces tile_forces_baseline;
#ifdef TREAD_X86_LANES
extern const TileForces tile_forces_avx2;
extern const TileForces tile_forces_avx512;
#endif

namespace {

/// Moves the one that TREAD_INSTRUCTION_SET names to the front.
void prefer_named(std::vector<const TileForces*>& list) {
  const char* name = std::getenv("TREAD_INSTRUCTION_SET");
  if (!name || *name == '\0') return;
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const TileForces* f) { return std::string_view(f->name) == name; });
  if (found == list.end()) {
    std::string known;
    for (const TileForces* f : list) known += fmt::format("{}{}", known.empty() ? "" : ", ", f->name);
    throw InputError(fmt::format(
        "the environment's TREAD_INSTRUCTION_SET = {}: this program on this processor has {}", name, known));
  }
  std::rotate(list.begin(), found, found + 1);
}

}  // namespace

const std::vector<const TileForces*>& tile_forces() {
  static const std::vector<const TileForces*> available = [] {
    std::vector<const TileForces*> list;
#ifdef TREAD_X86_LANES
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
      list.push_back(&tile_forces_avx512);
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) list.push_back(&tile_forces_avx2);
#endif
    list.push_back(&tile_forces_baseline);
    prefer_named(list);
    return list;
  }();
  return available;
}

}  // namespace tread
