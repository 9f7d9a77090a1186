#include "drivers/bench/limits.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "core/aligned.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/bench/lanes/limit_loops.hpp"
#include "drivers/process/core_watch.hpp"
#include "drivers/process/standard_files.hpp"
#include "kernels/blocks/internal_force.hpp"

namespace tread {

namespace {

/// Bytes of three arrays, each four times the last cache, as STREAM asks [B].
std::int64_t beyond_caches() {
  constexpr std::int64_t kAssumed = 32 << 20;  ///< cache size if the system does not state it
  const std::int64_t cache = std::max<std::int64_t>(::sysconf(_SC_LEVEL3_CACHE_SIZE), kAssumed);
  return 3 * 4 * cache;
}

/// Measurement per unit; `seconds` becomes that of the fastest run.
Measurement per_unit(Measurement of_call, double units) {
  of_call.fastest /= units;
  of_call.seconds = of_call.fastest;
  return of_call;
}

Measurement measure_triad(std::int64_t bytes, const LimitLoops& loops, const MeasurementPlan& plan) {
  const auto n = static_cast<std::int64_t>(static_cast<double>(bytes) / kTriadBytes);
  AlignedVector<double> a(static_cast<std::size_t>(n), 1.0);
  const AlignedVector<double> b(a.size(), 2.0);
  const AlignedVector<double> c(a.size(), 3.0);
  const auto triad = [&] {
    parallel_ranges(n, [&](std::int64_t first, std::int64_t last) {
      loops.triad(a.data() + first, b.data() + first, c.data() + first, 3.0, last - first);
    });
  };
  return per_unit(measure({triad}, plan), static_cast<double>(n));
}

Measurement measure_operation(bool in_double, const LimitLoops& loops, const MeasurementPlan& plan) {
  constexpr std::int64_t kRounds = 4000;  ///< about a millisecond of all items
  const std::int64_t items = 64 * std::int64_t{threads()};
  const auto loop = in_double ? loops.multiply_add_double : loops.multiply_add_float;
  const auto work = [&] {
    parallel_ranges(items, [&](std::int64_t first, std::int64_t last) {
      volatile double sink = loop(kRounds * (last - first));
      (void)sink;
    });
  };
  const double flops = static_cast<double>(items * kRounds) *
                       (in_double ? loops.flops_per_round_double : loops.flops_per_round_float);
  return per_unit(measure({work}, plan), flops);
}

}  // namespace

Measurement Limits::stream() {
  return triad(beyond_caches());
}

Measurement Limits::triad(std::int64_t working_set) {
  constexpr std::uint64_t kSmallest = 1 << 16;
  const auto rounded = std::bit_ceil(std::max(static_cast<std::uint64_t>(working_set), kSmallest));
  const std::int64_t bytes = std::min(static_cast<std::int64_t>(rounded), beyond_caches());
  const char* const widest = InternalForce::instruction_sets().front();
  const auto [at, added] = known_.try_emplace({bytes, widest, threads(), std::string(backend())});
  if (!added) return at->second;
  at->second = measure_triad(bytes, limit_loops(widest), plan_);
  constexpr std::int64_t kLongLoop = 16 << 20;  ///< beside it, the time in which a thread wakes is short [B]
  if (bytes >= kLongLoop) note_share(at->second.processor_share);
  return at->second;
}

Measurement Limits::operation(bool in_double, std::string_view instruction_set) {
  const auto [at, added] = known_.try_emplace(
      {in_double ? -2 : -1, std::string(instruction_set), threads(), std::string(backend())});
  if (!added) return at->second;
  at->second = measure_operation(in_double, limit_loops(instruction_set), plan_);
  note_share(at->second.processor_share);
  return at->second;
}

Limit Limits::of(const Load& load, bool in_double, std::string_view instruction_set) {
  if (load.bytes <= 0 && load.flops <= 0) return {};
  const double memory = load.bytes / kTriadTraffic * fastest([&] { return triad(load.working_set); });
  const double arithmetic = load.flops * fastest([&] { return operation(in_double, instruction_set); });
  return {std::max(memory, arithmetic), memory >= arithmetic};
}

void Limits::warn_of_busy_cores() const {
  if (!busy_.empty())
    print_error(fmt::format(
        "tread: warning: {} while the limits were measured: these rates, limits and efficiencies are not the "
        "machine's; measure again where nothing else runs\n",
        busy_));
}

void Limits::note_share(double share) {
  if (share >= least_share_) return;
  least_share_ = share;
  busy_ = busy_cores_text(share);
}

/// Seconds of the backend that is the fastest. One thread needs no backend.
double Limits::fastest(const std::function<Measurement()>& of_backend) const {
  if (threads() == 1) return of_backend().seconds;
  const std::string_view chosen = backend();
  double least = std::numeric_limits<double>::infinity();
  for (const std::string_view name : backends()) {
    set_backend(name);
    least = std::min(least, of_backend().seconds);
  }
  set_backend(chosen);
  return least;
}

}  // namespace tread
