#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "core/mesh/structured.hpp"
#include "drivers/engine/model/attachments.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/engine/model/rail_foot.hpp"
#include "kernels/blocks/time_update.hpp"
#include "kernels/connectors/connectors.hpp"
#include "kernels/update/body_motion.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// Two bars one above the other, joined by springs at points between nodes.
class Fastened : public testing::Test {
 protected:
  Fastened() {
    mesh_.add(make_swept_block("rail", Sweep::extruded, rectangle(-0.05, 0.05, 4, 0, 0.1, 2),
                               {samples::steel()}, 0, {{10, 0.05, 0}}));
    mesh_.add(make_swept_block("slab", Sweep::extruded, rectangle(-0.2, 0.2, 4, -0.3, -0.1, 2),
                               {samples::concrete()}, 0, {{5, 0.1, 0}}));
    for (const double x : {0.11, 0.333})
      elements_.push_back(
          {attach(mesh_.blocks[0], "bottom", x, 0.02), attach(mesh_.blocks[1], "top", x, 0.02), 3e6, 4e3});
    // To the ground, in each direction.
    for (const int component : {0, 1, 2})
      elements_.push_back({attach(mesh_.blocks[0], "bottom", 0.27, -0.03), {}, 5e6, 1e3, component});
  }
  AlignedVector<double> field() const { return AlignedVector<double>(index(3 * mesh_.slots), 0.0); }

  Mesh mesh_;
  std::vector<SpringDampers::Element> elements_;
};

TEST_F(Fastened, AttachmentsInterpolate) {
  const auto u = samples::sample(mesh_, [](const Vec3& x) { return Vec3{0, 0, 1 + 2 * x.x - 3 * x.y}; });
  EXPECT_NEAR(elements_[0].upper.value(u.data(), 2), 1 + 0.22 - 0.06, 1e-14);
  EXPECT_NEAR(elements_[1].lower.value(u.data(), 2), 1 + 0.666 - 0.06, 1e-14);
  EXPECT_EQ(elements_[2].lower.value(u.data(), 2), 0);
  EXPECT_ANY_THROW(attach(mesh_.blocks[0], "bottom", 0.6, 0));
  EXPECT_ANY_THROW(attach(mesh_.blocks[0], "bottom", 0.1, 0.06));
  EXPECT_ANY_THROW(attach(mesh_.blocks[0], "nowhere", 0.1, 0));
}

TEST_F(Fastened, ForcesAreThoseOfSpringsAndDampers) {
  SpringDampers fastenings(elements_);
  const auto u = samples::random_field(mesh_, 1);
  const auto v = samples::random_field(mesh_, 2);
  auto f = field();
  fastenings.apply(u.data(), v.data(), 1e-6, f.data());
  // The forces are tested by their virtual work on a test displacement.
  const auto test = samples::random_field(mesh_, 3);
  double work = 0;
  for (std::size_t i = 0; i < f.size(); ++i) work += f[i] * test[i];
  double expected = 0;
  double loss = 0;
  for (const auto& e : elements_) {
    const auto stretch = [&](const AlignedVector<double>& a) {
      return e.upper.value(a.data(), e.component) - e.lower.value(a.data(), e.component);
    };
    expected += (e.stiffness * stretch(u) + e.damping * stretch(v)) * stretch(test);
    loss += e.damping * stretch(v) * stretch(v) * 1e-6;
  }
  EXPECT_NEAR(work, expected, 1e-13 * std::abs(expected));
  EXPECT_NEAR(fastenings.dissipated(), loss, 1e-14 * loss);
}

TEST_F(Fastened, SpringsAndEnergyAgreeWithTheForces) {
  SpringDampers fastenings(elements_);
  const auto u = samples::random_field(mesh_, 1);
  auto f = field();
  fastenings.apply(u.data(), field().data(), 1e-6, f.data());
  auto from_springs = field();
  add_springs(fastenings.springs(), u.data(), from_springs.data());
  double work = 0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    EXPECT_NEAR(f[i], from_springs[i], 1e-14 * 50);
    work += f[i] * u[i];
  }
  EXPECT_NEAR(fastenings.energy(u.data()), 0.5 * work, 1e-13 * work);
  EXPECT_EQ(fastenings.dissipated(), 0);
}

/// Nodes of the foot at which a fastening holds the rail, over its pad and at its spring-dampers.
TEST(HeldFoot, IsThatOfThePadOrOfTheSprings) {
  Scene scene;
  scene.rail.emplace().origin = 0.5;
  FasteningSpec& f = scene.fastenings.emplace();
  f.count = 2;
  f.spacing = 0.6;
  f.first = 0.2;
  f.pad_length = 0.1;
  f.pad_width = 0.06;
  f.columns = 2;
  f.rows = 2;
  SweptBlock rail = make_swept_block("rail", Sweep::extruded, rectangle(-0.05, 0.05, 10, 0, 0.1, 2),
                                     {samples::steel()}, -0.5, {{100, 0.01, 0}});
  rail.section.paths["foot"] = rail.section.paths.at("bottom");
  const auto places = [&] {
    std::set<std::pair<long, long>> mm;
    for (const FootNode& at : held_foot_nodes(scene, RailFoot(rail)))
      mm.insert({std::lround(1e3 * (at.x + 0.5)), std::lround(1e3 * at.y)});
    return mm;
  };
  std::set<std::pair<long, long>> pad;
  for (const long middle : {200, 800})
    for (long x = -50; x <= 50; x += 10)
      for (long y = -30; y <= 30; y += 10) pad.insert({middle + x, y});
  EXPECT_EQ(places(), pad);
  f.pad_length = 0.004;  // shorter than an element: the nearest nodes
  f.spacing = 0.604;
  EXPECT_EQ(places().size(), 14U);
  f.pad_length = 0.1;
  f.spacing = 0.6;
  f.held_at = "springs";
  const std::set<std::pair<long, long>> at_springs = places();
  EXPECT_EQ(at_springs.size(), 8U);
  for (const auto& [x, y] : at_springs) {
    EXPECT_NEAR(std::abs(x < 500 ? x - 200 : x - 800), 25, 5.1);
    EXPECT_NEAR(std::abs(y), 15, 5.1);
  }
}

TEST(SprungMass, SwingsAtItsFrequency) {
  SprungMass mass{8000, 880e3, 0, 0, 0, 0, 0};
  constexpr double dt = 1e-4;
  const double omega = std::sqrt(880e3 / 8000.0);
  const double rest = -8000 * 9.81 / 880e3;
  mass.height = rest + 0.01;
  // Ten periods are counted by the crossings of the position of rest.
  int crossings = 0;
  double first = 0, last = 0, before = 0.01;
  for (int step = 1; crossings < 21; ++step) {
    mass.advance(mass.force(0, 0), 9.81, dt);
    const double off = mass.height - rest;
    if (off * before < 0) {
      const double at = dt * (step - 1 + before / (before - off));
      (crossings == 0 ? first : last) = at;
      ++crossings;
    }
    before = off;
  }
  EXPECT_NEAR((last - first) / 10 / (kTurn / omega), 1, 1e-6);
}

TEST(SprungMass, SuspensionFollowsTheJournal) {
  const SprungMass mass{8000, 880e3, 4e3, 0.5, 1.52, 0.1, 0};
  EXPECT_NEAR(mass.force(1.0, 0.3), -880e3 * 0.02 + 4e3 * 0.2, 1e-8);
}

/// A ring all of whose nodes are the journal, and one whose bore is.
class Spinning : public testing::Test {
 protected:
  Spinning() {
    mesh_.add(make_swept_block("ring", Sweep::revolved, rectangle(-0.02, 0.03, 2, 0.05, 0.08, 2),
                               {samples::steel()}, 0.1, {{21, kTurn / 21, 0}}));
    internal_ = std::make_unique<InternalForce>(mesh_);
    mass_.assign(index(mesh_.slots), 0.0);
    internal_->lumped_mass(mass_.data());
    inverse_.assign(mass_.size(), 0.0);
    for (std::size_t i = 0; i < mass_.size(); ++i)
      if (mass_[i] > 0) inverse_[i] = 1 / mass_[i];
    for (int node = 0; node < block().section.nodes(); ++node) all_.push_back(node);
    body_ = SpinningBody(mesh_, {0}, mass_.data());
  }
  const SweptBlock& block() const { return mesh_.blocks[0]; }
  AlignedVector<double> field() const { return AlignedVector<double>(index(3 * mesh_.slots), 0.0); }
  Vec3 local(const AlignedVector<double>& f, std::int64_t slot) const {
    return {f[index(dof(slot, 0))], f[index(dof(slot, 1))], f[index(dof(slot, 2))]};
  }

  Mesh mesh_;
  std::unique_ptr<InternalForce> internal_;
  std::vector<double> mass_;
  AlignedVector<double> inverse_;
  std::vector<int> all_;
  SpinningBody body_;
};

TEST_F(Spinning, JournalMeansAreThoseOfTheRigidMotion) {
  const Journal journal(block(), block().section.paths.at("bottom"), mass_.data());
  const BodyFrame frame{{3, 0, 0.4}, {80, 1, -2}, 0.77, 190};
  auto u = field();
  auto w = field();
  const Vec3 shift{1e-3, -2e-3, 3e-3};
  const Vec3 faster{0.1, 0.2, 0.3};
  samples::for_each_node(mesh_, [&](const SweptBlock& b, int, int station, std::int64_t slot) {
    const Vec3 a = to_local(b, station, frame.angle, shift);
    const Vec3 rate = to_local(b, station, frame.angle, faster);
    for (int c = 0; c < 3; ++c) {
      u[index(dof(slot, c))] = a[c];
      w[index(dof(slot, c))] = rate[c];
    }
  });
  EXPECT_LT(norm(journal.displacement(u.data(), frame) - shift), 1e-17);
  const Vec3 expected = frame.velocity + faster + cross({0, frame.spin, 0}, shift);
  EXPECT_LT(norm(journal.velocity(u.data(), w.data(), frame) - expected), 1e-13);

  auto force = field();
  const Vec3 load{10, -20, 30};
  journal.add(force.data(), frame, load);
  EXPECT_LT(norm(journal.mass() * journal.acceleration(force.data(), frame) - load), 1e-13);
  double moment = 0;
  Vec3 sum;
  samples::for_each_node(mesh_, [&](const SweptBlock& b, int node, int station, std::int64_t slot) {
    sum += to_cartesian(b, station, frame.angle, local(force, slot));
    moment += b.section.q[index(node)] * local(force, slot).x;
  });
  EXPECT_LT(norm(sum - load), 1e-13);
  EXPECT_LT(std::abs(moment), 1e-13);
}

TEST_F(Spinning, TorqueTurnsTheBodyAsItsInertia) {
  const AxleTorque torque(block(), all_, mass_.data());
  auto u = field(), w = field(), f = field();
  const BodyFrame frame{{0, 0, 0}, {0, 0, 0}, 0.3, 0};
  EXPECT_EQ(torque.apply(500, u.data(), w.data(), frame, f.data()), 0);
  constexpr double dt = 1e-6;
  TimeUpdate(mesh_, inverse_.data()).move_all({dt, 0, frame}, {u.data(), w.data(), f.data()});
  const MeanMotion mean = body_.mean_motion(u.data(), w.data(), frame);
  EXPECT_NEAR(mean.spin, dt * 500 / body_.inertia(), 1e-14 * mean.spin);
  EXPECT_LT(norm(mean.velocity), 1e-15);
}

TEST_F(Spinning, PowerOfTheTorqueIsThatOfItsNodalForces) {
  const AxleTorque torque(block(), block().section.paths.at("bottom"), mass_.data());
  const BodyFrame frame{{0, 0, 0}, {80, 0, 0}, 0.3, 190};
  const auto u = samples::random_field(mesh_, 1);
  const auto w = samples::random_field(mesh_, 2);
  auto f = field();
  const double spin = torque.apply(500, u.data(), w.data(), frame, f.data());
  double power = 0;
  samples::for_each_node(mesh_, [&](const SweptBlock& b, int node, int, std::int64_t slot) {
    const Vec3 arm = Vec3{0, b.section.p[index(node)], b.section.q[index(node)]} + local(u, slot);
    power -= dot(local(f, slot), local(w, slot) + spin_cross(frame.spin, arm));
  });
  EXPECT_NEAR(500 * spin, power, 1e-13 * power);
}

TEST_F(Spinning, UnsprungMassIsCarriedAlong) {
  // An elastic ring with M_a on its bore is pushed there. The momentum of both is the impulse, and the body's
  // mean acceleration is F / (m + M_a).
  const Journal journal(block(), block().section.paths.at("bottom"), mass_.data());
  const double added = 2 * body_.mass();
  const double gravity = 9.81;
  const Vec3 push{1000, 0, 400};
  auto u = field(), w = field(), f = field();
  BodyFrame frame;
  const double dt = 1.5 / internal_->max_frequency(0).omega;
  constexpr int kSteps = 4000;
  const TimeUpdate update(mesh_, inverse_.data());
  for (int step = 0; step < kSteps; ++step) {
    internal_->apply(u.data(), f.data());
    journal.add(f.data(), frame, -push);
    const double shared = journal.mass() / (journal.mass() + added);
    journal.add(f.data(), frame, (-added * shared) * journal.acceleration(f.data(), frame));
    update.move_all({dt, gravity, frame}, {u.data(), w.data(), f.data()});
    frame.advance(dt);
  }
  const double time = kSteps * dt;
  const Vec3 impulse = time * (push + Vec3{0, 0, -gravity * (body_.mass() + added)});
  const Vec3 momentum =
      body_.momentum(u.data(), w.data(), frame) + added * journal.velocity(u.data(), w.data(), frame);
  EXPECT_LT(norm(momentum - impulse), 1e-10 * norm(impulse));
  const Vec3 way = body_.mean_motion(u.data(), w.data(), frame).displacement;
  const Vec3 rigid = (0.5 * time * time / (body_.mass() + added)) * (impulse * (1 / time));
  EXPECT_LT(norm(way - rigid), 2e-3 * norm(rigid));
}

}  // namespace
}  // namespace tread
