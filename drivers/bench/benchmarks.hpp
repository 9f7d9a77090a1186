#pragma once
// `tread bench`: the program's speed beside the machine's limits. [docs/records/performance.md]

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "drivers/bench/measurement.hpp"
#include "drivers/process/machine.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// Options of all measuring commands.
struct BenchOptions {
  ThreadOptions threads;
  std::string device;  ///< takes the steps; empty: the processor [choose_device]
  MeasurementPlan plan;
  bool json = false;  ///< true for one object a line on stdout in place of a table
};

struct BenchKernelsOptions : BenchOptions {
  std::vector<std::string> kernels;  ///< names of kernels; empty: all
  std::vector<std::int64_t> elements = {10000, 100000, 1460000};
  std::vector<std::string> lanes;  ///< instruction sets; empty: all available ones
  std::vector<std::string> precisions;
};

/// Measures every kernel on made-up data, after the limits of the machine; or those of the chosen device.
/// Throws InputError for an unknown name.
void bench_kernels(const BenchKernelsOptions& options);

struct BenchScalingOptions : BenchOptions {
  std::int64_t elements = 400000;  ///< size of the made-up mesh; per thread if it grows with the threads
};

/// Measures one to all threads with every backend. The work is whole steps of a scene, or internal force and
/// update of a made-up rail. The rail has one size, or a size that grows with the threads. Each row has new
/// fields, touched first by its threads; mesh and masses of a scene are made once.
void bench_scaling(const BenchScalingOptions& options);
void bench_scaling(const ResolvedScene& scene, const BenchScalingOptions& options);

struct BenchHotspotsOptions : BenchOptions {
  std::int64_t steps = 500;  ///< steps of a run, or fewer if the motion ends before the last run does
  std::vector<int> cores;    ///< numbers of cores for which the step's time is projected
  bool quiet = false;        ///< true for no progress on stderr
};

/// Measures every phase of whole steps of a scene: time, work, limit and balance of the threads, in the run
/// whose steps take the median time. InputError for a projection of steps on a device.
void bench_hotspots(const ResolvedScene& scene, const BenchHotspotsOptions& options);

struct BenchRanksOptions : BenchOptions {
  int ranks = 64;          ///< that the scene is cut for
  std::vector<int> parts;  ///< numbers of ranks whose part is timed alone; their mean predicts all times
};

/// Cuts a scene for ranks that are not there: elements, nodes, memory and messages of each in a step; and
/// times the parts of some of them, without the contact. Nothing is preloaded.
void bench_ranks(const ResolvedScene& scene, const BenchRanksOptions& options);

/// Measure by which two files of `bench kernels --json` are compared.
enum class BenchMeasure {
  rate,               ///< element-steps a second: for two builds on one machine
  fraction_of_limit,  ///< fraction of the machine's limit in the same run: for two machines
  instructions,       ///< instructions per unit, one thread: busy machines, equal instruction set and
                      ///< compiler
};

/// Compares two files of `bench kernels --json`. Returns true if no row of `after` is slower than its
/// counterpart in `before` by more than the larger of both spreads, 10 % at most, and all of `before` have
/// one; `common`: rows without a counterpart do not count. InputError where a file is no such file or no row
/// has a counterpart.
bool compare_benchmarks(const std::filesystem::path& before, const std::filesystem::path& after,
                        BenchMeasure measure, bool common);

}  // namespace tread
