#pragma once
// Included by one source per instruction set; internal linkage keeps the versions apart.

#include "drivers/bench/lanes/limit_loops.hpp"

namespace tread {
namespace {

#if defined(__AVX512F__)
constexpr int kRegisterBytes = 64;
#elif defined(__AVX__)
constexpr int kRegisterBytes = 32;
#else
constexpr int kRegisterBytes = 16;
#endif

/// Chains that do not wait for one another: latency times operations per cycle of the processors at hand,
/// within their registers.
constexpr int kChains = kRegisterBytes == 64 ? 24 : 12;

template <class Real>
struct Vector {
  typedef Real type __attribute__((vector_size(kRegisterBytes)));
};

void triad(double* a, const double* b, const double* c, double factor, std::int64_t n) {
  using Register = Vector<double>::type;
  constexpr std::int64_t kWidth = kRegisterBytes / static_cast<int>(sizeof(double));
  std::int64_t i = 0;
  for (; i + kWidth <= n; i += kWidth) {
    Register x;
    Register y;
    __builtin_memcpy(&x, b + i, sizeof x);
    __builtin_memcpy(&y, c + i, sizeof y);
    x += factor * y;
    __builtin_memcpy(a + i, &x, sizeof x);
  }
  for (; i < n; ++i) a[i] = b[i] + factor * c[i];
}

template <class Real>
double multiply_add(std::int64_t rounds) {
  using Register = typename Vector<Real>::type;
  Register x[kChains];
  for (int k = 0; k < kChains; ++k) x[k] = Register{} + static_cast<Real>(k);
  // Not known to the compiler; the sequence tends to 1.
  volatile Real half = static_cast<Real>(0.5);
  const Register a = Register{} + half;
  const Register b = a;
  for (std::int64_t i = 0; i < rounds; ++i)
#pragma GCC unroll 32
    for (int k = 0; k < kChains; ++k) x[k] = a * x[k] + b;
  Register sum = x[0];
  for (int k = 1; k < kChains; ++k) sum += x[k];
  return static_cast<double>(sum[0]);
}

template <class Real>
constexpr int flops_per_round() {
  return 2 * kChains * kRegisterBytes / static_cast<int>(sizeof(Real));
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
