#pragma once
// The two loops that measure the machine's limits, compiled once per instruction set as the tile loop is.

#include <cstdint>
#include <string_view>

namespace tread {

struct LimitLoops {
  const char* name;  ///< name of the instruction set
  /// Computes a[i] = b[i] + factor c[i]. [McCalpin, STREAM triad]
  void (*triad)(double* a, const double* b, const double* c, double factor, std::int64_t n);
  /// Computes a x + b `rounds` times on enough registers to hide the latency. Returns a value that keeps the
  /// loop from being optimised away.
  double (*multiply_add_double)(std::int64_t rounds);
  double (*multiply_add_float)(std::int64_t rounds);
  int flops_per_round_double;
  int flops_per_round_float;
};

/// Loops of an instruction set that this processor has, by its name in
/// BasicInternalForce::instruction_sets().
const LimitLoops& limit_loops(std::string_view instruction_set);

}  // namespace tread
