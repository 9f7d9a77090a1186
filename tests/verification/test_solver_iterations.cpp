// Iterations of the two-level solver against theory: bounded by element and aggregate sizes, not by
// slenderness.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/parallel/parallel.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/solver/two_level_preconditioner.hpp"
#include "tests/solved_system.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

using Field = AlignedVector<double>;

/// Coordinates without unit from `start`: `count` steps that grow by `growth`.
std::vector<double> graded(double start, double step, double growth, int count) {
  std::vector<double> at{start};
  for (int i = 0; i < count; ++i, step *= growth) at.push_back(at.back() + step);
  return at;
}

Section tensor_section(const std::vector<double>& p, const std::vector<double>& q) {
  Section section;
  const int columns = static_cast<int>(p.size());
  for (const double y : q)
    for (const double x : p) {
      section.p.push_back(x);
      section.q.push_back(y);
    }
  for (int j = 0; j + 1 < static_cast<int>(q.size()); ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const int node = j * columns + i;
      section.quads.push_back({node, node + 1, node + columns + 1, node + columns});
      section.quad_material.push_back(0);
    }
  return section;
}

struct Problem {
  Mesh mesh;
  std::vector<std::int64_t> fixed;
  std::vector<Spring> springs;
  Field load;
};

struct Iterations {
  int two_level = 0;
  int jacobi = 0;  ///< Jacobi's iterations, cut off at twenty times as many
};

Iterations solve(const Problem& problem, bool with_jacobi) {
  const InternalForce force(problem.mesh);
  Field diagonal(problem.load.size(), 0.0);
  force.diagonal(diagonal.data());
  for (const std::int64_t unknown : problem.fixed) diagonal[static_cast<std::size_t>(unknown)] = 0;
  const Operator elastic = [&](double* x, double* y) {
    force.apply(x, y);
    for (const std::int64_t unknown : problem.fixed) y[unknown] = 0;
  };
  const Operator full = [&](double* x, double* y) {
    elastic(x, y);
    add_springs(problem.springs, x, y);
  };
  constexpr double kTolerance = 1e-9;
  Iterations iterations;
  TwoLevelPreconditioner preconditioner(problem.mesh, elastic, diagonal, {});
  preconditioner.update(full, problem.springs);
  Field x(problem.load.size(), 0.0);
  const auto result =
      samples::solve_system(full, &preconditioner, nullptr, problem.load, x, {kTolerance, 2000});
  EXPECT_TRUE(result.result.converged);
  EXPECT_LT(result.relative_residual, 2 * kTolerance);
  iterations.two_level = result.iterations;
  if (with_jacobi) {
    for (const Spring& spring : problem.springs)
      for (std::size_t i = 0; i < spring.dofs.size(); ++i)
        diagonal[static_cast<std::size_t>(spring.dofs[i])] +=
            spring.stiffness * spring.weights[i] * spring.weights[i];
    const JacobiPreconditioner jacobi(diagonal);
    std::fill(x.begin(), x.end(), 0.0);
    iterations.jacobi =
        samples::solve_system(full, &jacobi, nullptr, problem.load, x, {kTolerance, 20 * result.iterations})
            .iterations;
  }
  return iterations;
}

/// A box rail 70 x 170 mm on soft springs every 0.65 m. Layers are 3 mm thick on top; stations are 2 mm apart
/// around the load and 25 mm beyond.
Problem rail(double length) {
  Problem problem;
  auto q = graded(0, 0.003, 1.0, 2);
  for (const double z : graded(q.back(), 0.005, 1.6, 5)) q.push_back(z);
  q.erase(q.begin() + 3);
  while (q.back() < 0.17) q.push_back(std::min(0.17, q.back() + 0.025));
  for (double& z : q) z = -z;
  std::reverse(q.begin(), q.end());
  const int coarse = static_cast<int>(0.5 * (length - 0.2) / 0.025);
  problem.mesh.add(make_swept_block("rail", Sweep::extruded, tensor_section(graded(-0.035, 0.00875, 1, 8), q),
                                    {samples::steel()}, 0,
                                    {{coarse, 0.025, 0}, {100, 0.002, 0}, {coarse, 0.025, 0}}));
  const SweptBlock& block = problem.mesh.blocks[0];
  problem.load.assign(static_cast<std::size_t>(3 * problem.mesh.slots), 0.0);
  const double foot = q.front();
  double next = 0.1;
  for (int station = 0; station < block.station_count(); ++station) {
    const bool fastening = block.stations[static_cast<std::size_t>(station)] >= next;
    if (fastening) next += 0.65;
    for (int node = 0; node < block.section.nodes(); ++node) {
      const std::int64_t slot = block.slot(node, station);
      if (station == 0 || station + 1 == block.station_count()) problem.fixed.push_back(dof(slot, 0));
      if (!fastening || block.section.q[static_cast<std::size_t>(node)] > foot) continue;
      problem.springs.push_back({22e6 / 9, {dof(slot, 2)}, {1.0}});
      problem.fixed.push_back(dof(slot, 1));
    }
  }
  const int top = block.section.nodes() - 5;
  problem.load[static_cast<std::size_t>(dof(block.slot(top, coarse + 50), 2))] = -1e5;
  return problem;
}

/// Adds contact points over four nodes, `ratio` times as stiff as an element.
void add_penalties(Problem& problem, double ratio) {
  const SweptBlock& block = problem.mesh.blocks[0];
  const int station = block.station_count() / 2;
  for (int i = 2; i < 7; ++i) {
    Spring spring{ratio * 2e11 * 0.003, {}, {}};
    const int node = block.section.nodes() - 9 + i;
    for (const int at : {station, station + 1})
      for (const int end : {node, node + 1})
        for (const int c : {1, 2}) {
          spring.dofs.push_back(dof(block.slot(end, at), c));
          spring.weights.push_back(c == 1 ? 0.01 : 0.25);
        }
    problem.springs.push_back(std::move(spring));
  }
}

TEST(SolverIterations, DoNotGrowWithTheRailsLength) {
  set_threads(2);
  const int short_rail = solve(rail(1.5), false).two_level;
  const Iterations long_rail = solve(rail(15), true);
  RecordProperty("rail_1.5m", short_rail);
  RecordProperty("rail_15m", long_rail.two_level);
  EXPECT_LT(long_rail.two_level, 1.2 * short_rail + 5);
  EXPECT_LT(long_rail.two_level, 150);
  EXPECT_EQ(long_rail.jacobi, 20 * long_rail.two_level);
}

TEST(SolverIterations, StayBoundedForStiffContact) {
  set_threads(2);
  const int without = solve(rail(4), false).two_level;
  for (const auto& [ratio, factor] : {std::pair{5.0, 1.3}, std::pair{1000.0, 4.0}}) {
    Problem problem = rail(4);
    add_penalties(problem, ratio);
    const int with = solve(problem, false).two_level;
    RecordProperty("penalty_" + std::to_string(static_cast<int>(ratio)), with);
    EXPECT_LT(with, factor * without);
  }
}

/// A disc 12 mm thick between radii 80 and 430 mm, clamped at the hub and loaded out of its plane.
TEST(SolverIterations, StayBoundedForAThinDisc) {
  set_threads(2);
  Problem problem;
  auto radius = graded(0.08, 0.02, 1, 16);
  for (const double r : graded(radius.back() + 0.01, 0.0025, 1, 8)) radius.push_back(r);
  constexpr int kStations = 240;
  problem.mesh.add(make_swept_block("disc", Sweep::revolved, tensor_section({-0.006, 0, 0.006}, radius),
                                    {samples::steel()}, 0,
                                    {{kStations, 2 * std::numbers::pi / kStations, 0}}));
  const SweptBlock& block = problem.mesh.blocks[0];
  for (int station = 0; station < block.station_count(); ++station)
    for (int node = 0; node < 3; ++node)
      for (int c = 0; c < 3; ++c) problem.fixed.push_back(dof(block.slot(node, station), c));
  problem.load.assign(static_cast<std::size_t>(3 * problem.mesh.slots), 0.0);
  const int rim = block.section.nodes() - 2;
  problem.load[static_cast<std::size_t>(dof(block.slot(rim, 0), 2))] = -1e5;
  problem.load[static_cast<std::size_t>(dof(block.slot(rim, 0), 1))] = 3e3;
  const Iterations iterations = solve(problem, true);
  RecordProperty("disc", iterations.two_level);
  EXPECT_LT(iterations.two_level, 150);
  EXPECT_EQ(iterations.jacobi, 20 * iterations.two_level);
}

}  // namespace
}  // namespace tread
