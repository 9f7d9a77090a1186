#pragma once
// Included by one source per instruction set. Internal linkage keeps the versions apart.

#include "drivers/bench/lanes/limit_loops.hpp"
#include "kernels/lanes/registers.hpp"

namespace tread {
namespace {

/// Number of independent chains: latency times operations per cycle of usual processors, within their
/// registers.
constexpr int kChains = kRegisterBytes == 64 ? 24 : 12;

template <class Real>
using FullRegister = typename Vector<Real, kFitting<Real>>::type;

void triad(double* a, const double* b, const double* c, double factor, std::int64_t n) {
  using Register = FullRegister<double>;
  constexpr std::int64_t kWidth = kFitting<double>;
  std::int64_t i = 0;
  for (; i + kWidth <= n; i += kWidth) store(a + i, load<Register>(b + i) + factor * load<Register>(c + i));
  for (; i < n; ++i) a[i] = b[i] + factor * c[i];
}

template <class Real>
double multiply_add(std::int64_t rounds) {
  using Register = FullRegister<Real>;
  Register x[kChains];
  for (int k = 0; k < kChains; ++k) x[k] = Register{} + static_cast<Real>(k);
  // The compiler does not know the value; the sequence tends to 1.
  volatile Real half = static_cast<Real>(0.5);
  const Register a = Register{} + half;
  const Register b = a;
  for (std::int64_t i = 0; i < rounds; ++i)
#pragma GCC unroll 32
    for (Register& value : x) value = a * value + b;
  Register sum = x[0];
  for (int k = 1; k < kChains; ++k) sum += x[k];
  return static_cast<double>(sum[0]);
}

template <class Real>
constexpr int flops_per_round() {
  return 2 * kChains * kFitting<Real>;
}

constexpr LimitLoops loops(const char* name) {
  return {name,
          triad,
          multiply_add<double>,
          multiply_add<float>,
          flops_per_round<double>(),
          flops_per_round<float>()};
}

}  // namespace
}  // namespace tread
