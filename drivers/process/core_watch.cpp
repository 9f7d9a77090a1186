#include "drivers/process/core_watch.hpp"

#include <fmt/core.h>

#include "core/parallel/parallel.hpp"

namespace tread {

double CoreWatch::share() const {
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
  return (processor_seconds() - processor_) / (passed.count() * threads());
}

std::string busy_cores_text(double share) {
  constexpr double kBusyShare = 0.6;  ///< share of the time that threads work if nothing else runs, at least
  if (share >= kBusyShare) return "";
  return fmt::format("{} work{} {:.0f} % of the time: other programs use the cores",
                     threads() == 1 ? "the thread" : fmt::format("{} threads", threads()),
                     threads() == 1 ? "s" : "", 100 * share);
}

}  // namespace tread
