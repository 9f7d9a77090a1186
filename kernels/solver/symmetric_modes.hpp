#pragma once
// All eigenvalues and eigenvectors of a small dense symmetric matrix.

#include <vector>

namespace tread {

struct SymmetricModes {
  std::vector<double> values;   ///< eigenvalues, ascending
  std::vector<double> vectors;  ///< unit eigenvectors, one after another

  std::size_t size() const { return values.size(); }
  /// Components of vectors in the eigenvectors, vector after vector; `all` holds as many values for each.
  std::vector<double> components(const std::vector<double>& all) const;
};

/// `matrix`: n x n values [any unit].
SymmetricModes symmetric_modes(const std::vector<double>& matrix, std::size_t n);

}  // namespace tread
