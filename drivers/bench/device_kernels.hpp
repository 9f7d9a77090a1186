#pragma once
// The kernels of a device on made-up data, beside the bandwidth of its memory. [docs/records/device.md]

#include <vector>

#include "drivers/bench/bench_row.hpp"
#include "drivers/bench/benchmarks.hpp"
#include "kernels/device/device.hpp"

namespace tread {

/// Time in which the device's triad moves a byte [s].
double byte_seconds(Device& device, const MeasurementPlan& plan);

/// Triad, copies to and from the device, the shortest launch, and the march over blocks of all kinds. The
/// limit of a march is the time in which the triad moves its bytes.
std::vector<BenchRow> measure_device(Device& device, const BenchKernelsOptions& options);

}  // namespace tread
