#pragma once
// A symmetric matrix that is zero beyond a band, and its factor L D L^T.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tread {

/// Real, or complex and symmetric (not Hermitian). Row i holds the columns i - band ... i.
template <class T>
class BandMatrix {
 public:
  BandMatrix(int size, int band)
      : size_(size),
        band_(band),
        values_(static_cast<std::size_t>(size) * (static_cast<std::size_t>(band) + 1)) {}

  int size() const { return size_; }
  int band() const { return band_; }

  /// Entry (row, column) with row >= column >= row - band.
  T& at(int row, int column) {
    return values_[static_cast<std::size_t>(row) * (static_cast<std::size_t>(band_) + 1) +
                   static_cast<std::size_t>(row - column)];
  }
  T at(int row, int column) const { return const_cast<BandMatrix*>(this)->at(row, column); }

  /// Sum of both, entry by entry: this += factor * other.
  template <class U>
  void add(T factor, const BandMatrix<U>& other) {
    for (int i = 0; i < size_; ++i)
      for (int j = std::max(0, i - band_); j <= i; ++j) at(i, j) += factor * other.at(i, j);
  }

  std::vector<T> times(const std::vector<T>& x) const {
    std::vector<T> y(x.size());
    for (int i = 0; i < size_; ++i)
      for (int j = std::max(0, i - band_); j <= i; ++j) {
        y[static_cast<std::size_t>(i)] += at(i, j) * x[static_cast<std::size_t>(j)];
        if (j < i) y[static_cast<std::size_t>(j)] += at(i, j) * x[static_cast<std::size_t>(i)];
      }
    return y;
  }

  /// Row and column zero, diagonal `value`.
  void restrain(int row, T value) {
    for (int j = std::max(0, row - band_); j < row; ++j) at(row, j) = T{};
    for (int i = row + 1; i <= std::min(size_ - 1, row + band_); ++i) at(i, row) = T{};
    at(row, row) = value;
  }

  /// Replaces the matrix by its factors: D on the diagonal, L below it. No pivoting.
  void factorise() {
    for (int i = 0; i < size_; ++i) {
      const int first = std::max(0, i - band_);
      for (int j = first; j < i; ++j)
        for (int k = std::max(first, j - band_); k < j; ++k) at(i, j) -= at(i, k) * at(j, k);
      for (int j = first; j < i; ++j) {
        const T scaled = at(i, j) / at(j, j);
        at(i, i) -= scaled * at(i, j);
        at(i, j) = scaled;
      }
    }
  }

  /// Solution of the system whose matrix factorise() has replaced. A real matrix takes two right sides as the
  /// real and imaginary parts of one: hardly more time than for one.
  template <class Value>
  std::vector<Value> solve(std::vector<Value> x) const {
    for (int i = 0; i < size_; ++i)
      for (int j = std::max(0, i - band_); j < i; ++j)
        x[static_cast<std::size_t>(i)] -= at(i, j) * x[static_cast<std::size_t>(j)];
    for (int i = 0; i < size_; ++i) x[static_cast<std::size_t>(i)] /= at(i, i);
    for (int i = size_ - 1; i >= 0; --i)
      for (int j = std::max(0, i - band_); j < i; ++j)
        x[static_cast<std::size_t>(j)] -= at(i, j) * x[static_cast<std::size_t>(i)];
    return x;
  }

 private:
  int size_, band_;
  std::vector<T> values_;
};

}  // namespace tread
