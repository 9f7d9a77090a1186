#pragma once
// Memory of the one team that solves a patch, and what such a team can do.
//
// Besides what kernels/device/march_body.hpp says, its team has
//   spare()                 data() and size() of the memory that its threads share and no one has taken [B]
//   near(pointer)           the same, of what lies in that memory
//   add(at, value)          adds to an int that its threads share as one operation; returns the former value
//   least(at, value)        lowers one likewise
//   claim(at, value)        sets one likewise where it is zero; returns what it is then
//   number(n, value, take)  take(i, sum of the ints value(0) ... value(i - 1)); returns the sum of all
//   largest(n, values)      largest of both of values(i), or zero
// The last two call for every i, in any order and by any thread, and end when all have ended.

#include <cstddef>
#include <cstdint>

#include "core/inline.hpp"

namespace tread {

struct LargestPair {
  double first, second;
};

/// Raises both to those of another pair. NaN raises nothing.
TREAD_BODY void raise(LargestPair& most, const LargestPair& other) {
  if (other.first > most.first) most.first = other.first;
  if (other.second > most.second) most.second = other.second;
}

/// Memory that the threads share, which is near, and other arrays where it is too small.
class PatchArena {
 public:
  static constexpr std::size_t kLine = 64;  ///< arrays begin at multiples of it [B]

  template <class Memory>
  TREAD_BODY explicit PatchArena(const Memory& memory)
      : low_(memory.data() + (kLine - reinterpret_cast<std::uintptr_t>(memory.data()) % kLine) % kLine),
        end_(memory.data() + memory.size()),
        high_(end_ - reinterpret_cast<std::uintptr_t>(end_) % kLine) {
    end_ = high_;
  }

  /// Room for n values: `other` where there is none.
  template <class T>
  TREAD_BODY T* keep(int n, T* other) {
    const std::ptrdiff_t bytes = bytes_of<T>(n);
    if (bytes > high_ - low_) {
      near_ = false;
      return other;
    }
    std::byte* const first = low_;
    low_ += bytes;
    return reinterpret_cast<T*>(first);
  }
  /// Likewise until take_back().
  template <class T>
  TREAD_BODY T* lend(int n, T* other) {
    const std::ptrdiff_t bytes = bytes_of<T>(n);
    if (bytes > high_ - low_) return other;
    high_ -= bytes;
    return reinterpret_cast<T*>(high_);
  }
  TREAD_BODY void take_back() { high_ = end_; }
  /// True where there was room for all that was kept.
  TREAD_BODY bool near() const { return near_; }

 private:
  template <class T>
  TREAD_BODY static std::ptrdiff_t bytes_of(int n) {
    return static_cast<std::ptrdiff_t>((static_cast<std::size_t>(n) * sizeof(T) + kLine - 1) / kLine * kLine);
  }

  std::byte* low_;
  std::byte* end_;
  std::byte* high_;
  bool near_ = true;
};

}  // namespace tread
