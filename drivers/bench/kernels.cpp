#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/bench/bench_row.hpp"
#include "drivers/bench/benchmarks.hpp"
#include "drivers/bench/device_kernels.hpp"
#include "drivers/bench/hardware_counters.hpp"
#include "drivers/bench/kernel_cases.hpp"
#include "io/report/plain_text.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

bool chosen(const std::vector<std::string>& names, std::string_view name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

/// Throws InputError unless every name is known.
void check_names(const char* option, const std::vector<std::string>& names,
                 const std::vector<std::string>& known) {
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::string list;
    for (const std::string& k : known) list += (list.empty() ? "" : ", ") + k;
    throw InputError(fmt::format("{} {}: known are {}", option, name, list));
  }
}

void check_precisions(const BenchKernelsOptions& options) {
  check_names("--precision", options.precisions, {"double", "mixed", "single"});
}

void check_options(const BenchKernelsOptions& options, const std::vector<KernelCase>& cases) {
  std::vector<std::string> kernels;
  for (const KernelCase& c : cases)
    if (std::find(kernels.begin(), kernels.end(), c.kernel) == kernels.end()) kernels.push_back(c.kernel);
  kernels.insert(kernels.begin(), {"triad", "multiply_add"});
  check_names("--kernel", options.kernels, kernels);
  const auto sets = InternalForce::instruction_sets();
  check_names("--lanes", options.lanes, {sets.begin(), sets.end()});
  check_precisions(options);
}

/// Prints rows as they come, or all of them as a table at the end.
class Rows {
 public:
  explicit Rows(bool json) : json_(json) {}

  void add(BenchRow row) {
    if (json_) {
      fmt::print("{}", json_line(row));
      std::fflush(stdout);
    }
    rows_.push_back(std::move(row));
  }
  void finish() const {
    if (!json_) fmt::print("{}", plain_text(bench_table(rows_)));
  }

 private:
  bool json_;
  std::vector<BenchRow> rows_;
};

BenchKey key_of(const char* kernel, const char* path, const char* precision, const char* lanes) {
  return {kernel, path, precision, std::string(backend()), lanes, threads(), 0};
}

/// Rows of the limits themselves: bandwidth once, the peak of every instruction set.
void add_limits(const BenchKernelsOptions& options, Limits& limits, Rows& rows) {
  const auto add = [&](BenchKey key, const char* unit, Measurement of_unit, Work work) {
    key.elements = 1;
    rows.add({std::move(key), unit, of_unit, work, {of_unit.seconds, work.bytes > 0}});
  };
  const auto sets = InternalForce::instruction_sets();
  if (chosen(options.kernels, "triad") && chosen(options.precisions, "double"))
    add(key_of("triad", "beyond the caches", "double", sets.front()), "triad", limits.stream(),
        {2, kTriadBytes});
  if (!chosen(options.kernels, "multiply_add")) return;
  for (const char* lanes : sets)
    for (const bool in_double : {true, false}) {
      const char* precision = in_double ? "double" : "single";
      if (chosen(options.lanes, lanes) && chosen(options.precisions, precision))
        add(key_of("multiply_add", "registers", precision, lanes), "operation",
            limits.operation(in_double, lanes), {1, 0});
    }
}

/// Counts the instructions of a row. Several threads are not counted, because their waiting would count.
void count_instructions(const TimedCall& timed, const HardwareCounters& counters, BenchRow& row) {
  if (threads() > 1) return;
  // Calls of contact_search differ, so a small kernel takes the mean of many. No counter chooses their
  // number: callgrind counts the same calls.
  constexpr std::int64_t kEnough = 200'000;  // units
  row.counted_calls = static_cast<int>(std::clamp<std::int64_t>(kEnough / row.key.elements, 2, 60));
  std::int64_t sum = 0;
  for (int i = 0; i < row.counted_calls; ++i) {
    if (timed.reset) timed.reset();
    sum += tread_counted_call(counters, timed.call);
  }
  row.instructions = static_cast<double>(sum) /
                     (static_cast<double>(row.counted_calls) * static_cast<double>(row.key.elements));
}

void add_kernel(const BenchKernelsOptions& options, const KernelCase& measured, const PreparedKernel& kernel,
                const HardwareCounters& counters, Limits& limits, Rows& rows) {
  for (const char* lanes : kernel.lanes) {
    if (kernel.use_lanes) {
      if (!chosen(options.lanes, lanes)) continue;
      kernel.use_lanes(lanes);
    }
    BenchRow row{key_of(measured.kernel.c_str(), measured.path.c_str(), measured.precision.c_str(), lanes),
                 measured.unit,
                 measure(kernel.timed, options.plan),
                 kernel.work,
                 {}};
    row.key.elements = kernel.units;
    const auto units = static_cast<double>(kernel.units);
    row.limit = limits.of({kernel.work.flops * units, kernel.work.bytes * units, kernel.working_set},
                          measured.precision == "double", lanes);
    count_instructions(kernel.timed, counters, row);
    rows.add(std::move(row));
  }
}

/// Backends to compare: one thread needs one only.
std::vector<std::string_view> backends_to_measure(const BenchOptions& options) {
  if (threads() == 1 || !options.threads.backend.empty()) return {backend()};
  return backends();
}

}  // namespace

void bench_kernels(const BenchKernelsOptions& options) {
  const HardwareCounters counters;
  use_threads(options.threads);
  choose_device(options.device);
  Rows rows(options.json);
  if (const std::shared_ptr<Device> device = chosen_device()) {
    check_precisions(options);
    if (!options.kernels.empty() || !options.lanes.empty())
      throw InputError("--device: all kernels of a device are measured; leave out --kernel and --lanes");
    for (BenchRow& row : measure_device(*device, options)) rows.add(std::move(row));
    rows.finish();
    return;
  }
  const std::vector<KernelCase> cases = kernel_cases();
  check_options(options, cases);
  const auto teams = backends_to_measure(options);
  Limits limits(options.plan);
  for (const std::string_view team : teams) {
    set_backend(team);
    add_limits(options, limits, rows);
  }
  for (const KernelCase& measured : cases) {
    if (!chosen(options.kernels, measured.kernel) || !chosen(options.precisions, measured.precision))
      continue;
    for (const std::int64_t elements : options.elements) {
      const PreparedKernel kernel = measured.prepare(elements);
      for (const std::string_view team : teams) {
        set_backend(team);
        add_kernel(options, measured, kernel, counters, limits, rows);
      }
    }
  }
  rows.finish();
  limits.warn_of_busy_cores();
}

}  // namespace tread
