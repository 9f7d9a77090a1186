#pragma once
// What the machine can do, measured by the program itself: bandwidth by the size of the data, and the peak of
// multiply-adds.

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>

#include "drivers/bench/measurement.hpp"

namespace tread {

/// Shortest time that a machine allows for a piece of work.
struct Limit {
  double seconds = 0;     ///< 0: nothing is counted [s]
  bool by_memory = true;  ///< or by arithmetic
  const char* name() const { return by_memory ? "memory" : "arithmetic"; }
};

/// All of a step.
struct Load {
  double flops = 0;
  double bytes = 0;              ///< moved
  std::int64_t working_set = 0;  ///< bytes that are held
};

/// For the threads and the backend that are set when it is asked; each value is measured once. What the
/// machine can do is what it does in the fastest run: `seconds` is that of it.
class Limits {
 public:
  /// At least fifteen runs: everything else is judged by these.
  explicit Limits(const MeasurementPlan& plan) : plan_{std::max(15, plan.repetitions), plan.run_seconds} {}

  /// STREAM triads on three arrays beyond every cache, by the widest instruction set: the time of one triad,
  /// which moves kTriadBytes. [s]
  Measurement stream();
  /// The same on arrays of so many bytes in all, rounded up to a power of two, at most those of stream(). [s]
  Measurement triad(std::int64_t working_set);

  /// Time of one addition or multiplication when all threads do multiply-adds in registers. [s]
  Measurement operation(bool in_double, std::string_view instruction_set);

  /// The slower of memory and arithmetic.
  Limit of(const Load& load, bool in_double, std::string_view instruction_set);

 private:
  using Key = std::tuple<std::int64_t, std::string, int, std::string>;

  MeasurementPlan plan_;
  std::map<Key, Measurement> known_;  ///< by bytes of a triad, or by precision if negative
};

/// By the convention of STREAM: two values read, one written. [B]
inline constexpr double kTriadBytes = 3 * sizeof(double);
/// What moves: caches fetch a line before it is written, as Work counts it. [B]
inline constexpr double kTriadTraffic = 4 * sizeof(double);

}  // namespace tread
