#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/parallel/chunks.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/solver/two_level_preconditioner.hpp"
#include "tests/solved_system.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

using Field = AlignedVector<double>;

std::int64_t size_of(const Field& field) {
  return static_cast<std::int64_t>(field.size());
}

/// Elasticity of a mesh on the unknowns whose diagonal is not zero.
struct Elastic {
  explicit Elastic(const Mesh& mesh) : force(mesh), diagonal(static_cast<std::size_t>(3 * mesh.slots), 0.0) {
    force.diagonal(diagonal.data());
  }
  void fix(std::int64_t unknown) { diagonal[static_cast<std::size_t>(unknown)] = 0; }
  Operator with(const std::vector<Spring>& springs = {}) const {
    return [this, springs](const double* x, double* y) {
      force.apply(x, y);
      add_springs(springs, x, y);
      for (std::size_t i = 0; i < diagonal.size(); ++i)
        if (diagonal[i] == 0) y[i] = 0;
    };
  }
  void restrict_to_free(Field& field) const {
    for (std::size_t i = 0; i < field.size(); ++i)
      if (diagonal[i] == 0) field[i] = 0;
  }

  InternalForce force;
  Field diagonal;
};

void fix_station(const SweptBlock& block, int station, Elastic& elastic) {
  for (int node = 0; node < block.section.nodes(); ++node)
    for (int c = 0; c < 3; ++c) elastic.fix(dof(block.base + block.slot(node, station), c));
}

double distance(const Field& a, const Field& b) {
  Field difference = a;
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= b[i];
  return std::sqrt(dot(size_of(a), difference.data(), difference.data()) /
                   dot(size_of(b), b.data(), b.data()));
}

std::vector<double> random_modes(int count) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) values.push_back(std::sin(1 + 2.3 * i * i));
  return values;
}

/// Small aggregates, so that small meshes have many of them.
TwoLevelOptions small_aggregates() {
  TwoLevelOptions options;
  options.aggregates = {0.02, 4, 2};
  return options;
}

Mesh bar_and_ring() {
  Mesh mesh;
  mesh.add(samples::extruded());
  mesh.add(samples::revolved_closed());
  mesh.add(samples::revolved_open());
  return mesh;
}

TEST(Chunks, SumsAreTheSameBitsForAnyNumberOfThreads) {
  const auto n = 5 * kChunk + 13;
  Field a(static_cast<std::size_t>(n)), b(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = std::sin(static_cast<double>(i));
    b[i] = std::cos(3.0 * static_cast<double>(i));
  }
  const double one = dot(n, a.data(), b.data());
  double plain = 0;
  for (std::size_t i = 0; i < a.size(); ++i) plain += a[i] * b[i];
  for (const int count : {2, 3}) {
    set_threads(count);
    EXPECT_EQ(dot(n, a.data(), b.data()), one);
  }
  set_threads(1);
  EXPECT_NEAR(one, plain, 1e-10 * static_cast<double>(n));
}

TEST(Aggregates, ModesAreOrthonormalAndTransposed) {
  const Mesh mesh = bar_and_ring();
  Elastic elastic(mesh);
  fix_station(mesh.blocks[0], 3, elastic);
  for (std::int64_t slot = 0; slot < 40; ++slot) elastic.fix(dof(slot, static_cast<int>(slot % 3)));
  const Aggregates aggregates(mesh, elastic.diagonal, small_aggregates().aggregates);
  ASSERT_GT(aggregates.count(), 20);

  const auto coarse = random_modes(aggregates.modes());
  Field fine(elastic.diagonal.size(), 0.0);
  aggregates.prolongate_add(coarse.data(), fine.data());
  Field masked = fine;
  elastic.restrict_to_free(masked);
  EXPECT_EQ(fine, masked);

  std::vector<double> back(coarse.size());
  aggregates.restrict_to_modes(fine.data(), back.data());
  for (std::size_t i = 0; i < coarse.size(); ++i) EXPECT_NEAR(back[i], coarse[i], 1e-10);
  const Field other = samples::random_field(mesh);
  aggregates.restrict_to_modes(other.data(), back.data());
  double product = 0;
  for (std::size_t i = 0; i < coarse.size(); ++i) product += back[i] * coarse[i];
  EXPECT_NEAR(product, dot(size_of(fine), other.data(), fine.data()), 1e-15);
}

TEST(Aggregates, AreCountedWithoutTheirModes) {
  const Mesh mesh = bar_and_ring();
  const Field free(static_cast<std::size_t>(3 * mesh.slots), 1.0);
  const AggregateOptions options = small_aggregates().aggregates;
  EXPECT_EQ(aggregate_count(mesh, options), Aggregates(mesh, free, options).count());
}

TEST(Aggregates, ContainRigidMotions) {
  const Mesh mesh = bar_and_ring();
  const Elastic elastic(mesh);
  const Aggregates aggregates(mesh, elastic.diagonal, small_aggregates().aggregates);
  const Vec3 shift{0.3, -1.2, 0.7}, turn{2, -3, 5};
  const Field rigid = samples::sample(mesh, [&](const Vec3& at) { return shift + cross(turn, at); });
  std::vector<double> coarse(static_cast<std::size_t>(aggregates.modes()));
  aggregates.restrict_to_modes(rigid.data(), coarse.data());
  Field projected(rigid.size(), 0.0);
  aggregates.prolongate_add(coarse.data(), projected.data());
  EXPECT_LT(distance(projected, rigid), 1e-12);
}

TEST(Aggregates, LeaveOutMotionsThatTheirUnknownsCannotShow) {
  Mesh mesh;
  mesh.add(samples::extruded());
  Elastic elastic(mesh);
  for (std::int64_t slot = 0; slot < mesh.slots; ++slot)
    for (const int c : {0, 1}) elastic.fix(dof(slot, c));
  const Aggregates vertical(mesh, elastic.diagonal, {0.02, 4, 2});
  for (int a = 0; a < vertical.count(); ++a) EXPECT_LE(vertical.mode_count(a), 3);  // z, about x, about y
  const Aggregates nodes(mesh, elastic.diagonal, {1e-4, 1, 1});
  EXPECT_EQ(nodes.count(), mesh.blocks[0].nodes());
  EXPECT_EQ(nodes.modes(), nodes.count());
}

TEST(Colours, DifferWithinTwoEdges) {
  const Mesh mesh = bar_and_ring();
  const Elastic elastic(mesh);
  const Aggregates aggregates(mesh, elastic.diagonal, small_aggregates().aggregates);
  const auto graph = aggregate_graph(mesh, aggregates, {});
  const auto colour = distance_two_colours(graph);
  for (const auto& neighbours : graph)
    for (const int a : neighbours)
      for (const int b : neighbours)
        if (a != b) {
          EXPECT_NE(colour[static_cast<std::size_t>(a)], colour[static_cast<std::size_t>(b)]);
        }
}

TEST(CoarseSolver, InvertsTheOperatorOnTheModes) {
  const Mesh mesh = bar_and_ring();
  Elastic elastic(mesh);
  for (const SweptBlock& block : mesh.blocks) fix_station(block, 0, elastic);
  const Aggregates aggregates(mesh, elastic.diagonal, small_aggregates().aggregates);
  // A spring from the bar to the ring, one of its ends at a fixed unknown.
  const std::vector<Spring> springs{
      {1e9,
       {dof(mesh.blocks[0].slot(2, 20), 1), dof(mesh.blocks[1].base + mesh.blocks[1].slot(5, 9), 2),
        dof(mesh.blocks[1].base + mesh.blocks[1].slot(5, 0), 0)},
       {0.6, -0.9, 0.4}}};
  CoarseSolver solver(aggregates, aggregate_graph(mesh, aggregates, {}), elastic.with(), 3 * mesh.slots);
  solver.factorise(aggregates, springs);

  const auto wanted = random_modes(aggregates.modes());
  Field x(elastic.diagonal.size(), 0.0), y(x.size());
  aggregates.prolongate_add(wanted.data(), x.data());
  elastic.with(springs)(x.data(), y.data());
  std::vector<double> coarse(wanted.size());
  aggregates.restrict_to_modes(y.data(), coarse.data());
  solver.solve(coarse.data(), coarse.data());
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(coarse[i], wanted[i], 1e-7);
}

/// A hundredth of a spring does not matter to a preconditioner.
TEST(CoarseSolver, FactorisesAnewForOtherSprings) {
  const Mesh mesh = bar_and_ring();
  Elastic elastic(mesh);
  for (const SweptBlock& block : mesh.blocks) fix_station(block, 0, elastic);
  const Aggregates aggregates(mesh, elastic.diagonal, small_aggregates().aggregates);
  CoarseSolver solver(aggregates, aggregate_graph(mesh, aggregates, {}), elastic.with(), 3 * mesh.slots);
  const auto solution = [&](double stiffness, double weight, int node) {
    solver.factorise(
        aggregates,
        {{stiffness,
          {dof(mesh.blocks[0].slot(node, 20), 1), dof(mesh.blocks[1].base + mesh.blocks[1].slot(5, 9), 2)},
          {weight, -0.9}}});
    auto x = random_modes(aggregates.modes());
    solver.solve(x.data(), x.data());
    return x;
  };
  const auto first = solution(1e9, 0.6, 2);
  EXPECT_EQ(solution(1.005e9, 0.6, 2), first);
  EXPECT_EQ(solution(1e9, 0.605, 2), first);
  EXPECT_NE(solution(1.05e9, 0.6, 2), first);
  EXPECT_NE(solution(1e9, 0.7, 2), first);
  EXPECT_NE(solution(1e9, 0.6, 3), first);
}

TEST(CoarseSolver, SeesTiesAndRefusesCouplingsItWasNotTold) {
  Mesh mesh;
  mesh.add(samples::extruded());
  mesh.add(samples::extruded());
  Elastic elastic(mesh);
  std::vector<TiedSlot> ties;
  for (int station = 4; station < 30; station += 2) {
    const SweptBlock& bar = mesh.blocks[0];
    const std::int64_t secondary = mesh.blocks[1].base + bar.slot(1, station);
    ties.push_back({secondary, bar.slot(1, station)});
    ties.push_back({secondary, bar.slot(2, station + 1)});
    for (int c = 0; c < 3; ++c) elastic.fix(dof(secondary, c));
  }
  const Operator tied = [&](const double* x, double* y) {
    Field full(x, x + 3 * mesh.slots);
    for (const auto& [secondary, primary] : ties)
      for (int c = 0; c < 3; ++c)
        full[static_cast<std::size_t>(dof(secondary, c))] += 0.5 * x[dof(primary, c)];
    elastic.force.apply(full.data(), y);
    for (const auto& [secondary, primary] : ties)
      for (int c = 0; c < 3; ++c) y[dof(primary, c)] += 0.5 * y[dof(secondary, c)];
    for (const TiedSlot& tie : ties)
      for (int c = 0; c < 3; ++c) y[dof(tie.secondary, c)] = 0;
  };
  const Aggregates aggregates(mesh, elastic.diagonal, small_aggregates().aggregates);
  EXPECT_NO_THROW(CoarseSolver(aggregates, aggregate_graph(mesh, aggregates, ties), tied, 3 * mesh.slots));
  EXPECT_THROW(CoarseSolver(aggregates, aggregate_graph(mesh, aggregates, {}), tied, 3 * mesh.slots),
               NumericalError);
}

TEST(TwoLevelPreconditioner, IsSymmetricAndPositive) {
  const Mesh mesh = bar_and_ring();
  Elastic elastic(mesh);
  for (const SweptBlock& block : mesh.blocks) fix_station(block, 0, elastic);
  TwoLevelPreconditioner preconditioner(mesh, elastic.with(), elastic.diagonal, {}, small_aggregates());
  preconditioner.update(elastic.with(), {});
  Field a = samples::random_field(mesh, 5), b = samples::random_field(mesh, 6), ba(a.size()), bb(a.size());
  elastic.restrict_to_free(a);
  elastic.restrict_to_free(b);
  preconditioner.apply(a.data(), ba.data());
  preconditioner.apply(b.data(), bb.data());
  const double aa = dot(size_of(a), a.data(), ba.data());
  EXPECT_GT(aa, 0);
  EXPECT_NEAR(dot(size_of(a), a.data(), bb.data()), dot(size_of(a), b.data(), ba.data()), 1e-10 * aa);
  Field masked = ba;
  elastic.restrict_to_free(masked);
  EXPECT_EQ(ba, masked);
}

TEST(ConjugateGradients, FindsTheSolutionOfAClampedBar) {
  Mesh mesh;
  mesh.add(samples::extruded());
  Elastic elastic(mesh);
  fix_station(mesh.blocks[0], 0, elastic);
  Field wanted = samples::random_field(mesh), b(wanted.size()), x(wanted.size(), 0.0);
  elastic.restrict_to_free(wanted);
  elastic.with()(wanted.data(), b.data());
  TwoLevelPreconditioner two_level(mesh, elastic.with(), elastic.diagonal, {}, small_aggregates());
  two_level.update(elastic.with(), {});
  const auto result = samples::solve_system(elastic.with(), &two_level, nullptr, b, x, {1e-12, 500});
  EXPECT_TRUE(result.result.converged);
  EXPECT_LT(result.relative_residual, 1e-11);
  EXPECT_EQ(result.result.residual_history.size(), static_cast<std::size_t>(result.iterations) + 1);
  EXPECT_LT(distance(x, wanted), 1e-9);

  const JacobiPreconditioner jacobi(elastic.diagonal);
  Field plain(x.size(), 0.0);
  const auto slow = samples::solve_system(elastic.with(), &jacobi, nullptr, b, plain, {1e-12, 5000});
  EXPECT_LT(distance(plain, wanted), 1e-8);
  EXPECT_GT(slow.iterations, 3 * result.iterations);
  EXPECT_FALSE(
      samples::solve_system(elastic.with(), nullptr, nullptr, b, plain, {1e-30, 3}).result.converged);
}

TEST(ConjugateGradients, StartsFromTheGivenVectorAndSolvesForNoLoad) {
  Mesh mesh;
  mesh.add(samples::extruded());
  Elastic elastic(mesh);
  fix_station(mesh.blocks[0], 0, elastic);
  const JacobiPreconditioner jacobi(elastic.diagonal);
  Field wanted = samples::random_field(mesh), b(wanted.size());
  elastic.restrict_to_free(wanted);
  elastic.with()(wanted.data(), b.data());
  Field x = wanted;
  EXPECT_EQ(samples::solve_system(elastic.with(), &jacobi, nullptr, b, x, {1e-9, 10}).iterations, 0);
  EXPECT_EQ(x, wanted);
  std::fill(b.begin(), b.end(), 0.0);
  std::fill(x.begin(), x.end(), 0.0);
  CgVectors vectors;
  EXPECT_TRUE(conjugate_gradients(elastic.with(), &jacobi, nullptr, b, x, {}, vectors).converged);
  EXPECT_EQ(dot(size_of(x), x.data(), x.data()), 0);
}

TEST(ConjugateGradients, IsTheSameBitsForAnyNumberOfThreads) {
  const Mesh mesh = bar_and_ring();
  Elastic elastic(mesh);
  for (const SweptBlock& block : mesh.blocks) fix_station(block, 0, elastic);
  Field b = samples::random_field(mesh);
  elastic.restrict_to_free(b);
  Field first;
  for (const int count : {1, 2, 3}) {
    set_threads(count);
    TwoLevelPreconditioner preconditioner(mesh, elastic.with(), elastic.diagonal, {}, small_aggregates());
    preconditioner.update(elastic.with(), {});
    Field x(b.size(), 0.0);
    samples::solve_system(elastic.with(), &preconditioner, nullptr, b, x, {1e-4, 100});
    if (first.empty()) first = x;
    EXPECT_EQ(x, first);
  }
  set_threads(1);
}

/// A free ring pushed and turned: its six rigid motions are held in the mass-weighted mean.
TEST(HeldMotions, CarryTheLoadsOfAFreeBody) {
  Mesh mesh;
  mesh.add(samples::revolved_closed());
  const Elastic elastic(mesh);
  std::vector<Field> motions, means;
  std::vector<RigidMotion> rigid;
  std::vector<double> mass(static_cast<std::size_t>(mesh.slots));
  elastic.force.lumped_mass(mass.data());
  for (int k = 0; k < 6; ++k) {
    Vec3 unit;
    unit[k % 3] = 1;
    motions.push_back(samples::sample(mesh, [&](const Vec3& at) { return k < 3 ? unit : cross(unit, at); }));
    means.push_back(motions.back());
    rigid.push_back(k < 3 ? RigidMotion{unit, {}} : RigidMotion{{}, unit});
    for (std::int64_t slot = 0; slot < mesh.slots; ++slot)
      for (int c = 0; c < 3; ++c)
        means.back()[static_cast<std::size_t>(dof(slot, c))] *= mass[static_cast<std::size_t>(slot)];
  }
  const HeldMotions held(mesh, {0}, mass.data(), rigid);
  Field b(motions[0].size(), 0.0);
  b[static_cast<std::size_t>(dof(mesh.blocks[0].slot(4, 3), 0))] = 700;
  b[static_cast<std::size_t>(dof(mesh.blocks[0].slot(6, 11), 1))] = -300;

  TwoLevelPreconditioner preconditioner(mesh, elastic.with(), elastic.diagonal, {}, small_aggregates());
  preconditioner.update(elastic.with(), {});
  Field x(b.size(), 0.0);
  const auto result = samples::solve_system(elastic.with(), &preconditioner, &held, b, x, {1e-11, 500});
  EXPECT_TRUE(result.result.converged);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(dot(size_of(x), means[k].data(), x.data()), 0, 1e-18);
    EXPECT_NEAR(result.reactions[k], dot(size_of(b), motions[k].data(), b.data()), 1e-6);
  }
  // The remainder is the unbalanced load spread like the means: a rigid acceleration.
  Field rest(b.size());
  elastic.with()(x.data(), rest.data());
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = b[i] - rest[i];
  held.balance(rest.data());
  EXPECT_LT(std::sqrt(dot(size_of(rest), rest.data(), rest.data())), 1e-7);
}

TEST(HeldMotions, RefuseAMeanThatDoesNotSeeItsMotion) {
  Mesh mesh;
  mesh.add(samples::revolved_closed());
  const std::vector<double> mass(static_cast<std::size_t>(mesh.slots), 1.0), none(mass.size(), 0.0);
  const RigidMotion ahead{{1, 0, 0}, {}}, turn{{}, {0, 1, 0}};
  EXPECT_NO_THROW(HeldMotions(mesh, {0}, mass.data(), {ahead, turn}));
  EXPECT_THROW(HeldMotions(mesh, {0}, none.data(), {ahead}), NumericalError);
  EXPECT_THROW(HeldMotions(mesh, {0}, mass.data(), {ahead, turn, 2 * ahead}), NumericalError);
}

TEST(ConjugateGradients, ReportsABodyWithoutRestraint) {
  Mesh mesh;
  mesh.add(samples::extruded());
  const Elastic elastic(mesh);
  const JacobiPreconditioner jacobi(elastic.diagonal);
  Field push = samples::sample(mesh, [](const Vec3&) { return Vec3{1, 0, 0}; });
  Field x(push.size(), 0.0);
  EXPECT_FALSE(
      samples::solve_system(elastic.with(), &jacobi, nullptr, push, x, {1e-9, 1000}).result.converged);
  // The first search direction of this load is the rigid motion itself.
  for (std::size_t i = 0; i < push.size(); ++i) push[i] *= elastic.diagonal[i];
  std::fill(x.begin(), x.end(), 0.0);
  EXPECT_THROW(samples::solve_system(elastic.with(), &jacobi, nullptr, push, x, {1e-9, 1000}),
               NumericalError);
}

}  // namespace
}  // namespace tread
