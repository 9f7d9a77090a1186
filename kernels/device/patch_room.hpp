#pragma once
// Teams of threads that solve a patch together, and what they share.
//
// They have
//   teams(), team()            how many there are; which one a body is called by
//   run(n)                     number of n items of which each team takes a run; the last ones may be shorter
//   for_each<width>(n, body)   body(0) ... body(n width - 1), run(n) width of them by a team; ends when all
//                              teams have ended
//   for_own<width>(n, body)    the same; each team goes on when itself has ended
//   for_lists(n, first, body)  likewise body(first(i)) ... body(first(i + 1) - 1) for each of the n items i
//   number(n, value, take)     take(i, sum of the ints value(0) ... value(i - 1)); returns the sum of all
//   largest(n, values)         largest of both of values(i), or zero
//   memory()                   data() and size() of the memory of a team that its threads share [B]
//   here(pointer)              of the own team, from a pointer into that memory
//   near(pointer)              the same for an address space that the compiler knows
//   tell(pointer, value)       sets a value in the memories of all teams
//   add(at, value)             adds to an int as one operation; returns the former value
//   least(at, value)           lowers one likewise
//   claim(at, value)           sets one likewise where it is zero; returns what it is then
// `number` and `largest` take the same runs, in any order and by any thread, and end when all have ended.

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

/// An array of which each team holds a run, or a copy: in its own memory, or `far`, in an array of all.
template <class T>
struct TeamArray {
  T* values;
  int stride;  ///< of the runs, where they are far
  bool far;
};

/// The memory that a team's threads share. What finds no room is far, and all after it.
class PatchRoom {
 public:
  static constexpr std::size_t kLine = 64;  ///< arrays begin at multiples of it [B]

  template <class Memory>
  TREAD_BODY explicit PatchRoom(const Memory& memory) : next_(memory.data()), left_(memory.size()) {}

  /// Room in each team for `length` values.
  template <class T>
  TREAD_BODY TeamArray<T> keep(int length, T* far, int stride) {
    const std::size_t bytes = (static_cast<std::size_t>(length) * sizeof(T) + kLine - 1) / kLine * kLine;
    near_ = near_ && bytes <= left_;
    if (!near_) return {far, stride, true};
    std::byte* const first = next_;
    next_ += bytes;
    left_ -= bytes;
    return {reinterpret_cast<T*>(first), stride, false};
  }
  template <class T>
  TREAD_BODY TeamArray<T> keep(int length, T* far) {
    return keep(length, far, length);
  }
  /// True where there was room for all.
  TREAD_BODY bool near() const { return near_; }

 private:
  std::byte* next_;
  std::size_t left_;
  bool near_ = true;
};

}  // namespace tread
