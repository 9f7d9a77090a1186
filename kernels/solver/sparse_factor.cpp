#include "kernels/solver/sparse_factor.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "core/index.hpp"
#include "core/parallel/parallel.hpp"

namespace tread {

namespace {

/// The row of a column's first entry: each later column that uses it uses that row's column, too. -1: a root.
std::vector<int> parents(const SparseFactor::Matrix& lower) {
  std::vector<int> parent(index(lower.cols()), -1);
  for (int column = 0; column < lower.cols(); ++column) {
    const int first = lower.outerIndexPtr()[column];
    if (first < lower.outerIndexPtr()[column + 1]) parent[index(column)] = lower.innerIndexPtr()[first];
  }
  return parent;
}

std::int64_t work_of(const SparseFactor::Matrix& lower, int column) {
  return 1 + lower.outerIndexPtr()[column + 1] - lower.outerIndexPtr()[column];
}

/// Work of the subtree below and with each of these columns.
std::vector<std::int64_t> subtree_work(const SparseFactor::Matrix& lower, const std::vector<int>& parent,
                                       const std::vector<int>& columns) {
  std::vector<std::int64_t> work(parent.size(), 0);
  for (const int j : columns) {
    work[index(j)] += work_of(lower, j);
    if (parent[index(j)] >= 0) work[index(parent[index(j)])] += work[index(j)];
  }
  return work;
}

/// Visits row and value of each entry of a column.
template <class Visit>
void for_entries(const SparseFactor::Matrix& lower, int column, const Visit& visit) {
  for (int at = lower.outerIndexPtr()[column]; at < lower.outerIndexPtr()[column + 1]; ++at)
    visit(lower.innerIndexPtr()[at], lower.valuePtr()[at]);
}

/// Columns of a level are dealt out into bundles of subtrees, none of which has more than one of `parts`
/// parts of the columns' work.
struct Division {
  std::size_t bundles;
  std::int64_t parts;
};
constexpr Division kDivisions[] = {{32, 64}, {8, 12}, {1, 1}};

}  // namespace

bool SparseFactor::compute(const Matrix& matrix) {
  const auto whole = matrix.selfadjointView<Eigen::Lower>();
  if (order_.size() != matrix.rows()) {
    Eigen::AMDOrdering<int>()(whole, order_);
    order_ = order_.inverse().eval();
  }
  Matrix upper(matrix.rows(), matrix.cols());
  upper.selfadjointView<Eigen::Upper>() = whole.twistedBy(order_);
  factor_.compute(upper);
  if (factor_.info() != Eigen::Success) return false;
  const Eigen::VectorXd pivots = factor_.vectorD();
  inverse_pivots_.clear();
  for (const double pivot : pivots) inverse_pivots_.push_back(1 / pivot);
  divide();
  x_.resize(inverse_pivots_.size());
  return std::all_of(inverse_pivots_.begin(), inverse_pivots_.end(),
                     [](double p) { return std::isfinite(p); });
}

void SparseFactor::divide() {
  const std::vector<int> parent = parents(lower());
  std::vector<int> left(parent.size());  // columns of no level yet
  std::iota(left.begin(), left.end(), 0);
  levels_.clear();
  for (const Division& division : kDivisions) {
    const std::vector<std::int64_t> work = subtree_work(lower(), parent, left);
    const std::int64_t all =
        std::accumulate(left.begin(), left.end(), std::int64_t{0},
                        [&](std::int64_t sum, int j) { return sum + work_of(lower(), j); });
    const auto stays = [&](int j) { return work[index(j)] > all / division.parts; };
    std::vector<int> taken;
    std::copy_if(left.begin(), left.end(), std::back_inserter(taken), [&](int j) { return !stays(j); });
    std::erase_if(left, [&](int j) { return !stays(j); });
    levels_.push_back({bundles_of(taken, parent, work, division.bundles), left.size()});
    sums_.resize(std::max(sums_.size(), division.bundles * left.size()));
  }
  by_level_.clear();
  number_.resize(parent.size());
  for (std::size_t level = levels_.size(); level-- > 0;)
    for (const Bundle& bundle : levels_[level].bundles)
      for (const int column : bundle) {
        number_[index(column)] = by_level_.size();
        by_level_.push_back(column);
      }
}

/// Deals out whole subtrees of these columns, those of most work first, to the bundle of least work.
std::vector<SparseFactor::Bundle> SparseFactor::bundles_of(const std::vector<int>& columns,
                                                           const std::vector<int>& parent,
                                                           const std::vector<std::int64_t>& work,
                                                           std::size_t count) {
  std::vector<bool> dealt_out(parent.size(), false);
  for (const int j : columns) dealt_out[index(j)] = true;
  std::vector<int> roots;
  std::copy_if(columns.begin(), columns.end(), std::back_inserter(roots), [&](int j) {
    const int above = parent[index(j)];
    return above < 0 || !dealt_out[index(above)];
  });
  std::stable_sort(roots.begin(), roots.end(), [&](int a, int b) { return work[index(a)] > work[index(b)]; });
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> bundle_of(parent.size(), kNone);
  std::vector<std::int64_t> sums(count, 0);
  for (const int root : roots) {
    const auto least = std::min_element(sums.begin(), sums.end());
    *least += work[index(root)];
    bundle_of[index(root)] = index(least - sums.begin());
  }
  for (std::size_t i = columns.size(); i-- > 0;) {
    std::size_t& bundle = bundle_of[index(columns[i])];
    if (bundle == kNone) bundle = bundle_of[index(parent[index(columns[i])])];
  }
  std::vector<Bundle> bundles(count);
  for (const int j : columns) bundles[bundle_of[index(j)]].push_back(j);
  return bundles;
}

/// L y = x in these columns; what they take from columns above their level goes to `sums`.
void SparseFactor::solve_forward(const Bundle& bundle, std::size_t above, double* sums) const {
  std::fill_n(sums, above, 0.0);
  for (const int column : bundle) {
    const double value = x_[index(column)];
    for_entries(lower(), column, [&](int row, double entry) {
      const std::size_t number = number_[index(row)];
      (number < above ? sums[number] : x_[index(row)]) -= entry * value;
    });
  }
}

void SparseFactor::solve_forward(const Level& level) const {
  const auto sums_of = [&](std::size_t bundle) { return sums_.data() + bundle * level.above; };
  parallel_ranges(std::ssize(level.bundles), [&](std::int64_t first, std::int64_t last) {
    for (std::size_t b = index(first); b < index(last); ++b)
      solve_forward(level.bundles[b], level.above, sums_of(b));
  });
  for (std::size_t b = 0; b < level.bundles.size(); ++b)
    for (std::size_t number = 0; number < level.above; ++number)
      x_[index(by_level_[number])] += sums_of(b)[number];
}

/// D L^T y = x in these columns, of which those above have their y.
void SparseFactor::solve_backward(const Bundle& bundle) const {
  for (std::size_t i = bundle.size(); i-- > 0;) {
    double value = x_[index(bundle[i])] * inverse_pivots_[index(bundle[i])];
    for_entries(lower(), bundle[i], [&](int row, double entry) { value -= entry * x_[index(row)]; });
    x_[index(bundle[i])] = value;
  }
}

void SparseFactor::solve(const double* r, double* y) const {
  const int* const place = order_.indices().data();
  for (std::size_t i = 0; i < x_.size(); ++i) x_[index(place[i])] = r[i];
  for (const Level& level : levels_) solve_forward(level);
  for (std::size_t i = levels_.size(); i-- > 0;) {
    const std::vector<Bundle>& bundles = levels_[i].bundles;
    parallel_ranges(std::ssize(bundles), [&](std::int64_t first, std::int64_t last) {
      for (std::size_t b = index(first); b < index(last); ++b) solve_backward(bundles[b]);
    });
  }
  for (std::size_t i = 0; i < x_.size(); ++i) y[i] = x_[index(place[i])];
}

}  // namespace tread
