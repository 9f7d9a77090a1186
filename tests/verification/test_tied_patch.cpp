#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/mesh/structured.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/ties/tie.hpp"
#include "tests/field_differences.hpp"
#include "tests/measured.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

using samples::largest;

constexpr double kTurn = 2 * std::numbers::pi;

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

struct Tied {
  const char* name;
  int ratio;
  Sweep sweep;
  bool closed;
  Mesh mesh;
  std::vector<TieSpec> ties;
};

/// A coarse block (0) under a fine one (1): 1:ratio along the sweep, 1:2 across, inner nodes moved at random.
Tied tied(const char* name, Sweep sweep, bool closed, int ratio) {
  Tied t{name, ratio, sweep, closed, {}, {{1, "bottom", 0, "top"}}};
  const double level = sweep == Sweep::revolved ? 0.13 : 0.0;
  const double pitch = sweep == Sweep::revolved ? (closed ? kTurn / 14 : 0.3) : 0.03;
  const int count = closed ? 14 : 6;
  t.mesh.add(make_swept_block("coarse", sweep, rectangle(-0.02, 0.03, 3, level - 0.03, level, 3),
                              {samples::steel()}, 0.2, {{count, pitch, 0}}));
  t.mesh.add(make_swept_block("fine", sweep, rectangle(-0.02, 0.03, 6, level, level + 0.02, 2),
                              {samples::steel()}, 0.2, {{count * ratio, pitch / ratio, 0}}));
  std::mt19937 random(4);
  std::uniform_real_distribution<double> value(-1e-3, 1e-3);
  for (SweptBlock& block : t.mesh.blocks)
    for (int station = 0; station < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes(); ++node)
        if (std::abs(block.section.q[index(node)] - level) > 1e-6)
          block.node_shift[block.slot(node, station)] = {value(random), value(random), value(random)};
  place_on_chords(t.mesh, t.ties[0]);
  return t;
}

std::vector<Tied> cases() {
  std::vector<Tied> list;
  list.push_back(tied("extruded", Sweep::extruded, false, 3));
  list.push_back(tied("arc", Sweep::revolved, false, 3));
  for (const int ratio : {2, 3, 4}) list.push_back(tied("ring", Sweep::revolved, true, ratio));
  return list;
}

/// Nodes that belong to the surface of the tied pair.
bool on_surface(const Tied& t, int block, int node, int station) {
  const SweptBlock& b = t.mesh.blocks[index(block)];
  if (!t.closed && (station == 0 || station == b.station_count() - 1)) return true;
  const auto& s = b.section;
  const double p = s.p[index(node)];
  const double q = s.q[index(node)];
  const auto& free_path = s.paths.at(block == 0 ? "bottom" : "top");
  return p < -0.02 + 1e-9 || p > 0.03 - 1e-9 || std::abs(q - s.q[index(free_path.front())]) < 1e-9;
}

TEST(TiedPatch, LinearFieldLeavesNoForceInside) {
  const auto field = [](const Vec3& x) {
    return Vec3{3e-4 * x.x - 1e-4 * x.y + 2e-4 * x.z, 4e-4 * x.x - 2e-4 * x.y + 1e-4 * x.z,
                -3e-4 * x.x + 2e-4 * x.y + 5e-4 * x.z};
  };
  for (const Tied& t : cases()) {
    const InternalForce internal(t.mesh);
    const Ties ties(t.mesh, t.ties);
    auto u = samples::sample(t.mesh, field);
    ties.follow({u.data()});
    AlignedVector<double> f(u.size());
    internal.apply(u.data(), f.data());
    ties.gather(f.data());
    int inside = 0;
    double worst = 0;
    for (int b = 0; b < 2; ++b) {
      const SweptBlock& block = t.mesh.blocks[index(b)];
      for (int station = 0; station < block.station_count(); ++station)
        for (int node = 0; node < block.section.nodes(); ++node) {
          if (on_surface(t, b, node, station)) continue;
          ++inside;
          for (int c = 0; c < 3; ++c)
            worst =
                std::max(worst, samples::magnitude(f[index(dof(block.base + block.slot(node, station), c))]));
        }
    }
    EXPECT_GT(inside, 50);
    EXPECT_LT(worst, 1e-11 * largest(f)) << t.name << " 1:" << t.ratio;
    measured(fmt::format("{} 1:{}: inner force / largest nodal force", t.name, t.ratio), worst / largest(f));
    const double energy = internal.energy(0, u.data()).hourglass + internal.energy(1, u.data()).hourglass;
    EXPECT_LT(energy, 1e-20 * internal.energy(0, u.data()).strain);
  }
}

TEST(TiedPatch, RigidMotionsGiveNoForce) {
  for (const Tied& t : cases()) {
    const InternalForce internal(t.mesh);
    const Ties ties(t.mesh, t.ties);
    const auto force_of = [&](const auto& motion) {
      auto u = samples::sample(t.mesh, motion);
      for (const std::int64_t slot : ties.secondary_slots())
        for (int c = 0; c < 3; ++c) u[index(dof(slot, c))] = 0;
      ties.follow({u.data()});
      AlignedVector<double> f(u.size());
      internal.apply(u.data(), f.data());
      ties.gather(f.data());
      return largest(f);
    };
    const double stretched = force_of([](const Vec3& x) { return Vec3{x.x, 0, 0}; });
    for (int motion = 0; motion < 6; ++motion) {
      Vec3 axis;
      axis[motion % 3] = 1;
      EXPECT_LT(force_of([&](const Vec3& x) { return motion < 3 ? axis : cross(axis, x); }),
                1e-11 * stretched)
          << t.name << " 1:" << t.ratio << " motion " << motion;
    }
  }
}

}  // namespace
}  // namespace tread
