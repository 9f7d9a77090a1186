#pragma once
// The two loops that say what the machine can do, compiled once per instruction set as the tile loop is.

#include <cstdint>
#include <string_view>

namespace tread {

struct LimitLoops {
  const char* name;  ///< of the instruction set
  /// a[i] = b[i] + factor c[i]. [McCalpin, STREAM triad]
  void (*triad)(double* a, const double* b, const double* c, double factor, std::int64_t n);
  /// `rounds` times a x + b on enough registers to hide the latency; returns what keeps it from being
  /// optimised away.
  double (*multiply_add_double)(std::int64_t rounds);
  double (*multiply_add_float)(std::int64_t rounds);
  int flops_per_round_double;
  int flops_per_round_float;
};

/// Of an instruction set that this processor has, as BasicInternalForce::instruction_sets() names it.
const LimitLoops& limit_loops(std::string_view instruction_set);

}  // namespace tread
