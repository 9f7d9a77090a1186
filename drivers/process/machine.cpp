#include "drivers/process/machine.hpp"

#include <fmt/core.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <thread>
#include <utility>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "core/parallel/ranks.hpp"
#include "drivers/process/group_limits.hpp"
#include "drivers/process/standard_files.hpp"

namespace tread {

std::vector<int> allowed_cores() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  ::sched_getaffinity(0, sizeof(allowed), &allowed);
  std::vector<int> cores;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(core, &allowed)) cores.push_back(core);
  return cores;
}

int machine_cores() {
  const std::vector<int> cores = allowed_cores();
  const int allowed = cores.empty() ? std::max(1, static_cast<int>(std::thread::hardware_concurrency()))
                                    : static_cast<int>(cores.size());
  return std::min(allowed, group_limits().cores);
}

std::int64_t machine_memory() {
  const std::int64_t all = std::int64_t{::sysconf(_SC_PHYS_PAGES)} * ::sysconf(_SC_PAGE_SIZE);
  return std::min(all, group_limits().memory);
}

void use_threads(const ThreadOptions& options) {
  constexpr int kMostThreads = 4096;  // more than any machine has cores
  if (options.number > kMostThreads)
    throw InputError(fmt::format("-t {}: at most {} threads are possible; this machine has {} cores",
                                 options.number, kMostThreads, machine_cores()));
  if (options.backend.empty())
    backend();  // refuses what the environment names before work begins
  else
    set_backend(options.backend);
  const std::shared_ptr<Ranks> ranks = chosen_ranks();
  const int cores = ranks ? std::max(1, machine_cores() / ranks->on_cores()) : machine_cores();
  if (options.number > cores && (!ranks || ranks->rank() == 0))
    print_error(fmt::format("tread: warning: {} threads on {} cores wait for one another; -t {} is faster\n",
                            options.number, cores, cores));
  set_threads(options.number > 0 ? options.number : cores);
  if (!options.bind) return;
  std::vector<int> own = allowed_cores();
  const int taken = ranks ? ranks->place_on_cores() * threads() : 0;  // by lower ranks
  if (!own.empty()) std::rotate(own.begin(), own.begin() + taken % std::ssize(own), own.end());
  bind_threads(std::move(own));
}

double processor_seconds() {
  timespec used{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

void give_back_large_arrays() {
#ifdef __GLIBC__
  // The GNU library raises this threshold to the size of the largest freed array, up to 32 MiB.
  constexpr int kLarge = 1 << 20;  // [B]
  ::mallopt(M_MMAP_THRESHOLD, kLarge);
  // With the former threshold stated, the one for the end of the heap stays at 128 KiB: vectors that a loop
  // makes and drops would be taken from the machine and given back each time, page by page.
  constexpr int kKept = 64 << 20;  // [B]
  ::mallopt(M_TRIM_THRESHOLD, kKept);
#endif
}

std::int64_t peak_memory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<std::int64_t>(usage.ru_maxrss);
}

}  // namespace tread
