#pragma once
// `tread bench`: how fast the program is beside what the machine can do. [docs/performance.md]

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "drivers/bench/measurement.hpp"
#include "drivers/process/machine.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// Options that all measuring commands have.
struct BenchOptions {
  ThreadOptions threads;
  MeasurementPlan plan;
  bool json = false;  ///< one object a line on stdout instead of a table
};

struct BenchKernelsOptions : BenchOptions {
  std::vector<std::string> kernels;  ///< names; empty: all
  std::vector<std::int64_t> elements = {10000, 100000, 1460000};
  std::vector<std::string> lanes;  ///< instruction sets; empty: all that are there
  std::vector<std::string> precisions;
};

/// Every kernel on made-up data, after the limits of the machine. InputError for an unknown name.
void bench_kernels(const BenchKernelsOptions& options);

struct BenchScalingOptions : BenchOptions {
  std::int64_t elements = 400000;  ///< of the made-up mesh; per thread when that grows with the threads
};

/// One to all threads by every backend: internal force and update of a made-up rail, of one size and of one
/// that grows with the threads; or whole steps of a scene.
void bench_scaling(const BenchScalingOptions& options);
void bench_scaling(const ResolvedScene& scene, const BenchScalingOptions& options);

struct BenchHotspotsOptions : BenchOptions {
  std::int64_t steps = 500;  ///< of a run, or fewer where the motion ends before the last one does
  bool quiet = false;        ///< no progress on stderr
};

/// Every phase of whole steps of a scene: time, work, limit, balance of the threads, in the run whose steps
/// take the median time.
void bench_hotspots(const ResolvedScene& scene, const BenchHotspotsOptions& options);

/// What two files of `bench kernels --json` are compared by.
enum class BenchMeasure {
  rate,               ///< element-steps a second: two builds on one machine
  fraction_of_limit,  ///< of what the machine bore in the same run: two machines
  instructions,       ///< a unit, one thread: busy machines, the same instruction set and compiler
};

/// Compares two files of `bench kernels --json`. Returns whether no row of `after` is slower than its
/// counterpart in `before` by more than the larger of both spreads. InputError where a file is no such file
/// or no row has a counterpart.
bool compare_benchmarks(const std::filesystem::path& before, const std::filesystem::path& after,
                        BenchMeasure measure);

}  // namespace tread
