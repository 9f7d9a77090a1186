#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/body_frame.hpp"
#include "core/mesh/structured.hpp"
#include "kernels/update/body_motion.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// Rotation of a Cartesian vector about +y.
Vec3 rotate(const Vec3& a, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * a.x + s * a.z, a.y, -s * a.x + c * a.z};
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

TEST(BodyFrame, ConversionsAreThoseOfTheSweptBlocks) {
  const SweptBlock block = samples::revolved_closed();
  const Vec3 a{1, -2, 3};
  for (int station = 0; station < block.station_count(); ++station) {
    const double phi = block.stations[index(station)] + 0.4;
    expect_near(cylindrical_to_cartesian(phi, a), to_cartesian(block, station, 0.4, a), 1e-15);
    expect_near(cartesian_to_cylindrical(phi, a), to_local(block, station, 0.4, a), 1e-15);
    expect_near(cartesian_to_cylindrical(phi, cylindrical_to_cartesian(phi, a)), a, 1e-15);
  }
  // phi = 0 points down, phi = pi / 2 backwards: a wheel that rolls to +x brings the front down.
  expect_near(cylindrical_to_cartesian(0, {0, 0, 1}), {0, 0, -1}, 0);
  expect_near(cylindrical_to_cartesian(kTurn / 4, {0, 0, 1}), {-1, 0, 0}, 1e-15);
}

TEST(BodyFrame, TurnAndSpinAreAboutY) {
  const Vec3 a{1, -2, 3};
  for (const double phi : {0.0, 0.7, 3.0, -2.0}) {
    const Vec3 x = cylindrical_to_cartesian(phi, a);
    expect_near(cylindrical_to_cartesian(phi, turn(a, 0.3)), rotate(x, 0.3), 1e-14);
    expect_near(cylindrical_to_cartesian(phi, spin_cross(5, a)), cross({0, 5, 0}, x), 1e-14);
    // A node at angle phi, seen from one at phi + 0.3, is one vector with its components turned back.
    expect_near(cartesian_to_cylindrical(phi + 0.3, x), turn(a, -0.3), 1e-14);
  }
}

TEST(BodyFrame, AdvancesUniformly) {
  BodyFrame frame{{1, 2, 3}, {10, 0, -1}, 0.5, 200};
  frame.advance(1e-3);
  expect_near(frame.origin, {1.01, 2, 2.999}, 1e-15);
  EXPECT_DOUBLE_EQ(frame.angle, 0.7);
}

/// A closed ring with uneven masses, and the motion of its nodes in space.
class Ring : public testing::Test {
 protected:
  Ring() {
    mesh_.add(make_swept_block("ring", Sweep::revolved, rectangle(-0.02, 0.03, 2, 0.1, 0.16, 2),
                               {samples::steel()}, 0.3, {{19, kTurn / 19, 0}}));
    mass_.assign(index(mesh_.slots), 0.0);
    // All stations have equal masses, so the axis is a principal axis of inertia.
    samples::for_each_node(mesh_, [&](const SweptBlock&, int node, int, std::int64_t slot) {
      mass_[index(slot)] = 1 + 0.1 * node;
    });
    body_ = SpinningBody(mesh_, {0}, mass_.data());
  }

  struct State {
    std::vector<Vec3> position;  ///< positions at the step [m]
    std::vector<Vec3> velocity;  ///< velocities at the half step before [m/s]
  };

  State absolute(const AlignedVector<double>& u, const AlignedVector<double>& w, const BodyFrame& frame,
                 double dt) const {
    State state;
    samples::for_each_node(mesh_, [&](const SweptBlock& block, int node, int station, std::int64_t slot) {
      const Vec3 local{u[index(dof(slot, 0))], u[index(dof(slot, 1))], u[index(dof(slot, 2))]};
      const Vec3 rate{w[index(dof(slot, 0))], w[index(dof(slot, 1))], w[index(dof(slot, 2))]};
      const double phi = block.stations[index(station)];
      const Vec3 reference{0, block.section.p[index(node)], block.section.q[index(node)]};
      state.position.push_back(frame.origin + cylindrical_to_cartesian(phi + frame.angle, reference + local));
      const Vec3 arm = reference + local - 0.5 * dt * rate;
      state.velocity.push_back(frame.velocity +
                               cylindrical_to_cartesian(phi + frame.angle - 0.5 * dt * frame.spin,
                                                        rate + spin_cross(frame.spin, arm)));
    });
    return state;
  }

  /// Local field of a Cartesian function of the reference position in space at frame angle `angle`.
  template <class Field>
  AlignedVector<double> local_field(double angle, const Field& field) const {
    AlignedVector<double> values(index(3 * mesh_.slots), 0.0);
    samples::for_each_node(mesh_, [&](const SweptBlock& block, int node, int station, std::int64_t slot) {
      const double phi = block.stations[index(station)] + angle;
      const Vec3 at =
          cylindrical_to_cartesian(phi, {0, block.section.p[index(node)], block.section.q[index(node)]});
      const Vec3 local = cartesian_to_cylindrical(phi, field(at));
      for (int c = 0; c < 3; ++c) values[index(dof(slot, c))] = local[c];
    });
    return values;
  }

  Mesh mesh_;
  std::vector<double> mass_;
  SpinningBody body_;
};

TEST_F(Ring, IsBalancedLikeAWheelInAWorkshop) {
  const auto first_moment = [this] {
    Vec3 sum;
    samples::for_each_node(mesh_, [&](const SweptBlock& block, int node, int station, std::int64_t slot) {
      sum += mass_[index(slot)] * position(block, node, station);
    });
    return Vec3{sum.x, 0, sum.z};
  };
  const auto make_heavier = [this](double share) {  // one of 19 stations
    samples::for_each_node(mesh_, [&](const SweptBlock&, int, int station, std::int64_t slot) {
      if (station == 4) mass_[index(slot)] *= 1 + share;
    });
  };
  make_heavier(0.01);
  const double before = norm(first_moment());
  balance(mesh_, {0}, mass_.data());
  EXPECT_LT(norm(first_moment()), 1e-12 * before);
  EXPECT_NEAR(SpinningBody(mesh_, {0}, mass_.data()).mass() / body_.mass(), 1 + 0.01 / 19, 1e-5);

  make_heavier(0.5);  // a body that is made so
  const std::vector<double> made = mass_;
  balance(mesh_, {0}, mass_.data());
  EXPECT_EQ(mass_, made);
  const SpinningBody eccentric(mesh_, {0}, mass_.data());
  for (const double angle : {0.0, 0.8, -2.5})
    EXPECT_NEAR(eccentric.eccentric_height(angle) * eccentric.mass(), rotate(first_moment(), angle).z, 1e-12);
}

TEST_F(Ring, MomentsAreSumsOverTheNodes) {
  double mass = 0, polar = 0, centre = 0;
  samples::for_each_node(mesh_, [&](const SweptBlock& block, int node, int station, std::int64_t slot) {
    const Vec3 x = position(block, node, station);
    mass += mass_[index(slot)];
    polar += mass_[index(slot)] * (x.x * x.x + x.z * x.z);
    centre += mass_[index(slot)] * x.y;
  });
  centre /= mass;
  double about_x = 0;
  double about_z = 0;
  samples::for_each_node(mesh_, [&](const SweptBlock& block, int node, int station, std::int64_t slot) {
    const Vec3 x = position(block, node, station) - Vec3{0, centre, 0};
    about_x += mass_[index(slot)] * (x.y * x.y + x.z * x.z);
    about_z += mass_[index(slot)] * (x.y * x.y + x.x * x.x);
  });
  EXPECT_NEAR(body_.mass(), mass, 1e-14 * mass);
  EXPECT_NEAR(body_.inertia(), polar, 1e-14 * polar);
  EXPECT_NEAR(body_.centre_y(), centre, 1e-15);
  EXPECT_NEAR(body_.transverse_inertia(), about_x, 1e-13 * about_x);
  EXPECT_NEAR(body_.transverse_inertia(), about_z, 1e-13 * about_z);
}

TEST_F(Ring, MeanMotionOfARigidBodyIsExact) {
  const BodyFrame frame{{2, 0, 0.4}, {80, 0, 0}, 0.9, 190};
  const Vec3 shift{3e-4, -1e-4, 2e-4};
  const Vec3 faster{0.5, 0.2, -0.3};
  constexpr double rotation = 1e-4;
  constexpr double quicker = 2.0;
  const auto u = local_field(frame.angle, [&](const Vec3& x) { return shift + cross({0, rotation, 0}, x); });
  // The ring moves with V + faster and spins with the frame's spin + quicker about its own displaced axis.
  const auto w = local_field(frame.angle, [&](const Vec3& x) {
    return faster + cross({0, quicker, 0}, x) - cross({0, frame.spin, 0}, shift);
  });
  const MeanMotion mean = body_.mean_motion(u.data(), w.data(), frame);
  expect_near(mean.displacement, shift, 1e-18);
  expect_near(mean.velocity, faster, 1e-15);
  EXPECT_NEAR(mean.rotation, rotation, 1e-18);
  EXPECT_NEAR(mean.spin, quicker, 1e-14);
  const Vec3 momentum = body_.momentum(u.data(), w.data(), frame);
  expect_near((1 / body_.mass()) * momentum, frame.velocity + faster, 1e-13);
}

TEST_F(Ring, KineticEnergyIsThatOfTheAbsoluteVelocities) {
  const BodyFrame frame{{2, 0, 0.4}, {80, 0, 0}, 0.9, 190};
  const AlignedVector<double> none(index(3 * mesh_.slots), 0.0);
  const double rigid = 0.5 * body_.mass() * 80 * 80 + 0.5 * body_.inertia() * 190 * 190;
  EXPECT_NEAR(body_.kinetic_energy(none.data(), none.data(), frame), rigid, 1e-14 * rigid);
}

TEST_F(Ring, AnchoringKeepsPositionsAndHalfStepVelocities) {
  constexpr double dt = 9e-8;
  BodyFrame frame{{2, 0.01, 0.43}, {83.3, 0, 0.1}, 1.3, 193.8};
  std::mt19937 random(9);
  std::uniform_real_distribution<double> value(-1, 1);
  auto u = local_field(frame.angle, [&](const Vec3& x) {
    return Vec3{2e-4, 1e-5, -1e-4} + cross({0, 1e-3, 0}, x) +
           1e-5 * Vec3{value(random), value(random), value(random)};
  });
  auto w = local_field(frame.angle, [&](const Vec3& x) {
    return Vec3{0.4, 0, 0.2} + cross({0, 1.9, 0}, x) +
           0.1 * Vec3{value(random), value(random), value(random)};
  });
  const BodyFrame first = frame;
  const State before = absolute(u, w, frame, dt);
  body_.anchor(u.data(), w.data(), frame, dt);
  const State after = absolute(u, w, frame, dt);
  EXPECT_GT(std::abs(frame.angle - first.angle), 9e-4);
  EXPECT_GT(std::abs(frame.spin - first.spin), 1.8);
  // The arm at the half step, u - w dt / 2, is known to second order only.
  const double fastest = 120;
  const double second_order =
      1.1 * std::pow(0.5 * frame.spin * dt, 2) * norm(frame.velocity - first.velocity);
  EXPECT_LT(second_order, 1e-12 * fastest);
  for (std::size_t i = 0; i < before.position.size(); ++i) {
    expect_near(after.position[i], before.position[i], 1e-14 * norm(before.position[i]));
    expect_near(after.velocity[i], before.velocity[i], 1e-14 * fastest + second_order);
  }
  // The remaining mean motion is the rotation's second order and the step's half in the velocities.
  const MeanMotion left = body_.mean_motion(u.data(), w.data(), frame);
  EXPECT_LT(std::hypot(left.displacement.x, left.displacement.z), 1e-17);
  EXPECT_LT(std::abs(left.rotation), 1e-5 * 1e-3);
  EXPECT_LT(std::hypot(left.velocity.x, left.velocity.z), 1e-4);
  // Along the axle the frame keeps its place.
  EXPECT_EQ(frame.origin.y, first.origin.y);
  EXPECT_EQ(frame.velocity.y, first.velocity.y);
  EXPECT_LT(std::abs(left.spin), 1e-4 * 1.9);
}

}  // namespace
}  // namespace tread
