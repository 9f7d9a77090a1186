// Pressure and friction of few points against closed forms: one point, two on a common node, five in a row.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/aligned.hpp"
#include "core/parallel/parallel.hpp"
#include "kernels/contact/patch_point_body.hpp"
#include "kernels/contact/patch_solver.hpp"

namespace tread {
namespace {

constexpr double kDt = 1e-7;       // [s]
constexpr double kPenalty = 4e14;  // [Pa/m]
constexpr double kArea = 4e-7;     // of a point [m2]
constexpr double kFriction = 0.4;
constexpr int kWheel = 32;       // first slot of the wheel's nodes, if not stated
constexpr double kLight = 2e-6;  // [kg]
/// The solver stops when no traction changes by more than 1e-6 of the largest pressure.
constexpr double kSolved = 1e-5;

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// A node of a surface and its weight in a point.
using Weighted = std::vector<std::pair<int, double>>;

/// Points between nodes of two bodies. Normal: z; along: x; across: y.
class Patch {
 public:
  /// With `nodes` nodes on each body, the wheel's after the rail's.
  explicit Patch(int nodes = kWheel, std::size_t room = 16)
      : wheel_(nodes), u_(index(6 * nodes), 0.0), v_(u_.size(), 0.0), mass_(index(2 * nodes), kLight) {
    solver_.reserve(2 * nodes, room, index(2 * nodes));
  }

  void set_mass(std::int64_t slot, double mass) { mass_[index(slot)] = mass; }
  void set_velocity(std::int64_t slot, const Vec3& v) {
    for (int c = 0; c < 3; ++c) v_[index(dof(slot, c))] = v[c];
  }
  Vec3 velocity(std::int64_t slot) const { return ConstNodeField(v_.data()).at(slot); }
  Vec3 displacement(std::int64_t slot) const { return ConstNodeField(u_.data()).at(slot); }

  /// A point with this gap [m], on nodes of the rail and of the wheel.
  ContactPoint& add(double gap, const Weighted& rail, const Weighted& wheel) {
    ContactPoint point{};
    place(point.rail, rail, 0);
    place(point.wheel, wheel, wheel_);
    // At this angle the local components (t, y, r) are (-x, y, -z).
    point.wheel_cosine.fill(1);
    point.wheel_sine.fill(0);
    point.normal = {0, 0, -1};
    point.along = {1, 0, 0};
    point.across = {0, 1, 0};
    point.area = kArea;
    point.gap = gap;
    point.history = static_cast<std::int64_t>(points.size());
    points.push_back(point);
    return points.back();
  }

  /// The whole wheel moves with this velocity.
  void solve(const Vec3& wheel_velocity, FrictionOf<CoulombFriction> law = {{kFriction}}) {
    BodyFrame wheel;
    wheel.velocity = wheel_velocity;
    Friction friction = std::move(law);
    solver_.solve(points, {penalty, {penalty}}, friction, wheel, {u_.data(), v_.data(), mass_.data()}, kDt);
  }

  int iterations() const { return solver_.iterations(); }
  double unsettled() const { return solver_.unsettled(); }

  double penalty = kPenalty;  ///< [Pa/m]
  std::vector<ContactPoint> points;

 private:
  /// On up to four nodes of one station, numbered from slot `first` on.
  static void place(SurfaceSupport& support, const Weighted& nodes, int first) {
    support.slot.fill(first + nodes.front().first);
    support.along[0] = 1;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      support.slot[k] = first + nodes[k].first;
      support.across[k] = nodes[k].second;
    }
  }

  int wheel_;  ///< first slot of the wheel's nodes
  AlignedVector<double> u_, v_, mass_;
  PatchSolver solver_;
};

/// Half the way by which a unit pressure on point j parts point i in a step, `shared` the sum over the nodes
/// of the products of both points' weights over the mass. [m/Pa]
double compliance(double shared) {
  return 0.5 * kDt * kDt * kArea * shared;
}

constexpr double kPair = 2 / kLight;  // of a rail node and a wheel node [1/kg]

TEST(PatchSolver, OnePointTakesThePressureOfTheMiddleOfTheStep) {
  Patch patch;
  const double gap = -1e-6;
  const double closing = 0.7;
  patch.add(gap, {{0, 1}}, {{0, 1}}).velocity_before = {0, 0, -0.2};
  patch.solve({0, 0, -closing}, {{0.0}});
  const double a = compliance(kPair);
  const double expected = -kPenalty * (gap - 0.5 * kDt * closing) / (1 + kPenalty * a);
  const ContactPoint& point = patch.points.front();
  EXPECT_NEAR(point.pressure, expected, 1e-12 * expected);
  // The impulse acts on both nodes, and their displacement is that of the whole step.
  const double impulse = kDt * kArea * expected;
  EXPECT_NEAR(patch.velocity(0).z, -impulse / kLight, 1e-12 * impulse / kLight);
  EXPECT_NEAR(patch.velocity(kWheel).z, -impulse / kLight, 1e-12 * impulse / kLight);  // r points down
  EXPECT_NEAR(patch.displacement(0).z, kDt * patch.velocity(0).z, 1e-25);
  // Mean of the closing speeds before and after.
  EXPECT_NEAR(point.closing_speed, 0.5 * (0.2 + closing - 2 * impulse / kLight), 1e-12);
}

TEST(PatchSolver, APointThatOpensReleasesAllTraction) {
  Patch patch;
  ContactPoint& before = patch.add(2e-8, {{0, 1}}, {{0, 1}});
  before.shear_before = {1e8, -2e8};
  before.pressure_before = 1e9;
  before.velocity_before = {0, 0, 0.4};
  patch.solve({0, 0, 0.5});
  const ContactPoint& point = patch.points.front();
  EXPECT_EQ(point.pressure, 0);
  EXPECT_EQ(point.shear.along, 0);
  EXPECT_EQ(point.shear.across, 0);
  EXPECT_EQ(norm(patch.velocity(0)), 0);
}

TEST(PatchSolver, OnePointSticksByTheSpringOfTheMiddleOfTheStep) {
  Patch patch;
  ContactPoint& before = patch.add(-2e-6, {{0, 1}}, {{0, 1}});
  before.shear_before = {3e7, 1e7};
  before.velocity_before = {0.2, 0, 0};
  const Vec3 speed{0.4, -0.3, 0};
  patch.solve(speed);
  const ContactPoint& point = patch.points.front();
  const double a = compliance(kPair);
  const auto stuck = [&](double tau, double from, double to) {
    return (tau + kPenalty * kDt * 0.5 * (from + to)) / (1 + kPenalty * a);
  };
  const double pressure = kPenalty * 2e-6 / (1 + kPenalty * a);
  EXPECT_FALSE(point.slips);
  EXPECT_NEAR(point.pressure, pressure, kSolved * pressure);
  EXPECT_NEAR(point.shear.along, stuck(3e7, 0.2, 0.4), kSolved * pressure);
  EXPECT_NEAR(point.shear.across, stuck(1e7, 0, -0.3), kSolved * pressure);
}

TEST(PatchSolver, OnePointSlipsAtTheLimitAlongItsTrialTraction) {
  Patch patch;
  patch.add(-2e-6, {{0, 1}}, {{0, 1}}).velocity_before = {30, 40, 0};
  patch.solve({30, 40, 0});
  const ContactPoint& point = patch.points.front();
  EXPECT_TRUE(point.slips);
  EXPECT_NEAR(point.shear.along, 0.6 * kFriction * point.pressure, 1e-9 * point.pressure);
  EXPECT_NEAR(point.shear.across, 0.8 * kFriction * point.pressure, 1e-9 * point.pressure);
  // The slip speed is that of the motion with friction.
  const double change = kDt * kArea * kPair * kFriction * point.pressure;
  EXPECT_NEAR(point.slip_speed.along, 30 - 0.5 * 0.6 * change, kSolved * change);
}

TEST(PatchSolver, WithoutFrictionPointsSlipFreely) {
  Patch patch;
  patch.add(-2e-6, {{0, 1}}, {{0, 1}}).velocity_before = {1, 2, 0};
  patch.solve({3, 2, 0}, {{0.0}});
  EXPECT_EQ(patch.points.front().shear.along, 0);
  EXPECT_TRUE(patch.points.front().slips);
  EXPECT_DOUBLE_EQ(patch.points.front().slip_speed.along, 2);
  EXPECT_DOUBLE_EQ(patch.points.front().slip_speed.across, 2);
}

TEST(PatchSolver, TwoPointsOnACommonNodeSolveTheirTwoEquations) {
  Patch patch;
  const std::array gap{-1e-6, -1.6e-6};
  patch.add(gap[0], {{0, 1}}, {{0, 1}});
  patch.add(gap[1], {{0, 1}}, {{1, 1}});
  patch.set_mass(0, 3 * kLight);
  patch.solve({0, 0, -0.5}, {{0.0}});
  const double common = compliance(1 / (3 * kLight));
  const double own = common + compliance(1 / kLight) + 1 / kPenalty;
  // own p1 + common p2 = b1, common p1 + own p2 = b2
  const std::array b{-gap[0] + 0.5 * kDt * 0.5, -gap[1] + 0.5 * kDt * 0.5};
  const double determinant = own * own - common * common;
  const std::array p{(own * b[0] - common * b[1]) / determinant, (own * b[1] - common * b[0]) / determinant};
  EXPECT_NEAR(patch.points[0].pressure, p[0], kSolved * p[1]);
  EXPECT_NEAR(patch.points[1].pressure, p[1], kSolved * p[1]);
  // The coupling is not small: alone, either would carry more.
  EXPECT_GT(b[0] / own, 1.05 * p[0]);
}

TEST(PatchSolver, ACommonNodeLetsOnePointPushTheOtherOpen) {
  Patch patch;
  patch.add(-1e-8, {{0, 1}}, {{0, 1}});
  patch.add(-4e-6, {{0, 1}}, {{1, 1}});
  patch.set_mass(kWheel + 1, 1e3 * kLight);
  patch.solve({}, {{0.0}});
  EXPECT_EQ(patch.points[0].pressure, 0);
  const double a = compliance(1 / kLight + 1 / (1e3 * kLight));
  const double alone = kPenalty * 4e-6 / (1 + kPenalty * a);
  EXPECT_NEAR(patch.points[1].pressure, alone, kSolved * alone);
}

/// Five points in a row, each between two nodes of the rail and two of the wheel.
class Row {
 public:
  static constexpr int kPoints = 5;

  Row(std::array<double, kPoints> gap, std::array<double, kPoints> shear) : gap_(gap), shear_(shear) {
    Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(kPoints, 12);
    for (int i = 0; i < kPoints; ++i) {
      const double w = 0.3 + 0.1 * i;
      ContactPoint& point = patch_.add(gap[index(i)], {{i, 1 - w}, {i + 1, w}}, {{i, w}, {i + 1, 1 - w}});
      point.shear_before = {shear[index(i)], 0};
      point.velocity_before = kBefore;
      weight.row(i).segment(i, 2) << 1 - w, w;
      weight.row(i).segment(6 + i, 2) << w, 1 - w;
    }
    way_ = compliance(1 / kLight) * weight * weight.transpose();
  }

  const std::vector<ContactPoint>& solve() {
    patch_.solve(kSpeed);
    return patch_.points;
  }

  /// Pressures, then shears, from trying all 4^5 choices of open, stick, slip forwards, slip backwards.
  std::vector<Eigen::VectorXd> solutions() const {
    std::vector<Eigen::VectorXd> found;
    for (int choice = 0; choice < 1024; ++choice)
      if (const auto solution = try_states(choice)) found.push_back(*solution);
    return found;
  }

 private:
  enum State { open, stick, forwards, backwards };
  static constexpr Vec3 kBefore{1.5, 0, 0};
  static constexpr Vec3 kSpeed{2.5, 0, -1};

  static State state_of(int choice, int i) { return static_cast<State>(choice >> (2 * i) & 3); }
  /// Slip between both middles without contact in the step [m].
  static double free_slip() { return 0.5 * kDt * (kBefore.x + kSpeed.x); }

  std::optional<Eigen::VectorXd> try_states(int choice) const {
    constexpr int n = kPoints;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(2 * n);
    for (int i = 0; i < n; ++i) {
      const State state = state_of(choice, i);
      a(i, i) = a(n + i, n + i) = 1;
      if (state == open) continue;
      // p / eps + sum a p = -(g + dt/2 v_z)
      a.row(i).head(n) = kPenalty * way_.row(i);
      a(i, i) += 1;
      b(i) = kPenalty * trial_depth(i);
      if (state == stick) {
        a.row(n + i).tail(n) = kPenalty * way_.row(i);
        a(n + i, n + i) += 1;
        b(n + i) = shear_[index(i)] + kPenalty * free_slip();
      } else {
        a(n + i, i) = state == forwards ? -kFriction : kFriction;
      }
    }
    const Eigen::VectorXd x = a.partialPivLu().solve(b);
    for (int i = 0; i < n; ++i)
      if (!holds(state_of(choice, i), i, x)) return std::nullopt;
    return x;
  }

  double trial_depth(int i) const { return -gap_[index(i)] - 0.5 * kDt * kSpeed.z; }

  bool holds(State state, int i, const Eigen::VectorXd& x) const {
    constexpr int n = kPoints;
    const double pressure = x(i);
    if (state == open) return trial_depth(i) - way_.row(i).dot(x.head(n)) <= 0;
    if (pressure <= 0) return false;
    if (state == stick) return std::abs(x(n + i)) <= kFriction * pressure;
    // The stick would carry more than the limit.
    const double trial = shear_[index(i)] + kPenalty * (free_slip() - way_.row(i).dot(x.tail(n)));
    return state == forwards ? trial > x(n + i) : trial < x(n + i);
  }

  std::array<double, kPoints> gap_, shear_;
  Eigen::MatrixXd way_;  ///< half the way by which unit tractions move points in a step [m/Pa]
  Patch patch_;
};

TEST(PatchSolver, FivePointsInARowFindTheOnlyConsistentStates) {
  const std::array<double, 5> gap{2e-7, -5e-7, -3e-6, -1.5e-6, 1e-7};
  const std::array<double, 5> shear{0, -6e8, 1e8, 2e8, 0};
  Row row(gap, shear);
  const auto solutions = row.solutions();
  ASSERT_EQ(solutions.size(), 1u);
  const Eigen::VectorXd& expected = solutions.front();
  std::vector<ContactPoint> points(5);  // without traction where the solver removes a point
  for (const ContactPoint& point : row.solve()) points[index(point.history)] = point;
  const double largest = expected.head(5).maxCoeff();
  int open = 0;
  int sticking = 0;
  int slipping = 0;
  for (int i = 0; i < 5; ++i) {
    const ContactPoint& point = points[index(i)];
    EXPECT_NEAR(point.pressure, expected(i), kSolved * largest) << i;
    EXPECT_NEAR(point.shear.along, expected(5 + i), kSolved * largest) << i;
    EXPECT_NEAR(point.shear.across, 0, kSolved * largest) << i;
    if (expected(i) == 0) {
      ++open;
      continue;
    }
    const bool slips = std::abs(expected(5 + i)) >= kSlipping * kFriction * expected(i);
    EXPECT_EQ(point.slips, slips) << i;
    ++(slips ? slipping : sticking);
  }
  // The case shows all states.
  EXPECT_GE(open, 1);
  EXPECT_GE(sticking, 1);
  EXPECT_GE(slipping, 1);
}

TEST(PatchSolver, PointsThatPullTheirNodeBothWaysStillConverge) {
  // The sums of the rows of such points vanish, and what bounds the eigenvalues of usual surfaces does not
  // here.
  constexpr int kPoints = 8;
  Patch patch;
  for (int i = 0; i < kPoints; ++i) patch.add(-1e-6 * (1 + i % 3), {{0, i % 2 ? -1.0 : 1.0}}, {{i, 1e-3}});
  patch.solve({}, {{0.0}});
  double largest = 0;
  for (const ContactPoint& point : patch.points) largest = std::max(largest, point.pressure);
  int open = 0;
  for (const ContactPoint& point : patch.points) {
    const double gap = point.gap - kDt * point.closing_speed;  // at rest before: the mean of the step is half
    EXPECT_NEAR(point.pressure, std::max(0.0, -kPenalty * gap), kSolved * largest);
    if (point.pressure == 0) ++open;
  }
  EXPECT_LT(open, kPoints);
  EXPECT_LT(patch.iterations(), kMostIterations);  // it converged before the solver gave up
}

/// Velocities and pressures of a patch that is large enough for the threads to share it.
std::vector<double> bits_with(int number) {
  constexpr int kPoints = 5000;
  constexpr int kNodes = kPoints + 4;  // of both bodies: a multiple of the lanes
  const int before = threads();
  set_threads(number);
  Patch patch(kNodes, kPoints);
  for (int i = 0; i < kPoints; ++i) {
    ContactPoint& point =
        patch.add(-1e-9 * (i * 7919 % 2000 - 500), {{i, 0.4}, {i + 1, 0.6}}, {{i, 0.7}, {i + 1, 0.3}});
    point.velocity_before = {1e-3 * (i % 17), 0, 0};
  }
  patch.solve({2, 0.1, -0.3});
  set_threads(before);
  std::vector<double> values;
  for (const ContactPoint& point : patch.points)
    values.insert(values.end(),
                  {point.pressure, point.shear.along, point.shear.across, point.slip_speed.along});
  for (int slot = 0; slot < 2 * kNodes; ++slot) values.push_back(patch.velocity(slot).z);
  return values;
}

/// Three points a face of two nodes, gaps as of a wheel, a penalty far beyond the default. Momentum alone
/// goes round, and plain iterations alone take many more than are allowed.
/// A row of faces under a parabola of gaps, solved with this penalty [Pa/m].
Patch under_parabola(double penalty) {
  constexpr int kFaces = 20;
  Patch patch(kWheel, 3 * kFaces);
  patch.penalty = penalty;
  for (int i = 0; i < 3 * kFaces; ++i) {
    const double w = 0.5 + 0.387 * (i % 3 - 1);
    const double x = (i - 1.5 * kFaces) / (1.5 * kFaces);
    patch.add(3e-6 * (x * x - 0.6), {{i / 3, 1 - w}, {i / 3 + 1, w}}, {{i / 3, 1 - w}, {i / 3 + 1, w}});
  }
  patch.solve({2.5, 0, -1});
  return patch;
}

TEST(PatchSolver, AStiffPenaltySettles) {
  const Patch patch = under_parabola(100 * kPenalty);
  EXPECT_GT(patch.iterations(), kWithMomentum + kWithoutMomentum);
  EXPECT_LT(patch.iterations(), kMostIterations);
  EXPECT_EQ(patch.unsettled(), 0);
}

TEST(PatchSolver, TellsWhenItDoesNotSettle) {
  const Patch patch = under_parabola(1e8 * kPenalty);
  EXPECT_GT(patch.iterations(), kMostIterations);
  EXPECT_GT(patch.unsettled(), kUnsettled);
}

TEST(PatchSolver, AnyNumberOfThreadsGivesTheSameBits) {
  const std::vector<double> one = bits_with(1);
  EXPECT_GT(*std::max_element(one.begin(), one.end()), 0);
  for (const int number : {2, 3, 7}) EXPECT_EQ(bits_with(number), one) << number;
}

TEST(PatchSolver, PointsThatStayApartDoNotShowInTheBits) {
  const auto solve = [](bool with_open) {
    Patch patch;
    if (with_open) patch.add(2e-6, {{0, 0.5}, {1, 0.5}}, {{0, 1}});
    for (int i = 0; i < 3; ++i) {
      patch.add(-1e-6 * (1 + i), {{i, 0.4}, {i + 1, 0.6}}, {{i, 1}}).velocity_before = {2, 1, 0};
      if (with_open) patch.add(1e-6, {{i, 0.9}, {i + 1, 0.1}}, {{i + 1, 1}});
    }
    patch.solve({2, 1, -0.3});
    std::vector<double> values;
    for (const ContactPoint& point : patch.points) values.push_back(point.pressure);
    for (int slot = 0; slot < 8; ++slot) values.push_back(patch.velocity(slot).x);
    return values;
  };
  EXPECT_EQ(solve(true), solve(false));
}

TEST(PatchSolver, ImpulsesOnBothBodiesBalance) {
  Patch patch;
  for (int i = 0; i < 3; ++i) {
    ContactPoint& point = patch.add(-1e-6 * i, {{i, 0.4}, {i + 1, 0.6}}, {{i, 1}});
    point.velocity_before = {2, 1, 0};
  }
  patch.solve({2, 1, -0.3});
  Vec3 force;
  for (const ContactPoint& point : patch.points) force += point.area * point.traction();
  Vec3 rail;
  Vec3 wheel;
  for (int i = 0; i < 8; ++i) {
    rail += kLight * patch.velocity(i);
    wheel += kLight * globalise(1, 0, patch.velocity(kWheel + i));
  }
  EXPECT_NEAR(norm(rail - kDt * force), 0, 1e-12 * kDt * norm(force));
  EXPECT_NEAR(norm(wheel + kDt * force), 0, 1e-12 * kDt * norm(force));
}

}  // namespace
}  // namespace tread
