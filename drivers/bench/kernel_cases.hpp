#pragma once
// The kernels of a time step on made-up data, each ready to be called by itself.

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
  std::int64_t units = 0;        ///< worked on by a call
  Work work{};                   ///< by unit; zeros: not counted
  std::int64_t working_set = 0;  ///< bytes that a call touches
  /// Instruction sets to choose from and the choice among them; without the choice, the one that it runs
  /// with.
  std::vector<const char*> lanes = {"baseline"};
  std::function<void(const char*)> use_lanes{};
};

struct KernelCase {
  std::string kernel;
  std::string path;
  std::string precision = "double";
  std::string unit;  ///< "element", "node", ...
  /// On a mesh of about so many elements.
  std::function<PreparedKernel(std::int64_t elements)> prepare;
};

/// What the harness costs, internal force, update and ties; then contact and the surface's fields.
std::vector<KernelCase> kernel_cases();
void add_contact_cases(std::vector<KernelCase>& cases);

}  // namespace tread
