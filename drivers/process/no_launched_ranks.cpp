// A build without a library of messages.

#include <fmt/core.h>

#include <chrono>
#include <thread>

#include "core/error.hpp"
#include "drivers/process/launched_ranks.hpp"
#include "drivers/process/launcher.hpp"

namespace tread {

std::shared_ptr<Ranks> launched_ranks() {
  const int count = launched_count();
  if (count <= 1) return nullptr;
  // One of them speaks; its end ends the others.
  if (launcher_number({"OMPI_COMM_WORLD_RANK", "PMI_RANK"}, 0) > 0)
    std::this_thread::sleep_for(std::chrono::seconds(2));
  throw InputError(
      fmt::format("{} processes were started together, but this program was built without MPI and would do "
                  "the same {} times; start it alone, or build it with -D TREAD_MPI=ON",
                  count, count));
}

std::string rank_library() {
  return "";
}

}  // namespace tread
