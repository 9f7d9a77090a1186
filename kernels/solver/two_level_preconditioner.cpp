#include "kernels/solver/two_level_preconditioner.hpp"

#include <cmath>
#include <utility>

#include "kernels/solver/chunks.hpp"
#include "kernels/stable_step.hpp"

namespace tread {

TwoLevelPreconditioner::TwoLevelPreconditioner(const Mesh& mesh, const Operator& elastic,
                                               AlignedVector<double> diagonal,
                                               const std::vector<TiedSlot>& ties,
                                               const TwoLevelOptions& options)
    : options_(options),
      diagonal_(std::move(diagonal)),
      aggregates_(mesh, diagonal_, options.aggregates),
      coarse_(aggregates_, aggregate_graph(mesh, aggregates_, ties), elastic,
              static_cast<std::int64_t>(diagonal_.size())),
      inverse_(diagonal_.size()),
      residual_(diagonal_.size()),
      step_(diagonal_.size()),
      a_step_(diagonal_.size()),
      coarse_values_(static_cast<std::size_t>(aggregates_.modes())) {}

void TwoLevelPreconditioner::update(Operator a, const std::vector<Spring>& springs) {
  a_ = std::move(a);
  inverse_ = diagonal_;
  // Row sums of |k g g^T| instead of its diagonal: a stiff spring over many nodes then leaves lambda_max
  // alone.
  for (const Spring& spring : springs) {
    double sum = 0;
    for (const double weight : spring.weights) sum += std::abs(weight);
    for (std::size_t i = 0; i < spring.dofs.size(); ++i) {
      const auto at = static_cast<std::size_t>(spring.dofs[i]);
      if (diagonal_[at] > 0) inverse_[at] += spring.stiffness * sum * std::abs(spring.weights[i]);
    }
  }
  for (double& value : inverse_) value = value > 0 ? 1 / value : 0;
  coarse_.factorise(aggregates_, springs);
  constexpr int kSteps = 20;
  lambda_max_ = std::pow(highest_frequency(a_, inverse_, kSteps).omega, 2);
}

void TwoLevelPreconditioner::apply(const double* r, double* z) const {
  smooth(r, z);
  aggregates_.restrict_to_modes(r, coarse_values_.data());
  coarse_.solve(coarse_values_.data(), coarse_values_.data());
  aggregates_.prolongate_add(coarse_values_.data(), z);
}

/// Chebyshev iteration for A z = r from z = 0. [Saad, Iterative Methods for Sparse Linear Systems, alg. 12.1]
void TwoLevelPreconditioner::smooth(const double* r, double* z) const {
  const double centre = 0.5 * lambda_max_ * (1 + 1 / options_.spread);
  const double half_width = 0.5 * lambda_max_ * (1 - 1 / options_.spread);
  const auto n = static_cast<std::int64_t>(inverse_.size());
  for_chunks(n, [&](std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
      residual_[i] = r[i];
      step_[i] = inverse_[i] * r[i] / centre;
      z[i] = step_[i];
    }
  });
  double rho = half_width / centre;
  for (int k = 1; k < options_.degree; ++k) {
    const double next = 1 / (2 * centre / half_width - rho);
    const double keep = next * rho;
    const double gain = 2 * next / half_width;
    rho = next;
    a_(step_.data(), a_step_.data());
    for_chunks(n, [&](std::int64_t first, std::int64_t last) {
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
        residual_[i] -= a_step_[i];
        step_[i] = keep * step_[i] + gain * inverse_[i] * residual_[i];
        z[i] += step_[i];
      }
    });
  }
}

}  // namespace tread
