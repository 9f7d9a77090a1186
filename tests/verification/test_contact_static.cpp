// Contact of a rigidly placed wheel: gaps against the geometry of a torus, forces against statics.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "core/geometry/profiles.hpp"
#include "core/mesh/rail_section.hpp"
#include "core/mesh/wheel_section.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/contact/contact.hpp"
#include "tests/measured.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kRadius = 0.43;
constexpr double kPenalty = 1e14;

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

struct Placed {
  double crown;  ///< lateral radius of the tread [m]
  double angle;  ///< angle of the wheel [rad]
  Vec3 offset;   ///< place of the axle, relative to contact at x = 0, y = 0 [m]
  bool corrugated;
};

/// A wheel with a fine arc and a coarse one, over a flat rail of two pitches.
class Placement {
 public:
  /// Places the wheel. `points`: number of points of a face in each direction, 2 for points_inside().
  explicit Placement(const Placed& placed, SurfaceKind kind = SurfaceKind::exact, int points = 2)
      : placed_(placed) {
    SectionSize size;
    size.surface = 2e-3;
    size.coarse = 10e-3;
    size.band_centre = 0;
    size.band_half_width = 25e-3;
    const Section rail = make_box_rail_section(0.08, 0.03, 0, size);
    const Section tyre = make_tyre_section(crowned(0.06, placed.crown), 2 * kRadius, 0, 0.03, size);
    mesh_.add(make_swept_block("rail", Sweep::extruded, rail, {samples::steel()}, -0.1,
                               {{60, 2e-3, 0}, {20, 4e-3, 0}}));
    const double fine = 2.5e-3 / kRadius;
    const int rest = 300;
    mesh_.add(make_swept_block("tyre", Sweep::revolved, tyre, {samples::steel()}, -0.2,
                               {{100, fine, 0}, {rest, (kTurn - 100 * fine) / rest, 0}}));
    ContactOptions options;
    options.points = points;
    options.rail_block = 0;
    options.wheel_block = 1;
    options.penalty = kPenalty;
    options.wheel_radius = kRadius;
    options.surface = kind;
    const Corrugation shape =
        placed.corrugated ? Corrugation({0.03, 0.1e-3}, -0.06, 0.1, 1e-3, 20e-3) : Corrugation();
    contact_ = std::make_unique<Contact>(mesh_, options, shape);
    frame_.angle = placed.angle;
    frame_.origin = placed.offset + Vec3{0, 0, kRadius};
    zero_.assign(index(3 * mesh_.slots), 0.0);
    contact_->find_static({zero_.data(), nullptr, &frame_});
  }

  /// Distance of a point from the undeformed tread, negative inside the wheel.
  double gap(const Vec3& x) const {
    const Vec3 d = x - frame_.origin;
    return std::hypot(std::hypot(d.x, d.z) - (kRadius - placed_.crown), d.y) - placed_.crown;
  }

  /// Number of points of 2 x 2 Gauss on every face of the rail that lie inside the wheel by more than `depth`
  /// [m].
  int points_inside(double depth) const {
    const SweptBlock& rail = mesh_.blocks[0];
    const double g = 0.5 / std::sqrt(3.0);
    int count = 0;
    for (int station = 0; station + 1 < rail.station_count(); ++station)
      for (const SurfaceEdge& edge : rail.section.surface)
        for (const double along : {0.5 - g, 0.5 + g})
          for (const double across : {0.5 - g, 0.5 + g}) {
            const double x0 = rail.stations[index(station)];
            const double y0 = rail.section.p[index(edge.node[0])];
            Vec3 x{x0 + along * (rail.stations[index(station + 1)] - x0),
                   y0 + across * (rail.section.p[index(edge.node[1])] - y0), 0};
            x.z = -contact_->corrugation().depth(x.x, x.y);
            if (gap(x) < -depth) ++count;
          }
    return count;
  }

  const Contact& contact() const { return *contact_; }
  const BodyFrame& frame() const { return frame_; }
  const Mesh& mesh() const { return mesh_; }
  Contact& contact() { return *contact_; }

 private:
  Placed placed_;
  Mesh mesh_;
  std::unique_ptr<Contact> contact_;
  BodyFrame frame_;
  AlignedVector<double> zero_;
};

std::vector<Placed> placements() {
  std::vector<Placed> list;
  for (const double crown : {kRadius, 0.3})
    for (const bool corrugated : {false, true})
      for (const auto& [angle, offset] :
           {std::pair{0.0, Vec3{0, 0, -1e-4}}, std::pair{0.123, Vec3{0.0123, 0.002, -0.8e-4}},
            std::pair{2.0, Vec3{0.03, -0.0031, -1.2e-4}}, std::pair{-47.11, Vec3{-0.0177, 0.0007, -1e-4}}})
        list.push_back({crown, angle, offset, corrugated});
  return list;
}

TEST(PlacedWheel, NodesAverageTheirShareOfThePoints) {
  // Mean square distance of the Gauss points that a node averages, over the element squared: 1 to 4 points.
  constexpr std::array<double, 4> kSpread = {0.25, 0.044658, 0.118172, 0.072703};
  for (int points = 1; points <= 4; ++points) {
    const Placement placement({0.3, 0.123, {0.0123, 0.002, -1e-4}, false}, SurfaceKind::exact, points);
    const PatchNodes& nodes = placement.contact().nodes();
    const SurfaceGrid& grid = nodes.grid();
    // The tested node is the one nearest to the patch's middle, all of whose points touch.
    const auto nearest = [](const std::vector<double>& places, double to) {
      const auto nearer = [to](double a, double b) { return std::abs(a - to) < std::abs(b - to); };
      return std::min_element(places.begin(), places.end(), nearer) - places.begin();
    };
    const auto station = static_cast<int>(nearest(grid.x, placement.frame().origin.x));
    const auto row = static_cast<int>(nearest(grid.y, placement.frame().origin.y));
    const auto pressure = [&](int i, int j) {
      return -kPenalty * placement.gap({grid.x[index(station + i)], grid.y[index(row + j)], 0});
    };
    // Expected value for a pressure that is quadratic within the box.
    const double bent =
        pressure(1, 0) + pressure(-1, 0) + pressure(0, 1) + pressure(0, -1) - 4 * pressure(0, 0);
    const double expected = pressure(0, 0) + 0.5 * kSpread[index(points - 1)] * bent;
    EXPECT_GT(std::abs(expected / pressure(0, 0) - 1), 1e-3);  // effect of wrong shares
    EXPECT_NEAR(nodes.at(station, row).pressure / expected, 1, 1e-5) << points;
  }
}

TEST(PlacedWheel, GapsAreThoseOfTheTorus) {
  double worst_gap = 0;
  double worst_normal = 0;
  std::size_t points = 0;
  for (const Placed& placed : placements()) {
    const Placement placement(placed);
    ASSERT_GT(placement.contact().points().size(), 3U);
    points += placement.contact().points().size();
    const double off = kRadius - placed.crown;
    for (const ContactPoint& point : placement.contact().points()) {
      const double exact = placement.gap(point.position);
      worst_gap = std::max(worst_gap, std::abs(point.gap - exact));
      // Outward normal of the torus.
      const Vec3 d = point.position - placement.frame().origin;
      const double far = std::hypot(d.x, d.z);
      const Vec3 from_ring = d - (off / far) * Vec3{d.x, 0, d.z};
      worst_normal = std::max(worst_normal, norm(point.normal - (1 / norm(from_ring)) * from_ring));
      EXPECT_NEAR(point.pressure, -kPenalty * point.gap, 1e-6);
    }
    // The search found all points inside the wheel, and no other.
    const int count = static_cast<int>(placement.contact().points().size());
    EXPECT_LE(count, placement.points_inside(-1e-9));
    EXPECT_GE(count, placement.points_inside(1e-9));
  }
  measured("contact points compared", static_cast<double>(points));
  measured("largest error of a gap", worst_gap, "m");
  measured("largest error of a normal", worst_normal);
  EXPECT_LT(worst_gap, 1e-9);
  EXPECT_LT(worst_normal, 1e-6);
}

TEST(PlacedWheel, FacetsStandOffByTheirSagitta) {
  const Placement placement({0.3, 0.123, {0.0123, 0.002, -1e-4}, false}, SurfaceKind::facets);
  double worst = 0;
  for (const ContactPoint& point : placement.contact().points())
    worst = std::max(worst, std::abs(point.gap - placement.gap(point.position)));
  measured("largest gap between facets and torus", worst, "m");
  // Chords of 2.5 (or 3.8) mm around and 2 mm across.
  EXPECT_LT(worst, 6e-6);
  EXPECT_GT(worst, 1e-6);
}

TEST(PlacedWheel, ForcesBalanceAndHaveNoMomentAboutTheAxle) {
  double worst_sum = 0;
  double worst_moment = 0;
  for (const Placed& placed : placements()) {
    const Placement placement(placed);
    const Mesh& mesh = placement.mesh();
    AlignedVector<double> force(index(3 * mesh.slots), 0.0);
    placement.contact().add_forces(force.data());
    Vec3 sum;
    Vec3 on_rail;
    double moment = 0;
    samples::for_each_node(mesh, [&](const SweptBlock& block, int node, int station, std::int64_t slot) {
      // add_forces subtracts external forces.
      const Vec3 local{-force[index(dof(slot, 0))], -force[index(dof(slot, 1))], -force[index(dof(slot, 2))]};
      const double angle = block.sweep == Sweep::revolved ? placement.frame().angle : 0.0;
      const Vec3 f = to_cartesian(block, station, angle, local);
      sum += f;
      if (block.sweep == Sweep::extruded)
        on_rail += f;
      else
        moment += block.section.q[index(node)] * local.x;
    });
    const ContactTotals& totals = placement.contact().totals();
    EXPECT_LT(norm(on_rail - totals.force_on_rail), 1e-12 * norm(on_rail));
    EXPECT_LT(totals.force_on_rail.z, 0);
    worst_sum = std::max(worst_sum, norm(sum) / norm(on_rail));
    worst_moment = std::max(worst_moment, std::abs(moment) / (norm(on_rail) * kRadius));
    // Symmetric placements push straight down.
    if (placed.angle == 0 && !placed.corrugated) {
      EXPECT_LT(std::abs(totals.force_on_rail.x), 1e-10 * norm(on_rail));
      EXPECT_LT(std::abs(totals.force_on_rail.y), 1e-10 * norm(on_rail));
    }
  }
  measured("largest sum of forces / F_N", worst_sum);
  measured("largest moment about the axle / (F_N R)", worst_moment);
  EXPECT_LT(worst_sum, 1e-13);
  EXPECT_LT(worst_moment, 1e-6);
}

TEST(PlacedWheel, SpringsAreTheDerivativeOfTheForces) {
  const Placement placement({0.3, 0.123, {0.0123, 0.002, -1e-4}, true});
  const auto springs = placement.contact().springs();
  ASSERT_EQ(springs.size(), placement.contact().points().size());
  AlignedVector<double> force(index(3 * placement.mesh().slots), 0.0);
  AlignedVector<double> from_springs(force.size(), 0.0);
  placement.contact().add_forces(force.data());
  for (std::size_t k = 0; k < springs.size(); ++k)
    for (std::size_t i = 0; i < springs[k].dofs.size(); ++i)
      from_springs[index(springs[k].dofs[i])] +=
          springs[k].stiffness * placement.contact().points()[k].gap * springs[k].weights[i];
  for (std::size_t i = 0; i < force.size(); ++i) EXPECT_NEAR(force[i], from_springs[i], 1e-9);
}

// Pressures belong to the gaps of the motion that they cause, however stiff the penalty is for the step.
TEST(PlacedWheel, PressuresAreThoseOfTheMiddleOfTheStep) {
  Placement placement({0.3, 0.123, {0.0123, 0.002, -5e-6}, false});
  const Mesh& mesh = placement.mesh();
  const InternalForce internal(mesh);
  std::vector<double> mass(index(mesh.slots), 0.0);
  internal.lumped_mass(mass.data());
  AlignedVector<double> u(index(3 * mesh.slots), 0.0);
  AlignedVector<double> v(u.size(), 0.0);
  const double static_force = norm(placement.contact().totals().force_on_rail);
  constexpr double dt = 1e-6;
  Contact& contact = placement.contact();
  contact.search({u.data(), v.data(), &placement.frame()}, 0, dt);
  contact.resolve({u.data(), v.data(), mass.data()}, placement.frame(), dt);
  const std::vector<ContactPoint> points = contact.points();
  const Vec3 force = contact.totals().force_on_rail;
  measured("force / that of the gaps at the start", norm(force) / static_force);
  EXPECT_LT(norm(force), 0.7 * static_force);

  Vec3 on_rail;
  Vec3 on_both;
  samples::for_each_node(mesh, [&](const SweptBlock& block, int, int station, std::int64_t slot) {
    const Vec3 local{v[index(dof(slot, 0))], v[index(dof(slot, 1))], v[index(dof(slot, 2))]};
    const double angle = block.sweep == Sweep::revolved ? placement.frame().angle : 0.0;
    const Vec3 momentum = mass[index(slot)] * to_cartesian(block, station, angle, local);
    on_both += momentum;
    if (block.sweep == Sweep::extruded) on_rail += momentum;
  });
  EXPECT_LT(norm(on_rail - dt * force), 1e-12 * dt * norm(force));
  EXPECT_LT(norm(on_both), 1e-12 * dt * norm(force));

  for (double& value : u) value *= 0.5;
  contact.find_static({u.data(), nullptr, &placement.frame()});
  const auto at_middle = [&](const ContactPoint& wanted) {
    for (const ContactPoint& point : contact.points())
      if (point.history == wanted.history) return point.pressure;
    return 0.0;
  };
  double worst = 0;
  for (const ContactPoint& point : points)
    worst = std::max(worst, std::abs(at_middle(point) - point.pressure) / contact.totals().max_pressure);
  measured("largest difference of a pressure / largest pressure", worst);
  EXPECT_LT(worst, 2e-3);
}

TEST(PlacedWheel, ACorrugationThatIsSetLaterGivesTheSameBits) {
  Placement built({0.3, 0.123, {0.0123, 0.002, -0.8e-4}, true});
  Placement set({0.3, 0.123, {0.0123, 0.002, -0.8e-4}, false});
  const std::vector<ContactPoint> smooth = set.contact().points();
  const AlignedVector<double> zero(index(3 * set.mesh().slots), 0.0);
  set.contact().set_corrugation(built.contact().corrugation());
  set.contact().find_static({zero.data(), nullptr, &set.frame()});
  const auto& expected = built.contact().points();
  const auto& found = set.contact().points();
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_NE(found.size(), smooth.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].history, expected[i].history);
    EXPECT_EQ(found[i].gap, expected[i].gap);
    EXPECT_EQ(found[i].pressure, expected[i].pressure);
  }
  EXPECT_EQ(set.contact().reach(), built.contact().reach());
  EXPECT_EQ(set.contact().totals().area, built.contact().totals().area);
  EXPECT_EQ(set.contact().bytes(), built.contact().bytes());
}

}  // namespace
}  // namespace tread
