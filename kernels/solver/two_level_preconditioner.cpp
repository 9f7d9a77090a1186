#include "kernels/solver/two_level_preconditioner.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/index.hpp"
#include "core/parallel/chunks.hpp"
#include "kernels/solver/stable_step.hpp"

namespace tread {

TwoLevelPreconditioner::TwoLevelPreconditioner(const Mesh& mesh, const Operator& elastic,
                                               AlignedVector<double> diagonal,
                                               const std::vector<TiedSlot>& ties,
                                               const TwoLevelOptions& options)
    : options_(options),
      aggregates_(mesh, diagonal, options.aggregates),
      coarse_(aggregates_, aggregate_graph(mesh, aggregates_, ties), elastic,
              static_cast<std::int64_t>(diagonal.size())),
      coarse_values_(static_cast<std::size_t>(aggregates_.modes())) {
  const auto values = std::ssize(diagonal);
  for_chunks(values, [&](std::int64_t first, std::int64_t last) {
    for (auto i = index(first); i < index(last); ++i) diagonal[i] = diagonal[i] > 0 ? 1 / diagonal[i] : 0;
  });
  constexpr int kSteps = 20;
  constexpr double kRounding = 1e-6;  // relative rounding of the diagonal stored in float
  lambda_max_ = (1 + kRounding) * std::pow(highest_frequency(elastic, diagonal, kSteps).omega, 2);
  inverse_.resize(diagonal.size());
  for_chunks(values, [&](std::int64_t first, std::int64_t last) {
    for (auto i = index(first); i < index(last); ++i) inverse_[i] = static_cast<float>(diagonal[i]);
  });
  AlignedVector<double>().swap(diagonal);
  a_z_.resize(inverse_.size());
}

void TwoLevelPreconditioner::update(Operator a, const std::vector<Spring>& springs) {
  a_ = std::move(a);
  for (std::size_t i = changes_.size(); i-- > 0;) inverse_[changes_[i].first] = changes_[i].second;
  changes_.clear();
  // Row sums of |k g g^T| replace its diagonal: D^-1 A then has no larger eigenvalue than without springs.
  for (const Spring& spring : springs) {
    double sum = 0;
    for (const double weight : spring.weights) sum += std::abs(weight);
    for (std::size_t i = 0; i < spring.dofs.size(); ++i) {
      const auto at = static_cast<std::size_t>(spring.dofs[i]);
      if (inverse_[at] == 0) continue;
      changes_.emplace_back(at, inverse_[at]);
      const double added = spring.stiffness * sum * std::abs(spring.weights[i]);
      inverse_[at] = static_cast<float>(1 / (1.0 / inverse_[at] + added));
    }
  }
  coarse_.factorise(aggregates_, springs);
}

void TwoLevelPreconditioner::apply(const double* r, double* z) const {
  smooth(r, z);
  aggregates_.restrict_to_modes(r, coarse_values_.data());
  coarse_.solve(coarse_values_.data(), coarse_values_.data());
  aggregates_.prolongate_add(coarse_values_.data(), z);
}

/// Applies the polynomial of Chebyshev's iteration for A z = r from z = 0, one root after the other: no step
/// has to be stored. [Saad, Iterative Methods for Sparse Linear Systems, 12.3]
void TwoLevelPreconditioner::smooth(const double* r, double* z) const {
  const double centre = 0.5 * lambda_max_ * (1 + 1 / options_.spread);
  const double half_width = 0.5 * lambda_max_ * (1 - 1 / options_.spread);
  const auto n = static_cast<std::int64_t>(inverse_.size());
  for (int k = 0; k < options_.degree; ++k) {
    const double gain = 1 / (centre + half_width * std::cos(std::numbers::pi * (k + 0.5) / options_.degree));
    if (k > 0) a_(z, a_z_.data());
    for_chunks(n, [&](std::int64_t first, std::int64_t last) {
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
        z[i] = k == 0 ? gain * inverse_[i] * r[i] : z[i] + gain * inverse_[i] * (r[i] - a_z_[i]);
    });
  }
}

}  // namespace tread
