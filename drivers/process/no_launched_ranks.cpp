// A build without a library of messages.

#include "drivers/process/launched_ranks.hpp"
#include "drivers/process/launcher.hpp"

namespace tread {

std::shared_ptr<Ranks> launched_ranks() {
  if (launched_count() <= 1) return nullptr;
  refuse_launch(
      "this program was built without MPI, and each would do the whole work; start it alone, or build it "
      "with -D TREAD_MPI=ON");
}

std::string rank_library() {
  return "";
}

}  // namespace tread
