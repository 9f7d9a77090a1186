#pragma once
// Registers of the instruction set that the including source is compiled for. Internal linkage keeps the
// versions apart.

#include "core/inline.hpp"
#include "core/mesh/swept_block.hpp"
#include "kernels/lanes/prefetch.hpp"

namespace tread {
namespace {

#if defined(__AVX512F__)
constexpr int kRegisterBytes = 64;
#elif defined(__AVX__)
constexpr int kRegisterBytes = 32;
#else
constexpr int kRegisterBytes = 16;
#endif

template <class Real, int width>
struct Vector {
  typedef Real type __attribute__((vector_size(width * sizeof(Real))));
  /// Vector at any multiple of a value's size. No byte copy replaces it: bytes could alias pointers and
  /// indices, and the compiler would reload these after every store.
  typedef Real unaligned __attribute__((vector_size(width * sizeof(Real)), aligned(alignof(Real))));
};

template <class V, class Real>
using Unaligned = typename Vector<Real, sizeof(V) / sizeof(Real)>::unaligned;

template <class V, class Real>
TREAD_INLINE V load(const Real* at) {
  return *reinterpret_cast<const Unaligned<V, Real>*>(at);
}

template <class V, class Real>
TREAD_INLINE void store(Real* at, const V& value) {
  *reinterpret_cast<Unaligned<V, Real>*>(at) = value;
}

/// Compilers load a value anew for each use, and loads bound the elements' loop.
template <class V>
TREAD_INLINE V in_register(V value) {
#if defined(__AVX512F__)
  asm("" : "+v"(value));
#elif defined(__AVX__)
  asm("" : "+x"(value));
#endif
  return value;
}

/// Number of values in a register.
template <class Real>
constexpr int kFitting = kRegisterBytes / static_cast<int>(sizeof(Real));

/// Split of the lanes of a tile into registers.
template <class Real>
struct Lanes {
  static constexpr int kWidth = kFitting<Real> < kLanes ? kFitting<Real> : kLanes;
  static constexpr int kParts = kLanes / kWidth;
  using Register = typename Vector<Real, kWidth>::type;
};

}  // namespace
}  // namespace tread
