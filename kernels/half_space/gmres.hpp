#pragma once
// A system of linear equations whose matrix is known by its products.

#include <cmath>
#include <utility>
#include <vector>

namespace tread::half_space {

inline double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// to += factor * from
inline void add(double factor, const std::vector<double>& from, std::vector<double>& to) {
  for (std::size_t k = 0; k < to.size(); ++k) to[k] += factor * from[k];
}

/// Generalised minimal residual without restart: x with |rhs - A x| <= tolerance |rhs|, from x = 0. After
/// `steps` products it returns the last x. [Saad and Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856]
template <class Product>
std::vector<double> gmres(const Product& product, const std::vector<double>& rhs, double tolerance,
                          int steps) {
  std::vector<double> x(rhs.size(), 0.0);
  const double norm = std::sqrt(dot(rhs, rhs));
  if (norm == 0) return x;
  std::vector<std::vector<double>> basis(1, rhs);
  for (double& v : basis[0]) v /= norm;
  std::vector<std::vector<double>> h;  // columns of the triangle
  std::vector<double> cosine, sine;
  std::vector<double> g(1, norm);
  for (int k = 0; k < steps && std::abs(g.back()) > tolerance * norm; ++k) {
    std::vector<double> w = product(basis[k]);
    std::vector<double> column(k + 2);
    for (int i = 0; i <= k; ++i) {
      column[i] = dot(w, basis[i]);
      add(-column[i], basis[i], w);
    }
    column[k + 1] = std::sqrt(dot(w, w));
    if (column[k + 1] > 0)
      for (double& v : w) v /= column[k + 1];
    basis.push_back(std::move(w));
    for (int i = 0; i < k; ++i) {
      const double upper = cosine[i] * column[i] + sine[i] * column[i + 1];
      column[i + 1] = cosine[i] * column[i + 1] - sine[i] * column[i];
      column[i] = upper;
    }
    const double length = std::hypot(column[k], column[k + 1]);
    cosine.push_back(column[k] / length);
    sine.push_back(column[k + 1] / length);
    column[k] = length;
    g.push_back(-sine[k] * g[k]);
    g[k] *= cosine[k];
    h.push_back(std::move(column));
  }
  std::vector<double> y(h.size());
  for (int k = static_cast<int>(h.size()) - 1; k >= 0; --k) {
    double sum = g[k];
    for (std::size_t j = k + 1; j < h.size(); ++j) sum -= h[j][k] * y[j];
    y[k] = sum / h[k][k];
  }
  for (std::size_t k = 0; k < h.size(); ++k) add(y[k], basis[k], x);
  return x;
}

}  // namespace tread::half_space
