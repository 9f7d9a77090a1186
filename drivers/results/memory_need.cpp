#include "drivers/results/memory_need.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/error.hpp"
#include "core/parallel/ranks.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/results/inventory.hpp"
#include "io/report/plain_text.hpp"

namespace tread {

namespace {

/// Rank 0 alone solves the preload. Then each rank makes the mesh with the masses of all nodes; ranks share
/// displacements and velocities, in single precision at least.
std::int64_t needed_for_a_run(const MeshCount& count) {
  const std::shared_ptr<Ranks> ranks = chosen_ranks();
  if (!ranks) return least_bytes(count);
  constexpr std::int64_t kMotion = 2 * 3 * sizeof(float);
  const std::int64_t rolling =
      ranks->on_host() * (mass_bytes(count) + kMotion * count.nodes / ranks->count());
  return ranks->rank() == 0 ? std::max(least_bytes(count), rolling) : rolling;
}

void require_bytes(std::int64_t needed, const MeshCount& count, const MeshSizes& sizes) {
  const std::int64_t there = machine_memory();
  if (needed <= there) return;
  const std::shared_ptr<Ranks> ranks = chosen_ranks();
  const bool of_ranks = ranks && needed != least_bytes(count);
  throw ResourceError(
      fmt::format("the scene has {} elements, which need at least {} of memory{}; this machine has {}; raise "
                  "scene.element_size ({:.3g} mm) or shorten solution_zone.length{}",
                  grouped(count.elements), bytes_text(needed),
                  of_ranks ? fmt::format(" on {} ranks", ranks->on_host()) : "", bytes_text(there),
                  1e3 * sizes.contact, of_ranks ? ", or start fewer ranks on a machine" : ""));
}

}  // namespace

std::int64_t least_bytes(const MeshCount& count) {
  constexpr double kVectors =
      1 + kSolverVectors + kIterationVectors;  // the displacement and the static solver's
  return static_cast<std::int64_t>(kVectors * 3 * sizeof(double) * static_cast<double>(count.nodes));
}

std::int64_t mass_bytes(const MeshCount& count) {
  return static_cast<std::int64_t>(sizeof(double)) * count.nodes;
}

void require_memory(const MeshCount& count, const MeshSizes& sizes) {
  require_bytes(needed_for_a_run(count), count, sizes);
}

void require_memory_of_mesh(const MeshCount& count, const MeshSizes& sizes) {
  require_bytes(mass_bytes(count), count, sizes);
}

}  // namespace tread
