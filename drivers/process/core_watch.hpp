#pragma once
// Share of the time in which the cores work for this process.

#include <chrono>
#include <string>

#include "drivers/process/machine.hpp"

namespace tread {

/// Watches the processor time of this process from its construction on.
class CoreWatch {
 public:
  /// Processor time over wall clock and threads() [-]; 1: no thread sleeps or waits for a core.
  double share() const;

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double processor_ = processor_seconds();  ///< [s]
};

/// "2 threads work 40 % of the time: other programs use the cores" for a share() of threads that have work
/// all the time; "" where they work enough.
std::string busy_cores_text(double share);

}  // namespace tread
