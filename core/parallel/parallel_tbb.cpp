#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

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

void run(int threads, FunctionRef<void(int)> work) {
  static std::unique_ptr<Team> team;
  if (!team || team->threads != threads) {
    team.reset();
    team = std::make_unique<Team>(threads);
  }
  static char begun, ended;
  release(begun);
  team->arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, threads, 1),
        [&](const tbb::blocked_range<int>& /*one*/) {
          acquire(begun);
          work(tbb::this_task_arena::current_thread_index());
          release(ended);
        },
        tbb::simple_partitioner());
  });
  acquire(ended);
}

}  // namespace

const ParallelBackend tbb_backend = {"tbb", run};

}  // namespace tread
