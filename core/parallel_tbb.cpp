#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <memory>

#include "core/parallel_backend.hpp"

namespace tread {

namespace {

/// As many threads as asked for, even beyond the machine's cores.
struct Team {
  explicit Team(int size)
      : threads(size),
        limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(size)),
        arena(size) {}

  int threads;
  tbb::global_control limit;
  tbb::task_arena arena;
};

void run(std::int64_t count, int threads, FunctionRef<void(std::int64_t, int)> task) {
  static std::unique_ptr<Team> team;
  if (!team || team->threads != threads) {
    team.reset();
    team = std::make_unique<Team>(threads);
  }
  team->arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::int64_t>(0, count, 1),
        [&](const tbb::blocked_range<std::int64_t>& range) {
          for (std::int64_t i = range.begin(); i < range.end(); ++i)
            task(i, tbb::this_task_arena::current_thread_index());
        },
        tbb::simple_partitioner());
  });
}

}  // namespace

const ParallelBackend tbb_backend = {"tbb", run};

}  // namespace tread
