#pragma once
// The kernels of a time step on made-up data, each ready for single calls.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "drivers/bench/limits.hpp"
#include "drivers/bench/measurement.hpp"
#include "drivers/bench/work.hpp"

namespace tread {

/// A kernel with its data.
struct PreparedKernel {
  TimedCall timed;
  std::int64_t units = 0;        ///< number of units that a call works on
  Work work{};                   ///< work per unit; zeros: not counted
  std::int64_t working_set = 0;  ///< bytes that a call touches
  /// Instruction sets to choose from, and their choice. Without a choice: the one that the kernel runs with.
  std::vector<const char*> lanes = {"baseline"};
  std::function<void(const char*)> use_lanes{};
};

struct KernelCase {
  std::string kernel;
  std::string path;
  std::string precision = "double";
  std::string unit;  ///< unit: "element", "node", ...
  /// Prepares the kernel on a mesh of about so many elements.
  std::function<PreparedKernel(std::int64_t elements)> prepare;
};

/// Harness cost, internal force, update and ties; then contact and the surface's fields.
std::vector<KernelCase> kernel_cases();
void add_contact_cases(std::vector<KernelCase>& cases);

}  // namespace tread
