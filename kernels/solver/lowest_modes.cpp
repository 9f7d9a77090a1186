#include "kernels/solver/lowest_modes.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"

namespace tread {

namespace {

using Matrix = Eigen::MatrixXd;
using Columns = Eigen::Map<Matrix>;

constexpr Eigen::Index kRows = 1024;  ///< rows of all columns that a cache holds

/// Calls body(chunk, first row, rows) for every chunk of rows, in parallel.
template <class Body>
void for_rows(Eigen::Index rows, const Body& body) {
  parallel_ranges((rows + kRows - 1) / kRows, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t c = first; c < last; ++c) body(c, c * kRows, std::min(kRows, rows - c * kRows));
  });
}

/// Columns c with c^T m c = 1 that span the directions which `m` tells apart.
Matrix well_conditioned(const Matrix& m) {
  constexpr double kSmallest = 1e-12;
  const Eigen::VectorXd scale = m.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Matrix> spectrum(scale.asDiagonal() * m * scale.asDiagonal());
  const Eigen::VectorXd& value = spectrum.eigenvalues();
  const Eigen::Index dropped =
      std::count_if(value.begin(), value.end(), [&](double v) { return v < kSmallest * value.maxCoeff(); });
  const Eigen::Index kept = m.rows() - dropped;
  return scale.asDiagonal() * spectrum.eigenvectors().rightCols(kept) *
         value.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Iterates, then corrections and last directions of the unconverged iterates, and their products with the
/// stiffness.
class Subspace {
 public:
  Subspace(const Operator& stiffness, const AlignedVector<double>& mass, int width)
      : stiffness_(&stiffness),
        rows_(static_cast<Eigen::Index>(mass.size())),
        width_(width),
        mass_(Eigen::Map<const Eigen::VectorXd>(mass.data(), rows_)),
        vectors_(static_cast<std::size_t>(3 * width * rows_), 0.0),
        forces_(vectors_.size(), 0.0) {}

  int width() const { return width_; }
  double* vector(int k) { return vectors_.data() + k * rows_; }
  Columns vectors(int first, int count) { return {vector(first), rows_, count}; }
  Columns forces(int first, int count) { return {forces_.data() + first * rows_, rows_, count}; }
  const Eigen::VectorXd& mass() const { return mass_; }

  void apply(int first, int count) {
    for (int k = first; k < first + count; ++k) (*stiffness_)(vector(k), forces_.data() + k * rows_);
  }

  /// Rayleigh and Ritz over the first `used` columns. The lowest Ritz vectors become the iterates; their
  /// parts outside the old iterates become directions. Returns the Ritz values.
  Eigen::VectorXd reduce(int used) {
    const auto [m, k] = gram(used);
    const Matrix basis = well_conditioned(m);
    const Eigen::SelfAdjointEigenSolver<Matrix> small(basis.transpose() * k * basis);
    const Matrix ritz = basis * small.eigenvectors().leftCols(width_);
    const int beside = used - width_;
    for (Columns all : {vectors(0, 3 * width_), forces(0, 3 * width_)})
      for_rows(rows_, [&](Eigen::Index, Eigen::Index first, Eigen::Index count) {
        const Matrix direction = all.block(first, width_, count, beside) * ritz.bottomRows(beside);
        const Matrix next = all.block(first, 0, count, width_) * ritz.topRows(width_) + direction;
        all.block(first, 0, count, width_) = next;
        all.block(first, 2 * width_, count, width_) = direction;
      });
    return small.eigenvalues().head(width_);
  }

  /// Keeps the directions of the given iterates, in the columns from `first` on.
  void keep_directions(const std::vector<int>& iterates, int first) {
    for (std::size_t i = 0; i < iterates.size(); ++i)
      for (auto* field : {&vectors_, &forces_})
        std::copy_n(field->data() + (2 * width_ + iterates[i]) * rows_, rows_,
                    field->data() + (first + static_cast<int>(i)) * rows_);
  }

  /// Removes the iterates' components from the `count` corrections, so that their Gram matrix tells them
  /// apart.
  void project(int count) {
    const Matrix held = gram_of(count);
    for_rows(rows_, [&](Eigen::Index, Eigen::Index first, Eigen::Index n) {
      vectors(width_, count).middleRows(first, n) -= vectors(0, width_).middleRows(first, n) * held;
    });
  }

 private:
  struct Gram {
    Matrix m, k;
  };

  Gram gram(int used) {
    std::vector<Gram> part(static_cast<std::size_t>((rows_ + kRows - 1) / kRows));
    for_rows(rows_, [&](Eigen::Index chunk, Eigen::Index first, Eigen::Index n) {
      const auto v = vectors(0, used).middleRows(first, n);
      const Matrix weighted = mass_.segment(first, n).asDiagonal() * v;
      Gram& g = part[static_cast<std::size_t>(chunk)];
      g.m = g.k = Matrix::Zero(used, used);
      g.m.triangularView<Eigen::Lower>() += v.transpose() * weighted;
      g.k.triangularView<Eigen::Lower>() += v.transpose() * forces(0, used).middleRows(first, n);
    });
    Gram sum{Matrix::Zero(used, used), Matrix::Zero(used, used)};
    for (const Gram& g : part) {
      sum.m += g.m;
      sum.k += g.k;
    }
    return {sum.m.selfadjointView<Eigen::Lower>(), sum.k.selfadjointView<Eigen::Lower>()};
  }

  /// Returns X^T M W.
  Matrix gram_of(int count) {
    std::vector<Matrix> part(static_cast<std::size_t>((rows_ + kRows - 1) / kRows));
    for_rows(rows_, [&](Eigen::Index chunk, Eigen::Index first, Eigen::Index n) {
      const Matrix weighted =
          mass_.segment(first, n).asDiagonal() * vectors(width_, count).middleRows(first, n);
      part[static_cast<std::size_t>(chunk)] = vectors(0, width_).middleRows(first, n).transpose() * weighted;
    });
    Matrix sum = Matrix::Zero(width_, count);
    for (const Matrix& p : part) sum += p;
    return sum;
  }

  const Operator* stiffness_;
  Eigen::Index rows_;
  int width_;
  Eigen::VectorXd mass_;
  AlignedVector<double> vectors_, forces_;
};

/// Fills columns with vectors without structure. Any vectors will do that are not orthogonal to the wanted
/// ones.
void fill_without_structure(Columns columns, const Eigen::VectorXd& mass) {
  for (Eigen::Index j = 0; j < columns.cols(); ++j)
    for (Eigen::Index i = 0; i < columns.rows(); ++i) {
      auto hash = static_cast<std::uint64_t>(i + 1 + j * columns.rows()) * 0x9E3779B97F4A7C15ULL;
      hash = (hash ^ (hash >> 29)) * 0xBF58476D1CE4E5B9ULL;
      columns(i, j) = mass[i] * (static_cast<double>(hash >> 11) / 9007199254740992.0 - 0.5);
    }
}

}  // namespace

LowestModes lowest_modes(const Operator& stiffness, const AlignedVector<double>& mass,
                         const Preconditioner& preconditioner, const LowestModesOptions& options) {
  const int width = options.count + options.guard;
  Subspace space(stiffness, mass, width);
  const Eigen::VectorXd inverse = space.mass().unaryExpr([](double m) { return m > 0 ? 1 / m : 0.0; });
  AlignedVector<double> residual(mass.size());
  Eigen::Map<Eigen::VectorXd> r(residual.data(), static_cast<Eigen::Index>(mass.size()));

  fill_without_structure(space.vectors(width, width), space.mass());
  for (int k = 0; k < width; ++k) preconditioner.apply(space.vector(width + k), space.vector(k));
  space.apply(0, width);
  Eigen::VectorXd value = space.reduce(width);

  LowestModes modes;
  std::vector<int> active;  // iterates that have not converged
  for (modes.iterations = 1;; ++modes.iterations) {
    modes.residual = 0;
    active.clear();
    for (int k = 0; k < width; ++k) {
      r = space.forces(k, 1) - value[k] * space.mass().cwiseProduct(space.vectors(k, 1).col(0));
      const double size = std::sqrt(r.cwiseAbs2().dot(inverse)) / (std::abs(value[k]) + options.shift);
      if (k < options.count) modes.residual = std::max(modes.residual, size);
      // Converged far below the tolerance, so that others may still lean on it.
      if (size < 0.3 * options.tolerance) continue;
      preconditioner.apply(residual.data(), space.vector(width + static_cast<int>(active.size())));
      active.push_back(k);
    }
    if (modes.residual <= options.tolerance) break;
    if (modes.iterations == options.max_iterations)
      throw NumericalError(fmt::format("lowest modes: residual {:.1e} after {} iterations (wanted {:.0e})",
                                       modes.residual, modes.iterations, options.tolerance));
    const int count = static_cast<int>(active.size());
    space.project(count);
    space.apply(width, count);
    const bool directions = modes.iterations > 1;
    if (directions) space.keep_directions(active, width + count);
    value = space.reduce(width + (directions ? 2 : 1) * count);
  }
  for (int k = 0; k < options.count; ++k) {
    modes.omega.push_back(std::sqrt(std::max(0.0, value[k])));
    const Columns shape = space.vectors(k, 1);
    modes.shapes.emplace_back(shape.data(), shape.data() + shape.size());
  }
  return modes;
}

}  // namespace tread
