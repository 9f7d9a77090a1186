#pragma once
// Cycles, instructions and cache misses of all threads, if the system lets a program count them.

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "drivers/engine/phase_clock.hpp"

namespace tread {

class HardwareCounters {
 public:
  /// Counts in this thread and in threads that it starts later. Construct it before the first parallel call.
  HardwareCounters();
  ~HardwareCounters();
  HardwareCounters(const HardwareCounters&) = delete;
  HardwareCounters& operator=(const HardwareCounters&) = delete;

  bool available() const { return reason_.empty(); }
  const std::string& reason() const { return reason_; }  ///< reason why counters are not available
  CounterValues read() const;

 private:
  std::array<int, 3> files_ = {-1, -1, -1};
  std::string reason_;
};

/// Instructions of a call; 0 without a counter. Under callgrind, perf/count_instructions.sh
/// counts in this function alone: it has a name without arguments and a body of its own for that.
extern "C" std::int64_t tread_counted_call(const HardwareCounters& counters,
                                           const std::function<void()>& call);

}  // namespace tread
