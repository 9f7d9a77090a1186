#pragma once
// A number that counts the operations done with it: all operations of a templated kernel body.

#include <cstdint>

namespace tread {

/// Negation is free; a fused multiply-add is two operations.
class Counted {
 public:
  Counted() = default;
  constexpr Counted(double value) : value_(value) {}

  static std::int64_t operations() { return count; }

  Counted operator-() const { return Counted(-value_); }
  friend Counted operator+(Counted a, Counted b) { return counted(a.value_ + b.value_); }
  friend Counted operator-(Counted a, Counted b) { return counted(a.value_ - b.value_); }
  friend Counted operator*(Counted a, Counted b) { return counted(a.value_ * b.value_); }
  friend Counted operator/(Counted a, Counted b) { return counted(a.value_ / b.value_); }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  Counted& operator*=(Counted b) { return *this = *this * b; }

 private:
  static Counted counted(double value) {
    ++count;
    return Counted(value);
  }

  inline static thread_local std::int64_t count = 0;
  double value_;
};

}  // namespace tread
