#include "drivers/results/memory_need.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/parallel/ranks.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/results/inventory.hpp"
#include "io/report/plain_text.hpp"

namespace tread {

std::int64_t least_bytes(const MeshCount& count) {
  constexpr double kVectors =
      1 + kSolverVectors + kIterationVectors;  // the displacement and the static solver's
  return static_cast<std::int64_t>(kVectors * 3 * sizeof(double) * static_cast<double>(count.nodes));
}

void require_memory(const MeshCount& count, const MeshSizes& sizes) {
  const std::int64_t needed = least_bytes(count);
  const std::shared_ptr<Ranks> ranks = chosen_ranks();
  const std::int64_t there = machine_memory() / (ranks ? ranks->on_host() : 1);
  if (needed <= there) return;
  throw ResourceError(
      fmt::format("the scene has {} elements, which need at least {} of memory; this machine has {}{}; raise "
                  "scene.element_size ({:.3g} mm) or shorten solution_zone.length",
                  grouped(count.elements), bytes_text(needed), bytes_text(there),
                  ranks ? " for each rank" : "", 1e3 * sizes.contact));
}

}  // namespace tread
