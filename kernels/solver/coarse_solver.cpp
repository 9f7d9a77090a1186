#include "kernels/solver/coarse_solver.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_set>

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/page_vector.hpp"
#include "core/parallel/chunks.hpp"
#include "kernels/solver/sparse_factor.hpp"

namespace tread {

namespace {

using SparseMatrix = SparseFactor::Matrix;

/// Pairs of coupled aggregates, collected element by element.
class Couplings {
 public:
  Couplings(const Mesh& mesh, const Aggregates& aggregates, const std::vector<TiedSlot>& ties)
      : aggregates_(aggregates), ties_(ties), tied_(static_cast<std::size_t>(mesh.slots), false) {
    for (const TiedSlot& tie : ties) tied_[static_cast<std::size_t>(tie.secondary)] = true;
  }

  /// Couples the aggregates of all nodes of one element.
  void join(const std::array<std::int64_t, 8>& slots) {
    members_.clear();
    for (const std::int64_t slot : slots) {
      add(slot);
      if (!tied_[static_cast<std::size_t>(slot)]) continue;
      for (auto tie = std::lower_bound(ties_.begin(), ties_.end(), slot,
                                       [](const TiedSlot&t, std::int64_t at) { return t.secondary < at; });
           tie != ties_.end() && tie->secondary == slot; ++tie)
        add(tie->primary);
    }
    for (const int a : members_)
      for (const int b : members_)
        if (a < b) pairs_.insert(static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b));
  }

  std::vector<std::vector<int>> graph() const {
    std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(aggregates_.count()));
    for (std::size_t a = 0; a < neighbours.size(); ++a) neighbours[a].push_back(static_cast<int>(a));
    for (const std::uint64_t pair : pairs_) {
      const auto a = static_cast<int>(pair >> 32);
      const auto b = static_cast<int>(pair & 0xffffffffu);
      neighbours[static_cast<std::size_t>(a)].push_back(b);
      neighbours[static_cast<std::size_t>(b)].push_back(a);
    }
    for (auto& list : neighbours) std::sort(list.begin(), list.end());
    return neighbours;
  }

 private:
  void add(std::int64_t slot) {
    const int aggregate = aggregates_.of_slot(slot);
    if (aggregate >= 0 && std::find(members_.begin(), members_.end(), aggregate) == members_.end())
      members_.push_back(aggregate);
  }

  const Aggregates& aggregates_;
  const std::vector<TiedSlot>& ties_;
  std::vector<bool> tied_;  ///< true for secondary nodes, by slot
  std::unordered_set<std::uint64_t> pairs_;
  std::vector<int> members_;
};

}  // namespace

std::vector<std::vector<int>> aggregate_graph(const Mesh& mesh, const Aggregates& aggregates,
                                              const std::vector<TiedSlot>& ties) {
  Couplings couplings(mesh, aggregates, ties);
  for (const SweptBlock& block : mesh.blocks) {
    const int elements = block.closed ? block.station_count() : block.station_count() - 1;
    for (int near = 0; near < elements; ++near) {
      const int far = (near + 1) % block.station_count();
      for (const auto& quad : block.section.quads) {
        std::array<std::int64_t, 8> slots;
        for (std::size_t i = 0; i < 4; ++i) {
          slots[i] = block.base + block.slot(quad[i], near);
          slots[i + 4] = block.base + block.slot(quad[i], far);
        }
        couplings.join(slots);
      }
    }
  }
  for (const HexBody& body : mesh.bodies)
    for (const HexCorners& corners : body.mesh.elements) {
      std::array<std::int64_t, 8> slots;
      for (std::size_t i = 0; i < 8; ++i) slots[i] = body.slot(corners[i]);
      couplings.join(slots);
    }
  return couplings.graph();
}

std::vector<int> distance_two_colours(const std::vector<std::vector<int>>& graph) {
  std::vector<int> colour(graph.size(), -1);
  std::vector<std::size_t> taken_by;  // taken_by[c] == a + 1: colour c stands within two edges of aggregate a
  for (std::size_t a = 0; a < graph.size(); ++a) {
    for (const int b : graph[a])
      for (const int c : graph[static_cast<std::size_t>(b)])
        if (colour[static_cast<std::size_t>(c)] >= 0)
          taken_by[static_cast<std::size_t>(colour[static_cast<std::size_t>(c)])] = a + 1;
    std::size_t free = 0;
    while (free < taken_by.size() && taken_by[free] == a + 1) ++free;
    if (free == taken_by.size()) taken_by.push_back(0);
    colour[a] = static_cast<int>(free);
  }
  return colour;
}

struct CoarseSolver::Matrices {
  SparseMatrix base;  ///< lower triangle without springs
  SparseFactor factor;
  std::optional<std::vector<Spring>> springs;  ///< that the factor has
};

namespace {

/// Lower triangle of Z^T A Z, six columns of a colour at a time.
SparseMatrix probe(const Aggregates& aggregates, const std::vector<std::vector<int>>& graph,
                   const Operator& a, std::int64_t values) {
  const auto colour = distance_two_colours(graph);
  const int colours = colour.empty() ? 0 : *std::max_element(colour.begin(), colour.end()) + 1;
  std::vector<std::vector<int>> members(static_cast<std::size_t>(colours));
  for (std::size_t i = 0; i < colour.size(); ++i)
    members[static_cast<std::size_t>(colour[i])].push_back(static_cast<int>(i));

  PageVector<double> x(static_cast<std::size_t>(values)), y(x.size());
  std::vector<double> coarse(static_cast<std::size_t>(aggregates.modes()));
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& group : members)
    for (int k = 0; k < 6; ++k) {
      std::fill(coarse.begin(), coarse.end(), 0.0);
      bool any = false;
      for (const int i : group)
        if (k < aggregates.mode_count(i)) {
          coarse[static_cast<std::size_t>(aggregates.first_mode(i) + k)] = 1;
          any = true;
        }
      if (!any) continue;
      for_chunks(values, [&](std::int64_t first, std::int64_t last) {
        std::fill(x.data() + first, x.data() + last, 0.0);
      });
      aggregates.prolongate_add(coarse.data(), x.data());
      a(x.data(), y.data());
      aggregates.restrict_to_modes(y.data(), coarse.data());
      for (const int i : group) {
        if (k >= aggregates.mode_count(i)) continue;
        const int column = aggregates.first_mode(i) + k;
        for (const int j : graph[static_cast<std::size_t>(i)])
          for (int m = 0; m < aggregates.mode_count(j); ++m) {
            const int row = aggregates.first_mode(j) + m;
            if (row >= column) entries.emplace_back(row, column, coarse[static_cast<std::size_t>(row)]);
          }
      }
    }
  SparseMatrix matrix(aggregates.modes(), aggregates.modes());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Compares Z^T A Z and the probed matrix on one irregular vector.
void check_probes(const Aggregates& aggregates, const Operator& a, const SparseMatrix& matrix,
                  std::int64_t values) {
  Eigen::VectorXd coarse(aggregates.modes()), product(aggregates.modes());
  for (int i = 0; i < aggregates.modes(); ++i) coarse[i] = std::sin(1.0 + 1.7 * i * i);
  PageVector<double> x(static_cast<std::size_t>(values)), y(x.size());
  aggregates.prolongate_add(coarse.data(), x.data());
  a(x.data(), y.data());
  aggregates.restrict_to_modes(y.data(), product.data());
  const double difference = (matrix.selfadjointView<Eigen::Lower>() * coarse - product).norm();
  if (difference > 1e-8 * product.norm())
    throw NumericalError(
        fmt::format("static solver: the probed coarse matrix misses {:.1e} of the operator, which couples "
                    "nodes that share no "
                    "element or is not symmetric; pass such couplings as ties or springs",
                    difference / product.norm()));
}

}  // namespace

CoarseSolver::CoarseSolver(const Aggregates& aggregates, const std::vector<std::vector<int>>& graph,
                           const Operator& a, std::int64_t values)
    : matrices_(std::make_unique<Matrices>()) {
  matrices_->base = probe(aggregates, graph, a, values);
  check_probes(aggregates, a, matrices_->base, values);
}
CoarseSolver::~CoarseSolver() = default;
CoarseSolver::CoarseSolver(CoarseSolver&&) noexcept = default;

namespace {

/// Z^T w of one spring: its weights on the modes that it touches.
std::map<int, double> on_modes(const Aggregates& aggregates, const Spring& spring) {
  std::map<int, double> sum;
  for (std::size_t i = 0; i < spring.dofs.size(); ++i) {
    const int aggregate = aggregates.of_slot(slot_of(spring.dofs[i]));
    if (aggregate < 0) continue;
    const auto row = aggregates.mode_row(spring.dofs[i]);
    for (int k = 0; k < aggregates.mode_count(aggregate); ++k)
      sum[aggregates.first_mode(aggregate) + k] += spring.weights[i] * row[static_cast<std::size_t>(k)];
  }
  return sum;
}

/// True for springs that differ by so little that the factor of one set serves the other.
bool alike(const std::vector<Spring>& some, const std::vector<Spring>& others) {
  constexpr double kLittle = 0.01;
  const auto near = [](double a, double b, double size) { return std::abs(a - b) <= kLittle * size; };
  return std::ranges::equal(some, others, [&](const Spring& a, const Spring& b) {
    return near(a.stiffness, b.stiffness, a.stiffness) && a.dofs == b.dofs &&
           std::ranges::equal(a.weights, b.weights, [&](double v, double w) { return near(v, w, 1); });
  });
}

}  // namespace

void CoarseSolver::factorise(const Aggregates& aggregates, const std::vector<Spring>& springs) {
  if (matrices_->springs && alike(*matrices_->springs, springs)) return;
  matrices_->springs = springs;
  std::vector<Eigen::Triplet<double>> entries;
  for (const Spring& spring : springs) {
    const auto weights = on_modes(aggregates, spring);
    for (const auto& [column, w] : weights)
      for (auto row = weights.find(column); row != weights.end(); ++row)
        entries.emplace_back(row->first, column, spring.stiffness * w * row->second);
  }
  SparseMatrix matrix(matrices_->base.rows(), matrices_->base.cols());
  matrix.setFromTriplets(entries.begin(), entries.end());
  matrix += matrices_->base;
  constexpr double kHold = 1e-12;
  for (int i = 0; i < matrix.rows(); ++i) matrix.coeffRef(i, i) *= 1 + kHold;
  if (!matrices_->factor.compute(matrix))
    throw NumericalError(
        "static solver: the coarse matrix could not be factorised; a body is unrestrained or a stiffness is "
        "negative or not a number");
}

void CoarseSolver::solve(const double* r, double* y) const {
  matrices_->factor.solve(r, y);
}

}  // namespace tread
