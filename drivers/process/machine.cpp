#include "drivers/process/machine.hpp"

#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <system_error>
#include <thread>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"

namespace tread {

void use_threads(const ThreadOptions& options) {
  if (!options.backend.empty()) set_backend(options.backend);
  set_threads(options.number > 0 ? options.number
                                 : std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
}

void give_back_large_arrays() {
#ifdef __GLIBC__
  // The GNU library raises this threshold to the size of the largest freed array, up to 32 MiB.
  constexpr int kLarge = 1 << 20;  // [B]
  ::mallopt(M_MMAP_THRESHOLD, kLarge);
#endif
}

std::int64_t peak_memory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<std::int64_t>(usage.ru_maxrss);
}

void make_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error || !std::filesystem::is_directory(directory))
    throw ResourceError(fmt::format("cannot create the output directory '{}': {}; choose another with -o",
                                    directory.string(),
                                    error ? error.message() : "a file of that name is there"));
}

}  // namespace tread
