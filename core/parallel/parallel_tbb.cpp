#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <memory>

#include "core/parallel/parallel_backend.hpp"

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#include <sanitizer/tsan_interface.h>
#define TREAD_THREAD_SANITIZER
#endif
#endif

namespace tread {

namespace {

// ThreadSanitizer does not see into the library. These marks order a call's begin before its tasks and their
// ends before its return. Tasks of one call stay unordered among themselves.
#ifdef TREAD_THREAD_SANITIZER
void release(char& event) {
  __tsan_release(&event);
}
void acquire(char& event) {
  __tsan_acquire(&event);
}
#else
void release(char& /*event*/) {}
void acquire(char& /*event*/) {}
#endif

/// A team of the requested number of threads, even beyond the machine's cores.
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
  static char begun, ended;
  release(begun);
  std::atomic<std::int64_t> next = 0;
  team->arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::int64_t>(0, std::min<std::int64_t>(threads, count), 1),
        [&](const tbb::blocked_range<std::int64_t>& /*threads*/) {
          acquire(begun);
          for (std::int64_t i; (i = next.fetch_add(1)) < count;)
            task(i, tbb::this_task_arena::current_thread_index());
          release(ended);
        },
        tbb::simple_partitioner());
  });
  acquire(ended);
}

}  // namespace

const ParallelBackend tbb_backend = {"tbb", run};

}  // namespace tread
