#pragma once
// Limits of the machine, measured by the program itself: bandwidth by the size of the data, and the peak of
// multiply-adds.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <tuple>

#include "drivers/bench/measurement.hpp"

namespace tread {

/// Shortest time that a machine allows for a piece of work.
struct Limit {
  double seconds = 0;     ///< shortest time; 0: nothing is counted [s]
  bool by_memory = true;  ///< true: memory binds; false: arithmetic
  const char* name() const { return by_memory ? "memory" : "arithmetic"; }
};

/// Work of a whole step.
struct Load {
  double flops = 0;
  double bytes = 0;              ///< bytes moved
  std::int64_t working_set = 0;  ///< bytes held
};

/// Limits of the machine for the threads set at the call. Each value is measured once. The limit is the
/// fastest run: `seconds` is the time of that run.
class Limits {
 public:
  /// Takes at least fifteen runs, because all other rows are judged by these.
  explicit Limits(const MeasurementPlan& plan) : plan_{std::max(15, plan.repetitions), plan.run_seconds} {}

  /// By the backend set at the call: time of one STREAM triad, which moves kTriadBytes [s]: on three arrays
  /// beyond every cache, by the widest instruction set.
  Measurement stream();
  /// By the same: time of one triad on arrays of `working_set` bytes in all, rounded up to a power of two, at
  /// most those of stream() [s].
  Measurement triad(std::int64_t working_set);

  /// By the same: time of one addition or multiplication when all threads do multiply-adds in registers [s].
  Measurement operation(bool in_double, std::string_view instruction_set);

  /// The longer of the times that memory and arithmetic need, each by its fastest backend.
  Limit of(const Load& load, bool in_double, std::string_view instruction_set);

  /// Warns on stderr where the loops of the limits, which have work for all threads, did not get the cores.
  void warn_of_busy_cores() const;

 private:
  void note_share(double share);
  double fastest(const std::function<Measurement()>& of_backend) const;

  using Key = std::tuple<std::int64_t, std::string, int, std::string>;

  MeasurementPlan plan_;
  std::map<Key, Measurement> known_;  ///< measurements by bytes of a triad, or by precision if negative
  double least_share_ = 1;            ///< Measurement::processor_share of long loops among these [-]
  std::string busy_;                  ///< busy_cores_text() of it
};

/// Bytes of a triad by the convention of STREAM: two values read, one written [B].
inline constexpr double kTriadBytes = 3 * sizeof(double);
/// Bytes that a triad moves: caches fetch a line before it is written, as Work counts it [B].
inline constexpr double kTriadTraffic = 4 * sizeof(double);

}  // namespace tread
